#pragma once
// Check sums that tell files apart (FIPS 180-4).

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace tcm_icp {

class Sha256 {
 public:
  void add(std::span<const std::uint8_t> bytes);
  /// 64 hexadecimal digits. Once.
  std::string digest();

 private:
  void take_block(const std::uint8_t* block);

  std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<std::uint8_t, 64> rest_{};
  std::size_t num_rest_ = 0;
  std::uint64_t num_bytes_ = 0;
};

/// Of a file's bytes. @throws InputError
std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace tcm_icp

#pragma once
// LZF, unpacked step by step in bounded memory: the packing of PCD's binary_compressed.

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "byte_stream.hpp"

namespace tcm_icp {

/// Where unpacking stands. A copy goes on from the same place: 8 KiB are all that later data can refer to.
struct LzfState {
  static constexpr std::size_t kWindow = 8192;

  std::uint64_t input_offset = 0;        ///< [bytes] of the file, of the next packed byte
  std::uint64_t input_end = 0;           ///< [bytes] of the file, behind the last one
  std::uint64_t num_out = 0;             ///< [bytes] unpacked
  std::size_t literals = 0;              ///< bytes still to be copied from the input
  std::size_t copies = 0, distance = 0;  ///< bytes still to be copied from so far back
  std::array<std::byte, kWindow> window{};
};

class LzfStream {
 public:
  /// @throws InputError  if the file cannot be opened
  LzfStream(const std::filesystem::path& file, const LzfState& state);

  /// The next `n` unpacked bytes; to nullptr: they are dropped. False where the packed data end before.
  /// @throws InputError  where they are damaged
  bool read(std::byte* to, std::size_t n);

  const LzfState& state() const { return state_; }

 private:
  std::byte next_input();
  void next_token();

  std::filesystem::path file_;
  std::unique_ptr<ByteStream> stream_;
  LzfState state_;
  std::vector<std::byte> buffer_;
  std::size_t begin_ = 0, end_ = 0;
};

}  // namespace tcm_icp

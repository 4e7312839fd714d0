#pragma once
// PLY files put together by hand, so that a test does not read what our own writer wrote.

#include <algorithm>
#include <cstring>
#include <string>

namespace tcm_icp::test {

enum class Order { kLittle, kBig };

/// The bytes of `value`; this machine is little-endian, which a test below checks.
template <typename T>
std::string bytes_of(T value, Order order = Order::kLittle) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (order == Order::kBig) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

inline std::string ply_header(const std::string& format, const std::string& lines) {
  return "ply\nformat " + format + " 1.0\n" + lines + "end_header\n";
}

inline std::string xyz_vertices(std::size_t count, const std::string& type = "float") {
  return "element vertex " + std::to_string(count) + "\nproperty " + type + " x\nproperty " + type + " y\nproperty " +
         type + " z\n";
}

}  // namespace tcm_icp::test

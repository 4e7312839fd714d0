#include "cloud_sink.hpp"

#include "scalar.hpp"

namespace tcm_icp {

void CloudSink::finish(std::uint64_t num_points) {
  complete(num_points);
  file_.close();
}

std::uint8_t colour_byte(const std::byte* bytes, ScalarType type) {
  const double value = load_scalar(bytes, type);
  return static_cast<std::uint8_t>(type == ScalarType::kUInt8 ? value : value / 257 + 0.5);
}

std::string count_lines(const std::string& comment, const std::string& text, std::uint64_t count) {
  constexpr std::size_t kCountDigits = 20;  // of the largest 64-bit number
  const std::string digits = std::to_string(count);
  return comment + ' ' + std::string(1 + kCountDigits - digits.size(), '-') + '\n' + text + ' ' + digits + '\n';
}

}  // namespace tcm_icp

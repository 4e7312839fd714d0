#include "report/base64.hpp"

namespace tcm_icp {

std::string base64(std::span<const std::uint8_t> bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t n = bytes.size() - i;
    const std::uint32_t three = (std::uint32_t{bytes[i]} << 16U) | (n > 1 ? std::uint32_t{bytes[i + 1]} << 8U : 0U) |
                                (n > 2 ? std::uint32_t{bytes[i + 2]} : 0U);
    out += kDigits[three >> 18U];
    out += kDigits[(three >> 12U) & 63U];
    out += n > 1 ? kDigits[(three >> 6U) & 63U] : '=';
    out += n > 2 ? kDigits[three & 63U] : '=';
  }
  return out;
}

}  // namespace tcm_icp

#pragma once
// Bytes in text (RFC 4648, with padding).

#include <cstdint>
#include <span>
#include <string>

namespace tcm_icp {

std::string base64(std::span<const std::uint8_t> bytes);

}  // namespace tcm_icp

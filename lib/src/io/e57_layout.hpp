#pragma once
// Sizes in E57 files that the reader and the writer share (ASTM E2807).

#include <cstddef>

namespace tcm_icp {

constexpr std::size_t kE57FileHeader = 48, kE57SectionHeader = 32, kE57PacketHeader = 6;  // [bytes]

}  // namespace tcm_icp

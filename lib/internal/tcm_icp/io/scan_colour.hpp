#pragma once
// Colours that tell scans apart.

#include <array>
#include <cstddef>
#include <cstdint>

namespace tcm_icp {

/// Red, green, blue of a scan: the same for the same index everywhere. Hues step by the golden ratio, so that any few
/// successive scans are far apart on the colour wheel; saturation and brightness change from one scan to the next.
std::array<std::uint8_t, 3> scan_colour(std::size_t scan_index);

}  // namespace tcm_icp

#pragma once
// Writes points as a binary PLY file of doubles, by hand, so that no test reads what our own writer wrote.

#include <bit>
#include <filesystem>
#include <fstream>

#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp::testing {

inline std::filesystem::path write_ply(const std::filesystem::path& path, const Points& points) {
  static_assert(std::endian::native == std::endian::little);
  std::ofstream out(path, std::ios::binary);
  out << "ply\nformat binary_little_endian 1.0\nelement vertex " << points.size()
      << "\nproperty double x\nproperty double y\nproperty double z\nend_header\n";
  for (const auto& p : points) out.write(reinterpret_cast<const char*>(p.data()), 3 * sizeof(double));
  return path;
}

}  // namespace tcm_icp::testing

#pragma once
// Writes one scan as a file that ScanReader reads.

#include <filesystem>
#include <vector>

#include "tcm_icp/io/point_block.hpp"

namespace tcm_icp {

/// Whether write_scan() knows the extension of this name.
bool can_write_scan(const std::filesystem::path& path);

/// A .ply gets binary little endian, double x y z and the attributes as they are; a text file (.xyz .txt .asc .pts
/// .csv) a line of names behind '#' and one line of blanks-separated numbers a point, 17 significant digits.
/// @throws InvalidInput  if the attributes' bytes do not fit the points, or the extension is another
/// @throws OutputError   if the file cannot be written
void write_scan(const std::filesystem::path& path, const PointBlock& block, const std::vector<Attribute>& attributes);

}  // namespace tcm_icp

#pragma once
// Names of scans: a file, or one of the scans in a file that holds several ("hall.e57#2").

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "tcm_icp/io/length_unit.hpp"

namespace tcm_icp {

/// What bare floats without a header are: x y z intensity, or x y z intensity ring.
enum class BinLayout {
  kNone,     ///< no bare floats
  kKitti,    ///< x y z intensity
  kNuScenes  ///< x y z intensity ring
};

/// A scan's name in its parts.
struct ScanPath {
  std::filesystem::path file;            ///< to be read
  std::size_t number = 0;                ///< of the scan in the file, from 1; 0: the file is the scan
  BinLayout bin = BinLayout::kNone;      ///< what a file of bare floats holds
  LengthUnit unit = LengthUnit::kMetre;  ///< of the coordinates in the file
};

/// "hall.e57#2" is scan 2 of hall.e57, "000.bin#kitti" and "000.bin#nuscenes" are files of bare floats, unless a file
/// of that whole name is there. A unit may stand behind all that: "hall.e57#2#ft" (mm, ft, us-ft).
ScanPath parse_scan_path(const std::filesystem::path& path);

/// A path by which ScanReader reads a scan as one whose coordinates are in `unit`, whatever unit the path had.
std::filesystem::path with_unit(const std::filesystem::path& path, LengthUnit unit);

/// The scans of a file: {file} where it holds one, else file#1, file#2, ... What names one scan stands for itself. PTX
/// files, and text files that begin with a count, are read once to find out.
/// @throws InputError  if the file cannot be read, is of no known format, or holds no scan
std::vector<std::filesystem::path> scans_in(const std::filesystem::path& path);

/// What results call the scans: the file names, and where two have the same, the end of the path from where on all
/// of these differ ("Setup1/scan.ply"); always with '/'. "#kitti", "#nuscenes" and units are left out.
/// @pre no path twice
std::vector<std::string> scan_names(const std::vector<std::filesystem::path>& scans);

}  // namespace tcm_icp

#pragma once
// From what a user names (files, folders, patterns) to scans.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tcm_icp/io/scan_path.hpp"

namespace tcm_icp {

/// The scans that were found.
struct ScanInputs {
  std::vector<std::filesystem::path> scans;  ///< for ScanReader
  std::vector<std::string> left_out;         ///< files of folders that are no scans, each with the reason
};

/// Each input in its place: a file becomes its scans (scans_in()); a folder, all scans in it and in the folders below,
/// in natural order, without hidden files and results of this program; a pattern (* ? [) that is no file's name, what
/// it matches, in natural order.
/// @param inputs  files, folders, patterns
/// @param bin     what files with the extension .bin are
/// @throws InputError  a pattern or folder without a scan, a named file that is none, a damaged scan in a folder
ScanInputs find_scans(const std::vector<std::string>& inputs, BinLayout bin = BinLayout::kNone);

/// A path by which ScanReader reads a file as `bin` says, where its extension is .bin; else the path as it is.
std::filesystem::path with_layout(const std::filesystem::path& path, BinLayout bin);

/// scan2 before scan10: runs of digits compare as numbers, all else byte by byte.
bool natural_less(std::string_view a, std::string_view b);

}  // namespace tcm_icp

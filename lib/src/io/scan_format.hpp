#pragma once
// Which format a file has: by what is in it, since names lie, and by its name where that says nothing.

#include <filesystem>
#include <string>

#include "input_buffer.hpp"

namespace tcm_icp {

enum class ScanFormat { kPly, kText, kPtx, kLas, kPcd, kE57 };

/// Takes nothing of `input`.
/// @throws InputError  if neither content nor name tells
ScanFormat format_of(InputBuffer& input);

/// Whether a file that cannot be read is a scan all the same: by its content, or by an extension that nothing else has.
bool is_surely_scan(const std::filesystem::path& file);

/// In lower case, with the dot, and without the .gz of a packed file.
std::string extension_of(const std::filesystem::path& path);

}  // namespace tcm_icp

#pragma once

#include <filesystem>
#include <string_view>

namespace tcm_icp {

/// Puts the text into a file of its own, in place of what was there. @throws OutputError
void write_text_file(const std::filesystem::path& path, std::string_view text);

}  // namespace tcm_icp

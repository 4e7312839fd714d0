#include "text_file.hpp"

#include <fstream>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {

void write_text_file(const std::filesystem::path& path, std::string_view text) {
  std::ofstream stream(path, std::ios::binary | std::ios::trunc);
  stream << text;
  stream.close();
  if (!stream) throw OutputError(path, "cannot be written", "check the folder's permissions and the disk's free space");
}

}  // namespace tcm_icp

#include "output_file.hpp"

#include <utility>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {

OutputFile::OutputFile(std::filesystem::path path) : path_(std::move(path)) {
  stream_.open(path_, std::ios::binary | std::ios::trunc);
  if (!stream_) throw OutputError(path_, "cannot be written", "check that the folder is there and may be written to");
}

void OutputFile::check() const {
  if (!stream_) throw OutputError(path_, "cannot be written", "check the free space on the disk");
}

void OutputFile::put(const void* bytes, std::size_t size) {
  stream_.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
  check();
}

std::uint64_t OutputFile::position() { return static_cast<std::uint64_t>(std::streamoff{stream_.tellp()}); }

void OutputFile::go_to(std::uint64_t position) {
  stream_.seekp(static_cast<std::streamoff>(position));  // writes what is buffered first
}

void OutputFile::close() {
  stream_.close();  // fails where the last bytes do not find room
  check();
}

}  // namespace tcm_icp

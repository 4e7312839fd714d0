#include "cloud_sink.hpp"

#include <utility>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {

CloudSink::CloudSink(std::filesystem::path path) : path_(std::move(path)) {
  stream_.open(path_, std::ios::binary | std::ios::trunc);
  if (!stream_) throw OutputError(path_, "cannot be written", "check that the folder is there and may be written to");
}

void CloudSink::check() const {
  if (!stream_) throw OutputError(path_, "cannot be written", "check the free space on the disk");
}

void CloudSink::put(const void* bytes, std::size_t size) {
  stream_.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
  check();
}

void CloudSink::go_to(std::uint64_t position) {
  stream_.seekp(static_cast<std::streamoff>(position));  // writes what is buffered first
}

void CloudSink::finish(std::uint64_t num_points) {
  complete(num_points);
  stream_.close();  // fails where the last bytes do not find room
  check();
}

std::string count_lines(const std::string& comment, const std::string& text, std::uint64_t count) {
  constexpr std::size_t kCountDigits = 20;  // of the largest 64-bit number
  const std::string digits = std::to_string(count);
  return comment + ' ' + std::string(1 + kCountDigits - digits.size(), '-') + '\n' + text + ' ' + digits + '\n';
}

}  // namespace tcm_icp

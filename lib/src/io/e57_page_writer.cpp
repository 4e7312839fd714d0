#include "e57_page_writer.hpp"

#include <algorithm>
#include <cstring>

#include "e57_pages.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {

E57PageWriter::E57PageWriter(std::filesystem::path path) : path_(std::move(path)), page_(kPage) {
  stream_.open(path_, std::ios::binary | std::ios::in | std::ios::out | std::ios::trunc);
  if (!stream_) throw OutputError(path_, "cannot be written", "check that the folder is there and may be written to");
}

void E57PageWriter::check() const {
  if (!stream_) throw OutputError(path_, "cannot be written", "check the free space on the disk");
}

void E57PageWriter::write_page(std::byte* page) {
  const std::uint32_t sum = crc32c(page, kPayload);
  for (std::size_t i = 0; i < 4; ++i) page[kPayload + i] = static_cast<std::byte>(sum >> (24 - 8 * i));  // big-endian
  stream_.write(reinterpret_cast<const char*>(page), kPage);
  check();
}

void E57PageWriter::put(const void* bytes, std::size_t size) {
  const auto* from = static_cast<const std::byte*>(bytes);
  while (size > 0) {
    const auto within = static_cast<std::size_t>(offset_ % kPayload);
    const std::size_t count = std::min(size, kPayload - within);
    std::memcpy(page_.data() + within, from, count);
    from += count;
    size -= count;
    offset_ += count;
    if (within + count == kPayload) write_page(page_.data());
  }
}

void E57PageWriter::replace(std::uint64_t offset, const std::string& bytes) {
  std::vector<std::byte> page(kPage);
  for (std::size_t done = 0; done < bytes.size();) {
    const std::uint64_t at = offset + done, start = at / kPayload * kPage;
    const auto within = static_cast<std::size_t>(at % kPayload);
    const std::size_t count = std::min(bytes.size() - done, kPayload - within);
    stream_.seekg(static_cast<std::streamoff>(start));
    stream_.read(reinterpret_cast<char*>(page.data()), kPage);
    std::memcpy(page.data() + within, bytes.data() + done, count);
    stream_.seekp(static_cast<std::streamoff>(start));
    write_page(page.data());
    done += count;
  }
}

void E57PageWriter::finish() {
  if (offset_ % kPayload != 0) {
    std::fill(page_.begin() + static_cast<std::ptrdiff_t>(offset_ % kPayload), page_.end(), std::byte{});
    write_page(page_.data());
  }
  for (const auto& [offset, bytes] : replaced_) replace(offset, bytes);
  stream_.close();  // fails where the last bytes do not find room
  check();
}

}  // namespace tcm_icp

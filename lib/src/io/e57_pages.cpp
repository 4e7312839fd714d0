#include "e57_pages.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "e57_layout.hpp"
#include "little_endian.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kCheckSum = 4;
constexpr std::size_t kLargestPage = std::size_t{1} << 20U;  // [bytes] the standard has 1024 for all files
constexpr std::size_t kLoad = std::size_t{1} << 18U;         // [bytes] pages read at once: few calls, little memory

using Table = std::array<std::array<std::uint32_t, 256>, 8>;

/// table[k][b]: the sum of the byte b with k zero bytes behind it.
Table make_table() {
  constexpr std::uint32_t kPolynomial = 0x82F63B78U;
  Table table{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t sum = byte;
    for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1U) ^ ((sum & 1U) != 0 ? kPolynomial : 0U);
    table[0][byte] = sum;
  }
  for (std::size_t byte = 0; byte < 256; ++byte) {
    for (std::size_t k = 1; k < table.size(); ++k) {
      table[k][byte] = (table[k - 1][byte] >> 8U) ^ table[0][table[k - 1][byte] & 255U];
    }
  }
  return table;
}

std::uint32_t big_endian(const std::byte* bytes) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = (value << 8U) | std::to_integer<std::uint32_t>(bytes[i]);
  return value;
}

#if defined(__x86_64__)
/// By the instruction that most processors have for this very sum.
__attribute__((target("sse4.2"))) std::uint32_t crc32c_by_instruction(const std::byte* bytes, std::size_t n) {
  std::uint64_t sum = ~std::uint32_t{0};
  for (; n >= 8; n -= 8, bytes += 8) sum = __builtin_ia32_crc32di(sum, load<std::uint64_t>(bytes));
  auto rest = static_cast<std::uint32_t>(sum);
  for (; n > 0; --n, ++bytes) rest = __builtin_ia32_crc32qi(rest, std::to_integer<std::uint8_t>(*bytes));
  return ~rest;
}
#endif

}  // namespace

std::uint32_t crc32c(const std::byte* bytes, std::size_t n) {
#if defined(__x86_64__)
  static const bool has_instruction = __builtin_cpu_supports("sse4.2") != 0;
  if (has_instruction) return crc32c_by_instruction(bytes, n);
#endif
  return crc32c_by_table(bytes, n);
}

std::uint32_t crc32c_by_table(const std::byte* bytes, std::size_t n) {
  static const Table table = make_table();
  std::uint32_t sum = ~std::uint32_t{0};
  for (; n >= 8; n -= 8, bytes += 8) {  // eight bytes a step: the sums must not cost more than the points
    const std::uint32_t low = sum ^ load<std::uint32_t>(bytes), high = load<std::uint32_t>(bytes + 4);
    sum = table[7][low & 255U] ^ table[6][(low >> 8U) & 255U] ^ table[5][(low >> 16U) & 255U] ^ table[4][low >> 24U] ^
          table[3][high & 255U] ^ table[2][(high >> 8U) & 255U] ^ table[1][(high >> 16U) & 255U] ^
          table[0][high >> 24U];
  }
  for (; n > 0; --n, ++bytes) sum = (sum >> 8U) ^ table[0][(sum ^ std::to_integer<std::uint32_t>(*bytes)) & 255U];
  return ~sum;
}

E57Pages::E57Pages(const std::filesystem::path& path) : path_(path), stream_(open_bytes(path)) {
  if (!stream_->size()) {
    throw InputError(path_, "", "is packed, but E57 files are read at several places", "unpack it first (gunzip)");
  }
  size_ = *stream_->size();
  read_header();
}

void E57Pages::fail(const std::string& place, const std::string& problem) const {
  throw InputError(path_, place, problem, "write or copy the file again");
}

void E57Pages::read_header() {
  std::array<std::byte, kE57FileHeader> bytes;
  if (size_ < kE57FileHeader || stream_->read(bytes.data(), bytes.size()) != bytes.size() ||
      std::memcmp(bytes.data(), "ASTM-E57", 8) != 0) {
    throw InputError(path_, "byte 0", "is not an E57 file: it does not begin with 'ASTM-E57'",
                     "give the file the extension of its format");
  }
  stream_at_ = kE57FileHeader;
  const auto major = load<std::uint32_t>(bytes.data() + 8);
  if (major != 1) fail("byte 8", "is of version " + std::to_string(major) + "; 1 is known");
  const auto length = load<std::uint64_t>(bytes.data() + 16), page_size = load<std::uint64_t>(bytes.data() + 40);
  xml_offset_ = load<std::uint64_t>(bytes.data() + 24);
  xml_length_ = load<std::uint64_t>(bytes.data() + 32);
  if (page_size < 2 * kE57FileHeader || page_size > kLargestPage) {
    fail("byte 40", "has pages of " + std::to_string(page_size) + " bytes; 1024 is usual");
  }
  page_size_ = static_cast<std::size_t>(page_size);
  payload_ = page_size_ - kCheckSum;
  if (length > size_) {
    fail("byte 16", "is cut off: it has " + std::to_string(size_) + " of " + std::to_string(length) + " bytes");
  }
  num_pages_ = size_ / page_size;
  const std::uint64_t begin = logical(xml_offset_, "its XML part");
  if (xml_length_ > logical_size() - begin) fail("byte 32", "has an XML part that is longer than the file");
}

std::uint64_t E57Pages::logical(std::uint64_t physical_offset, const std::string& what) const {
  const std::uint64_t page = physical_offset / page_size_, within = physical_offset % page_size_;
  if (page >= num_pages_ || within >= payload_) {
    fail("byte " + std::to_string(physical_offset), "is where " + what + " should begin, but cannot");
  }
  return page * payload_ + within;
}

void E57Pages::load_page(std::uint64_t page) {
  if (page >= num_pages_) fail("byte " + std::to_string(page * page_size_), "the file ends where more should follow");
  const std::uint64_t at = page * page_size_;
  if (at != stream_at_ && !stream_->seek(at)) fail("byte " + std::to_string(at), "is not to be reached");
  const std::size_t at_once = std::max<std::size_t>(1, kLoad / page_size_);
  num_loaded_ = std::min<std::uint64_t>(at_once, num_pages_ - page);
  first_loaded_ = page;
  pages_.resize(num_loaded_ * page_size_);
  if (stream_->read(pages_.data(), pages_.size()) != pages_.size()) {
    num_loaded_ = 0;
    fail("byte " + std::to_string(at), "the file has become shorter while it was read");
  }
  stream_at_ = at + pages_.size();
  for (std::uint64_t i = 0; i < num_loaded_; ++i) {
    const std::byte* const bytes = pages_.data() + i * page_size_;
    if (crc32c(bytes, payload_) != big_endian(bytes + payload_)) {
      num_loaded_ = 0;
      fail("byte " + std::to_string((page + i) * page_size_), "the check sum of this page is wrong: it is damaged");
    }
  }
}

void E57Pages::read(std::byte* to, std::size_t n) {
  while (n > 0) {
    const std::uint64_t page = at_ / payload_;
    const auto within = static_cast<std::size_t>(at_ % payload_);
    if (page < first_loaded_ || page >= first_loaded_ + num_loaded_) load_page(page);
    const std::size_t count = std::min(n, payload_ - within);
    std::memcpy(to, pages_.data() + (page - first_loaded_) * page_size_ + within, count);
    at_ += count;
    to += count;
    n -= count;
  }
}

}  // namespace tcm_icp

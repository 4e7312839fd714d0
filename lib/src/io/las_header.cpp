#include "las_header.hpp"

#include <array>
#include <memory>
#include <string_view>

#include "byte_stream.hpp"
#include "little_endian.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kShortestHeader = 227, kHeader14 = 375;
constexpr std::array<std::size_t, 11> kPointSizes{20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
constexpr std::size_t kVlrHeader = 54, kEvlrHeader = 60;
constexpr std::uint16_t kExtraBytesId = 4, kWellKnownTextId = 2112, kGeoKeysId = 34735;  // of records

enum class RecordKind { kExtraBytes, kWellKnownText, kGeoKeys, kOther };

class Parser {
 public:
  explicit Parser(InputBuffer& input) : input_(input) {}

  LasHeader parse() {
    const std::byte* const magic = input_.peek(4);
    if (!magic || input_.head(4) != "LASF") {
      throw InputError(input_.path(), "byte 0", "is not a LAS file: it does not begin with 'LASF'",
                       "give the file the extension of its format");
    }
    const std::byte* bytes = input_.peek(kShortestHeader);
    if (!bytes) fail("header", "ends within its header");
    const int minor = load<std::uint8_t>(bytes + 25);
    if (load<std::uint8_t>(bytes + 24) != 1 || minor > 4) {
      fail("byte 24", "is of version " + std::to_string(load<std::uint8_t>(bytes + 24)) + "." + std::to_string(minor) +
                          "; 1.0 to 1.4 are known");
    }
    header_size_ = load<std::uint16_t>(bytes + 94);
    if (header_size_ < (minor == 4 ? kHeader14 : kShortestHeader)) {
      fail("byte 94", "has a header of " + std::to_string(header_size_) + " bytes, too short for its version");
    }
    first_point_ = load<std::uint32_t>(bytes + 96);
    num_records_ = load<std::uint32_t>(bytes + 100);
    if (first_point_ < header_size_) fail("byte 96", "has its points within its header");
    read_point_layout(bytes);
    header_.num_points = load<std::uint32_t>(bytes + 107);
    for (std::ptrdiff_t axis = 0; axis < 3; ++axis) {
      header_.scale[axis] = load<double>(bytes + 131 + 8 * axis);
      header_.offset[axis] = load<double>(bytes + 155 + 8 * axis);
    }
    if (!header_.scale.allFinite() || !header_.offset.allFinite() || (header_.scale.array() == 0).any()) {
      fail("byte 131", "has no usable scale and offset of its coordinates");
    }
    if (minor == 4) read_long_fields();
    check_size();
    if (!input_.skip(header_size_)) fail("header", "ends within its header");
    read_records();
    read_records_behind();
    if (!input_.skip(first_point_ - input_.offset())) fail(input_.byte_place(), "ends before its first point");
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& place, const std::string& problem) const {
    throw InputError(input_.path(), place, problem, "write or copy the file again");
  }

  void read_point_layout(const std::byte* bytes) {
    const auto format = load<std::uint8_t>(bytes + 104);
    if ((format & 0xC0U) != 0) refuse_compressed();
    if (format >= kPointSizes.size()) fail("byte 104", "has the unknown point format " + std::to_string(format));
    header_.point_format = format;
    header_.record_size = load<std::uint16_t>(bytes + 105);
    if (header_.record_size < las_point_size(format)) {
      fail("byte 105", "has points of " + std::to_string(header_.record_size) + " bytes, but those of format " +
                           std::to_string(format) + " have " + std::to_string(las_point_size(format)));
    }
  }

  [[noreturn]] void refuse_compressed() const {
    const std::string name = input_.path().filename().string();
    std::string las = input_.path().stem().string() + ".las";
    if (las == name) las = input_.path().stem().string() + "_unpacked.las";
    const bool copc = input_.head(kHeader14 + 6).ends_with("copc");
    throw InputError(input_.path(), "",
                     std::string("is compressed (") + (copc ? "COPC" : "LAZ") + "), which is not read",
                     "convert it: pdal translate " + name + " " + las + ", or laszip -i " + name + " -o " + las);
  }

  void read_long_fields() {
    const std::byte* const bytes = input_.peek(kHeader14);
    if (!bytes) fail("header", "ends within its header");
    behind_ = load<std::uint64_t>(bytes + 235);
    num_behind_ = load<std::uint32_t>(bytes + 243);
    const auto count = load<std::uint64_t>(bytes + 247);
    if (count != 0) header_.num_points = count;  // 0 where a program filled the old field only
  }

  /// Where the size is known, a file cut off is told before any work is done with it.
  void check_size() const {
    if (!input_.size()) return;
    const std::uint64_t room = *input_.size() > first_point_ ? *input_.size() - first_point_ : 0;
    if (header_.num_points > room / header_.record_size) {
      fail("header", "promises " + std::to_string(header_.num_points) + " points, but has room for " +
                         std::to_string(room / header_.record_size));
    }
  }

  void read_records() {
    for (std::uint32_t i = 0; i < num_records_; ++i) {
      if (first_point_ - input_.offset() < kVlrHeader) return;
      const std::byte* const bytes = input_.peek(kVlrHeader);
      if (!bytes) return;
      const RecordKind kind = kind_of(bytes);
      const auto length = load<std::uint16_t>(bytes + 20);
      if (first_point_ - input_.offset() - kVlrHeader < length) return;
      input_.consume(kVlrHeader);
      if (kind == RecordKind::kOther) {
        if (!input_.skip(length)) return;
        continue;
      }
      const std::byte* const content = input_.peek(length);
      if (!content) return;
      use(kind, content, length);
      input_.consume(length);
    }
  }

  /// Records behind the points, which have the same head but for a longer length. What stands before the points holds.
  /// A gzip'd file would have to be unpacked as a whole; they are left alone there.
  void read_records_behind() {
    if (num_behind_ == 0 || !input_.size()) return;
    const std::unique_ptr<ByteStream> stream = open_bytes(input_.path());
    const std::uint64_t size = *input_.size();
    const bool had_extras = !header_.extras.empty(), had_system = !header_.coordinate_system.empty();
    std::vector<std::byte> head(kEvlrHeader), content;
    for (std::uint32_t i = 0; i < num_behind_; ++i) {
      if (behind_ > size || size - behind_ < kEvlrHeader || !stream->seek(behind_)) return;
      if (stream->read(head.data(), head.size()) != head.size()) return;
      const RecordKind kind = kind_of(head.data());
      const auto length = load<std::uint64_t>(head.data() + 20);
      behind_ += kEvlrHeader;
      if (length > size - behind_) return;
      const bool is_known = kind == RecordKind::kExtraBytes ? had_extras : had_system;
      if (kind != RecordKind::kOther && !is_known && length <= InputBuffer::kMaxLine) {
        content.resize(static_cast<std::size_t>(length));
        if (stream->read(content.data(), content.size()) != content.size()) return;
        use(kind, content.data(), content.size());
      }
      behind_ += length;
    }
  }

  /// @param head  of a record, up to its length
  static RecordKind kind_of(const std::byte* head) {
    const std::string_view user(reinterpret_cast<const char*>(head + 2), 16);
    const std::string_view name = user.substr(0, user.find('\0'));
    const auto id = load<std::uint16_t>(head + 18);
    if (name == "LASF_Spec" && id == kExtraBytesId) return RecordKind::kExtraBytes;
    if (name != "LASF_Projection") return RecordKind::kOther;
    if (id == kWellKnownTextId) return RecordKind::kWellKnownText;
    return id == kGeoKeysId ? RecordKind::kGeoKeys : RecordKind::kOther;
  }

  void use(RecordKind kind, const std::byte* content, std::size_t length) {
    if (kind == RecordKind::kExtraBytes) {
      for (std::size_t at = 0; at + kLasExtraEntry <= length; at += kLasExtraEntry) add_extra(content + at);
    } else if (kind == RecordKind::kWellKnownText) {
      const std::string_view text(reinterpret_cast<const char*>(content), length);
      header_.coordinate_system = text.substr(0, text.find('\0'));
    } else if (header_.coordinate_system.empty()) {
      header_.coordinate_system = epsg_code(content, length);
    }
  }

  /// "EPSG:26917" of a GeoTIFF key directory: its projected system, else its geographic one; empty where both are its
  /// own.
  static std::string epsg_code(const std::byte* keys, std::size_t length) {
    constexpr std::uint16_t kProjected = 3072, kGeographic = 2048, kOwn = 32767;
    std::uint16_t code = 0;
    for (std::size_t at = 8; at + 8 <= length; at += 8) {  // behind a head of the same size: key, place, count, value
      const auto key = load<std::uint16_t>(keys + at), place = load<std::uint16_t>(keys + at + 2);
      const auto value = load<std::uint16_t>(keys + at + 6);
      if (place != 0 || value == 0 || value == kOwn) continue;
      if (key == kProjected || (key == kGeographic && code == 0)) code = value;
    }
    return code == 0 ? std::string() : "EPSG:" + std::to_string(code);
  }

  void add_extra(const std::byte* entry) {
    static constexpr std::array<std::size_t, 11> kSizes{0, 1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    const int type = load<std::uint8_t>(entry + 2);
    const unsigned options = load<std::uint8_t>(entry + 3);
    std::string_view name(reinterpret_cast<const char*>(entry + 4), 32);
    name = name.substr(0, name.find('\0'));
    if (type == 0) {  // bytes without a meaning, as many as the options say
      extra_offset_ += options;
      return;
    }
    const int count = (type - 1) / 10 + 1;  // 11..20 are two, 21..30 three numbers of the types 1..10
    for (std::ptrdiff_t i = 0; i < count && type <= 30; ++i) {
      LasExtra extra;
      extra.name = name;
      if (count > 1) extra.name.append("_").append(std::to_string(i));
      extra.type = (type - 1) % 10 + 1;
      extra.offset = las_point_size(header_.point_format) + extra_offset_;
      extra_offset_ += kSizes[static_cast<std::size_t>(extra.type)];
      if (extra.offset + kSizes[static_cast<std::size_t>(extra.type)] > header_.record_size) return;
      constexpr unsigned kHasScale = 8, kHasOffset = 16;
      extra.is_scaled = (options & (kHasScale | kHasOffset)) != 0;
      if ((options & kHasScale) != 0) extra.scale = load<double>(entry + 112 + 8 * i);
      if ((options & kHasOffset) != 0) extra.shift = load<double>(entry + 136 + 8 * i);
      header_.extras.push_back(std::move(extra));
    }
  }

  InputBuffer& input_;
  LasHeader header_;
  std::uint64_t header_size_ = 0, first_point_ = 0;
  std::uint32_t num_records_ = 0;
  std::uint64_t behind_ = 0;  ///< [bytes] where the records behind the points begin
  std::uint32_t num_behind_ = 0;
  std::size_t extra_offset_ = 0;  ///< [bytes] behind the point proper
};

}  // namespace

std::size_t las_point_size(int format) { return kPointSizes[static_cast<std::size_t>(format)]; }

LasHeader read_las_header(InputBuffer& input) { return Parser(input).parse(); }

}  // namespace tcm_icp

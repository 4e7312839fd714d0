#include "e57_writer.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <string_view>
#include <utility>

#include "core/xml_text.hpp"
#include "scalar.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

constexpr std::size_t kFileHeader = 48, kSectionHeader = 32, kPacketHeader = 6;
constexpr std::size_t kLargestPacket = 65536, kMostIndexEntries = 2048;  // of an index packet

/// Fields of the standard, and of its extension for normals, by our names.
constexpr std::array<std::pair<std::string_view, const char*>, 8> kUsual{{{"x", "cartesianX"},
                                                                          {"y", "cartesianY"},
                                                                          {"z", "cartesianZ"},
                                                                          {"intensity", "intensity"},
                                                                          {"time", "timeStamp"},
                                                                          {"nx", "nor:normalX"},
                                                                          {"ny", "nor:normalY"},
                                                                          {"nz", "nor:normalZ"}}};
/// Fields that are whole numbers.
constexpr std::array<std::pair<std::string_view, const char*>, 7> kUsualIntegers{{{"red", "colorRed"},
                                                                                  {"green", "colorGreen"},
                                                                                  {"blue", "colorBlue"},
                                                                                  {"rowIndex", "rowIndex"},
                                                                                  {"columnIndex", "columnIndex"},
                                                                                  {"return_index", "returnIndex"},
                                                                                  {"return_count", "returnCount"}}};
constexpr std::array<std::string_view, 3> kFlags{"isIntensityInvalid", "isColorInvalid", "isTimeStampInvalid"};

void append(std::string& bytes, const auto& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string digits(double value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// Lowest and highest integer of a type.
std::pair<std::int64_t, std::int64_t> range_of(ScalarType type) {
  const auto bits = static_cast<unsigned>(8 * scalar_size(type));
  const std::int64_t span = (std::int64_t{1} << bits) - 1;
  const bool is_signed = type == ScalarType::kInt8 || type == ScalarType::kInt16 || type == ScalarType::kInt32;
  const std::int64_t low = is_signed ? -(std::int64_t{1} << (bits - 1)) : 0;
  return {low, low + span};
}

/// A name that XML and readers of E57 take: letters, digits and _.- behind a letter or _.
std::string element_name(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const bool is_letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
    const bool is_other = (c >= '0' && c <= '9') || c == '.' || c == '-';
    if (out.empty() && !is_letter) out += '_';
    if (!out.empty() || is_letter) out += is_letter || is_other ? c : '_';
  }
  return out.empty() ? "_" : out;
}

void mix(std::array<std::uint64_t, 2>& digest, const void* bytes, std::size_t size) {
  const auto* from = static_cast<const unsigned char*>(bytes);
  while (size > 0) {
    std::uint64_t word = 0;
    const std::size_t count = std::min<std::size_t>(size, sizeof word);
    std::memcpy(&word, from, count);
    digest[0] = (digest[0] ^ word) * 0x9E3779B97F4A7C15U;
    digest[0] ^= digest[0] >> 29U;
    digest[1] = (digest[1] + digest[0]) * 0xBF58476D1CE4E5B9U;
    digest[1] ^= digest[1] >> 32U;
    from += count;
    size -= count;
  }
}

/// What identifies the content: the same for the same, in every run (a UUID of version 8, RFC 9562).
std::string guid_of(const std::array<std::uint64_t, 2>& digest) {
  static constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string text = "{";
  for (unsigned i = 0; i < 32; ++i) {
    if (i == 8 || i == 12 || i == 16 || i == 20) text += '-';
    auto nibble = static_cast<unsigned>(digest[i / 16] >> (60 - 4 * (i % 16)) & 15U);
    if (i == 12) nibble = 8;
    if (i == 16) nibble = 8 | (nibble & 3U);
    text += kHex[nibble];
  }
  return text + "}";
}

std::string text_element(const std::string& name, std::string_view text) {
  return "<" + name + " type=\"String\">" + xml_escaped(text) + "</" + name + ">\n";
}

std::string float_element(const std::string& name, double value) {
  return "<" + name + " type=\"Float\">" + digits(value) + "</" + name + ">\n";
}

std::string integer_element(const std::string& name, std::int64_t value) {
  return "<" + name + " type=\"Integer\">" + std::to_string(value) + "</" + name + ">\n";
}

std::string structure(const std::string& name, const std::string& content) {
  return "<" + name + " type=\"Structure\">\n" + content + "</" + name + ">\n";
}

std::string pose_xml(const Eigen::Isometry3d& T) {
  Eigen::Quaterniond q(T.linear());
  q.normalize();
  if (q.w() < 0) q.coeffs() *= -1;
  const Eigen::Vector3d t = T.translation();
  return structure("pose", structure("rotation", float_element("w", q.w()) + float_element("x", q.x()) +
                                                     float_element("y", q.y()) + float_element("z", q.z())) +
                               structure("translation", float_element("x", t.x()) + float_element("y", t.y()) +
                                                            float_element("z", t.z())));
}

}  // namespace

E57Writer::E57Writer(std::filesystem::path path) : pages_(std::move(path)) {
  pages_.put(std::string(kFileHeader, '\0'));
}

E57Writer::Column E57Writer::column_of(const RecordColumn& record, const std::vector<Column>& others) {
  Column column;
  column.type = record.type;
  column.from = record.offset;
  column.coding = record.type == ScalarType::kFloat64   ? Coding::kFloat64
                  : record.type == ScalarType::kFloat32 ? Coding::kFloat32
                                                        : Coding::kInteger;
  for (const auto& [ours, theirs] : kUsual) {
    if (record.name == ours) column.name = theirs;
  }
  for (const auto& [ours, theirs] : kUsualIntegers) {
    if (record.name == ours && column.coding == Coding::kInteger) column.name = theirs;
  }
  for (const auto flag : kFlags) {
    if (record.name != flag || record.type != ScalarType::kUInt8) continue;
    column.name = flag;
    column.coding = Coding::kFlag;
  }
  if (!column.name.empty()) return column;
  const std::string name = kE57Prefix + element_name(record.name);
  column.name = name;
  const auto is_taken = [&](const Column& other) { return other.name == column.name; };
  for (int k = 2; std::any_of(others.begin(), others.end(), is_taken); ++k)
    column.name = name + '_' + std::to_string(k);
  return column;
}

void E57Writer::check_size(Scan& scan) const {
  std::size_t bits = 0;
  for (const Column& column : scan.columns) bits += column.coding == Coding::kFlag ? 1 : 8 * scalar_size(column.type);
  constexpr std::size_t kStep = 8;  // so that every column of a full packet ends with a byte
  const std::size_t head = kPacketHeader + 2 * scan.columns.size();
  const std::size_t room = head < kLargestPacket ? kLargestPacket - head : 0;
  scan.packet_points = std::min(8 * room / bits / kStep * kStep, kLargestPacket / 2);
  if (scan.packet_points == 0) {
    throw OutputError(pages_.path(), "cannot hold " + std::to_string(scan.columns.size()) + " columns a point",
                      "use --format ply");
  }
}

void E57Writer::begin_scan(const std::string& name, const Eigen::Isometry3d& T_file_scan, const RecordLayout& layout) {
  end_scan();
  Scan scan;
  scan.name = name;
  scan.T_file_scan = T_file_scan;
  scan.record_size = layout.size;
  for (const RecordColumn& column : layout.columns) scan.columns.push_back(column_of(column, scan.columns));
  check_size(scan);
  scan.offset = pages_.offset();
  scan.digest = {scans_.size() + 1, 0};
  mix(scan.digest, name.data(), name.size());
  mix(scan.digest, T_file_scan.matrix().data(), 16 * sizeof(double));
  pages_.put(std::string(kSectionHeader, '\0'));
  scans_.push_back(std::move(scan));
}

void E57Writer::write(const std::byte* records, std::size_t count) {
  Scan& scan = scans_.back();
  mix(scan.digest, records, count * scan.record_size);
  waiting_.insert(waiting_.end(), records, records + count * scan.record_size);
  scan.num_points += count;
  const std::size_t packet_bytes = scan.packet_points * scan.record_size;
  std::size_t done = 0;
  for (; waiting_.size() - done >= packet_bytes; done += packet_bytes) {
    write_packet(waiting_.data() + done, scan.packet_points);
  }
  waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(done));
}

/// Column by column.
void E57Writer::write_packet(const std::byte* records, std::size_t count) {
  Scan& scan = scans_.back();
  std::string body;
  packet_.clear();
  for (Column& column : scan.columns) {
    const std::size_t size = scalar_size(column.type), begin = packet_.size();
    const std::byte* from = records + column.from;
    packet_.resize(begin + (column.coding == Coding::kFlag ? (count + 7) / 8 : count * size));
    char* const to = packet_.data() + begin;
    const std::int64_t low = column.coding == Coding::kInteger ? range_of(column.type).first : 0;
    for (std::size_t i = 0; i < count; ++i, from += scan.record_size) {
      const double value = load_scalar(from, column.type);
      column.least = std::min(column.least, value);
      column.most = std::max(column.most, value);
      if (column.coding == Coding::kFlag) {
        if (value != 0) to[i / 8] = static_cast<char>(to[i / 8] | 1 << i % 8);
      } else if (low != 0) {  // numbers are stored from their lowest on
        const auto number = static_cast<std::uint32_t>(static_cast<std::int64_t>(value) - low);
        std::memcpy(to + i * size, &number, size);
      } else {
        std::memcpy(to + i * size, from, size);
      }
    }
    append(body, static_cast<std::uint16_t>(packet_.size() - begin));
  }
  body += packet_;
  while ((kPacketHeader + body.size()) % 4 != 0) body += '\0';
  std::string header;
  append(header, std::uint8_t{1});  // of data
  append(header, std::uint8_t{0});
  append(header, static_cast<std::uint16_t>(kPacketHeader + body.size() - 1));
  append(header, static_cast<std::uint16_t>(scan.columns.size()));
  scan.packets.push_back(pages_.offset());
  pages_.put(header);
  pages_.put(body);
}

/// Where to find some of the packets, so that a reader may jump to a point.
void E57Writer::write_index(const Scan& scan) {
  const std::size_t step = (scan.packets.size() + kMostIndexEntries - 1) / kMostIndexEntries;
  std::string entries;
  for (std::size_t i = 0; i < scan.packets.size(); i += step) {
    append(entries, std::uint64_t{i} * scan.packet_points);
    append(entries, E57PageWriter::physical(scan.packets[i]));
  }
  std::string packet(16, '\0');  // type 0, level 0
  const auto length = static_cast<std::uint16_t>(packet.size() + entries.size() - 1);
  const auto count = static_cast<std::uint16_t>(entries.size() / 16);
  std::memcpy(packet.data() + 2, &length, sizeof length);
  std::memcpy(packet.data() + 4, &count, sizeof count);
  pages_.put(packet + entries);
}

void E57Writer::end_scan() {
  if (scans_.empty()) return;
  const Scan& scan = scans_.back();
  if (!waiting_.empty()) write_packet(waiting_.data(), waiting_.size() / scan.record_size);
  waiting_.clear();
  std::uint64_t index = 0, data = scan.offset + kSectionHeader;
  if (!scan.packets.empty()) {
    index = pages_.offset();
    data = scan.packets.front();
    write_index(scan);
  }
  std::string header(8, '\0');
  header[0] = 1;  // a section of points
  append(header, pages_.offset() - scan.offset);
  append(header, E57PageWriter::physical(data));
  append(header, index == 0 ? std::uint64_t{0} : E57PageWriter::physical(index));
  pages_.replace_later(scan.offset, header);
}

std::string E57Writer::scan_xml(const Scan& scan, const std::string& description) {
  std::string out = text_element("guid", guid_of(scan.digest)) + text_element("name", scan.name) +
                    text_element("description", description) + pose_xml(scan.T_file_scan);
  std::string prototype, bounds;
  for (std::size_t i = 0; i < scan.columns.size(); ++i) {
    const Column& column = scan.columns[i];
    prototype += "<" + column.name;
    if (column.coding == Coding::kFloat32) prototype += " type=\"Float\" precision=\"single\"/>\n";
    if (column.coding == Coding::kFloat64) prototype += " type=\"Float\"/>\n";
    if (column.coding == Coding::kInteger || column.coding == Coding::kFlag) {
      const auto [low, high] =
          column.coding == Coding::kFlag ? std::pair<std::int64_t, std::int64_t>{0, 1} : range_of(column.type);
      prototype +=
          " type=\"Integer\" minimum=\"" + std::to_string(low) + "\" maximum=\"" + std::to_string(high) + "\"/>\n";
    }
    const bool has_values = column.least <= column.most;
    if (i < 3 && has_values) {
      const std::string axis(1, static_cast<char>('x' + i));
      bounds += float_element(axis + "Minimum", column.least) + float_element(axis + "Maximum", column.most);
    }
    if (column.name == "intensity") {
      const auto limit = [&](const char* name, double value) {
        if (!has_values) value = 0;
        return column.coding == Coding::kInteger ? integer_element(name, static_cast<std::int64_t>(value))
                                                 : float_element(name, value);
      };
      out += structure("intensityLimits",
                       limit("intensityMinimum", column.least) + limit("intensityMaximum", column.most));
    }
  }
  std::string colours;
  for (const Column& column : scan.columns) {
    if (!column.name.starts_with("color")) continue;
    const auto [low, high] = range_of(column.type);
    colours += integer_element(column.name + "Minimum", low) + integer_element(column.name + "Maximum", high);
  }
  if (!colours.empty()) out += structure("colorLimits", colours);
  if (!bounds.empty()) out += structure("cartesianBounds", bounds);
  out += "<points type=\"CompressedVector\" fileOffset=\"" + std::to_string(E57PageWriter::physical(scan.offset)) +
         "\" recordCount=\"" + std::to_string(scan.num_points) + "\">\n" + structure("prototype", prototype) +
         "<codecs type=\"Vector\" allowHeterogeneousChildren=\"1\"/>\n</points>\n";
  return out;
}

std::string E57Writer::xml(const std::string& description, const std::string& coordinate_system) const {
  std::array<std::uint64_t, 2> digest{};
  std::string scans;
  for (const Scan& scan : scans_) {
    mix(digest, scan.digest.data(), sizeof scan.digest);
    scans += structure("vectorChild", scan_xml(scan, description));
  }
  std::string system = coordinate_system;  // often in lines, which mean nothing
  std::replace_if(
      system.begin(), system.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<e57Root type=\"Structure\" xmlns=\"http://www.astm.org/COMMIT/E57/2010-e57-v1.0\" "
         "xmlns:nor=\"http://www.libe57.org/E57_NOR_surface_normals.txt\" xmlns:tcm=\"urn:tcm-icp:attributes\">\n" +
         text_element("formatName", "ASTM E57 3D Imaging Data File") + text_element("guid", guid_of(digest)) +
         integer_element("versionMajor", 1) + integer_element("versionMinor", 0) +
         text_element("e57LibraryVersion", "tcm-icp") +
         (system.empty() ? std::string() : text_element("coordinateMetadata", system)) +
         "<data3D type=\"Vector\" allowHeterogeneousChildren=\"1\">\n" + scans +
         "</data3D>\n<images2D type=\"Vector\" allowHeterogeneousChildren=\"1\">\n</images2D>\n</e57Root>\n";
}

void E57Writer::finish(const std::string& description, const std::string& coordinate_system) {
  end_scan();
  const std::uint64_t xml_at = pages_.offset();
  const std::string text = xml(description, coordinate_system);
  pages_.put(text);
  std::string header = "ASTM-E57";
  append(header, std::uint32_t{1});
  append(header, std::uint32_t{0});
  append(header, pages_.physical_size());
  append(header, E57PageWriter::physical(xml_at));
  append(header, std::uint64_t{text.size()});
  append(header, std::uint64_t{E57PageWriter::kPage});
  pages_.replace_later(0, header);
  pages_.finish();
}

}  // namespace tcm_icp

#include "e57_writer.hpp"

#include <algorithm>
#include <cstring>
#include <string_view>
#include <utility>

#include "e57_layout.hpp"
#include "scalar.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

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

}  // namespace

E57Writer::E57Writer(std::filesystem::path path) : pages_(std::move(path)) {
  pages_.put(std::string(kE57FileHeader, '\0'));
}

E57Column E57Writer::column_of(const RecordColumn& record, const std::vector<E57Column>& others) {
  E57Column column;
  column.type = record.type;
  column.from = record.offset;
  column.coding = record.type == ScalarType::kFloat64   ? E57Coding::kFloat64
                  : record.type == ScalarType::kFloat32 ? E57Coding::kFloat32
                                                        : E57Coding::kInteger;
  for (const auto& [ours, theirs] : kUsual) {
    if (record.name == ours) column.name = theirs;
  }
  for (const auto& [ours, theirs] : kUsualIntegers) {
    if (record.name == ours && column.coding == E57Coding::kInteger) column.name = theirs;
  }
  for (const auto flag : kFlags) {
    if (record.name != flag || record.type != ScalarType::kUInt8) continue;
    column.name = flag;
    column.coding = E57Coding::kFlag;
  }
  if (!column.name.empty()) return column;
  const std::string name = kE57Prefix + element_name(record.name);
  column.name = name;
  const auto is_taken = [&](const E57Column& other) { return other.name == column.name; };
  for (int k = 2; std::any_of(others.begin(), others.end(), is_taken); ++k) {
    column.name = name + '_' + std::to_string(k);
  }
  return column;
}

void E57Writer::check_size(Scan& scan) const {
  std::size_t bits = 0;
  for (const E57Column& column : scan.columns) {
    bits += column.coding == E57Coding::kFlag ? 1 : 8 * scalar_size(column.type);
  }
  constexpr std::size_t kStep = 8;  // so that every column of a full packet ends with a byte
  const std::size_t head = kE57PacketHeader + 2 * scan.columns.size();
  const std::size_t room = head < kLargestPacket ? kLargestPacket - head : 0;
  scan.packet_points = std::min(8 * room / std::max<std::size_t>(bits, 1) / kStep * kStep, kLargestPacket / 2);
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
  scan.physical_offset = E57PageWriter::physical(scan.offset);
  const std::uint64_t number = scans_.size();
  scan.digest.add(&number, sizeof number);
  scan.digest.add(name.data(), name.size());
  scan.digest.add(T_file_scan.matrix().data(), 16 * sizeof(double));
  pages_.put(std::string(kE57SectionHeader, '\0'));
  scans_.push_back(std::move(scan));
}

void E57Writer::write(const std::byte* records, std::size_t count) {
  Scan& scan = scans_.back();
  scan.digest.add(records, count * scan.record_size);
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
  for (E57Column& column : scan.columns) {
    const std::size_t size = scalar_size(column.type), begin = packet_.size();
    const std::byte* from = records + column.from;
    packet_.resize(begin + (column.coding == E57Coding::kFlag ? (count + 7) / 8 : count * size));
    char* const to = packet_.data() + begin;
    const std::int64_t low = column.coding == E57Coding::kInteger ? e57_range(column.type).first : 0;
    for (std::size_t i = 0; i < count; ++i, from += scan.record_size) {
      const double value = load_scalar(from, column.type);
      column.least = std::min(column.least, value);
      column.most = std::max(column.most, value);
      if (column.coding == E57Coding::kFlag) {
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
  while ((kE57PacketHeader + body.size()) % 4 != 0) body += '\0';
  std::string header;
  append(header, std::uint8_t{1});  // of data
  append(header, std::uint8_t{0});
  append(header, static_cast<std::uint16_t>(kE57PacketHeader + body.size() - 1));
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
  std::uint64_t index = 0, data = scan.offset + kE57SectionHeader;
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

void E57Writer::finish(const std::string& description, const std::string& coordinate_system) {
  end_scan();
  const std::uint64_t xml_at = pages_.offset();
  std::vector<E57WrittenScan> scans(scans_.begin(), scans_.end());
  const std::string text = e57_xml(scans, description, coordinate_system);
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

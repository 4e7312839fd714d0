#pragma once
// E57 files put together by hand.

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "io/binary_text.hpp"

namespace tcm_icp::test {

/// A column: its element in the prototype and its byte stream.
struct E57Column {
  std::string name, type;  ///< "cartesianX", `type="Float"`
  std::string bytes;
};

struct E57Parts {
  std::uint64_t num_points = 0;
  std::vector<E57Column> columns;
  std::string pose;             ///< XML
  std::size_t num_packets = 1;  ///< the columns are cut into, each at other places
  std::uint8_t section_id = 1;  ///< 1: of points
};

/// CRC-32C, bit by bit.
inline std::uint32_t slow_crc32c(const std::string& bytes) {
  std::uint32_t sum = 0xFFFFFFFFU;
  for (const char c : bytes) {
    sum ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1U) ^ ((sum & 1U) != 0 ? 0x82F63B78U : 0U);
  }
  return ~sum;
}

/// Integers of `bits` bits, lowest first, one behind the other.
inline std::string packed_bits(const std::vector<std::uint64_t>& values, unsigned bits) {
  std::string out((values.size() * bits + 7) / 8, '\0');
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (unsigned bit = 0; bit < bits; ++bit) {
      const std::size_t at = i * bits + bit;
      if ((values[i] >> bit & 1U) != 0) out[at / 8] = static_cast<char>(out[at / 8] | 1 << (at % 8));
    }
  }
  return out;
}

inline std::uint64_t e57_physical(std::uint64_t logical) { return logical / 1020 * 1024 + logical % 1020; }

inline std::string e57_packet(const std::vector<std::string>& pieces) {
  std::string body;
  for (const auto& piece : pieces) body += joined(static_cast<std::uint16_t>(piece.size()));
  for (const auto& piece : pieces) body += piece;
  while ((body.size() + 6) % 4 != 0) body += '\0';
  return joined(std::uint8_t{1}, std::uint8_t{0}, static_cast<std::uint16_t>(body.size() + 5),
                static_cast<std::uint16_t>(pieces.size())) +
         body;
}

/// The section of a scan's points that begins at `at` [bytes, logical]: an index packet, then those of the data.
inline std::string e57_section(const E57Parts& scan, std::uint64_t at) {
  std::string packets = joined(std::uint8_t{0}, std::uint8_t{0}, std::uint16_t{15}) + std::string(12, '\0');
  for (std::size_t k = 0; k < scan.num_packets; ++k) {
    std::vector<std::string> pieces;
    for (std::size_t c = 0; c < scan.columns.size(); ++c) {
      const std::string& bytes = scan.columns[c].bytes;
      const auto cut = [&](std::size_t i) {
        return i == scan.num_packets ? bytes.size()
                                     : std::min(bytes.size(), bytes.size() * i / scan.num_packets + c % 3);
      };
      pieces.push_back(bytes.substr(k == 0 ? 0 : cut(k), cut(k + 1) - (k == 0 ? 0 : cut(k))));
    }
    packets += e57_packet(pieces);
  }
  return padded(joined(scan.section_id), 8) +
         joined(std::uint64_t{32} + packets.size(), e57_physical(at + 32), std::uint64_t{0}) + packets;
}

inline std::string e57_file(const std::vector<E57Parts>& scans) {
  std::string content(48, '\0');
  std::string xml =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<e57Root type=\"Structure\" xmlns=\"x\"><data3D type=\"Vector\">";
  for (const E57Parts& scan : scans) {
    while (content.size() % 4 != 0) content += '\0';
    xml += "<vectorChild type=\"Structure\">" + scan.pose + "<points type=\"CompressedVector\" fileOffset=\"" +
           std::to_string(e57_physical(content.size())) + "\" recordCount=\"" + std::to_string(scan.num_points) +
           "\"><prototype type=\"Structure\">";
    for (const auto& column : scan.columns) xml += "<" + column.name + " " + column.type + "/>";
    xml += "</prototype><codecs type=\"Vector\"/></points></vectorChild>";
    content += e57_section(scan, content.size());
  }
  xml += "</data3D></e57Root>";
  const std::uint64_t xml_at = content.size();
  content += xml;
  const std::size_t num_pages = (content.size() + 1019) / 1020;
  const std::string header = "ASTM-E57" + joined(std::uint32_t{1}, std::uint32_t{0}, std::uint64_t{num_pages * 1024},
                                                 e57_physical(xml_at), std::uint64_t{xml.size()}, std::uint64_t{1024});
  content.replace(0, header.size(), header);
  std::string file;
  for (std::size_t page = 0; page < num_pages; ++page) {
    const std::string payload = padded(content.substr(page * 1020, 1020), 1020);
    file += payload + bytes_of(slow_crc32c(payload), Order::kBig);
  }
  return file;
}

}  // namespace tcm_icp::test

#include "e57_xml.hpp"

#include <algorithm>
#include <cstring>

#include "core/unit_quaternion.hpp"
#include "core/xml_text.hpp"
#include "number_text.hpp"

namespace tcm_icp {
namespace {

std::string text_element(const std::string& name, std::string_view text) {
  return "<" + name + " type=\"String\">" + xml_escaped(text) + "</" + name + ">\n";
}

std::string float_element(const std::string& name, double value) {
  return "<" + name + " type=\"Float\">" + shortest_digits(value) + "</" + name + ">\n";
}

std::string integer_element(const std::string& name, std::int64_t value) {
  return "<" + name + " type=\"Integer\">" + std::to_string(value) + "</" + name + ">\n";
}

std::string structure(const std::string& name, const std::string& content) {
  return "<" + name + " type=\"Structure\">\n" + content + "</" + name + ">\n";
}

std::string pose_xml(const Eigen::Isometry3d& T) {
  const Eigen::Quaterniond q = unit_quaternion(T);
  const Eigen::Vector3d t = T.translation();
  return structure("pose", structure("rotation", float_element("w", q.w()) + float_element("x", q.x()) +
                                                     float_element("y", q.y()) + float_element("z", q.z())) +
                               structure("translation", float_element("x", t.x()) + float_element("y", t.y()) +
                                                            float_element("z", t.z())));
}

std::string scan_xml(const E57WrittenScan& scan, const std::string& description) {
  std::string out = text_element("guid", scan.digest.guid()) + text_element("name", scan.name) +
                    text_element("description", description) + pose_xml(scan.T_file_scan);
  std::string prototype, bounds;
  for (std::size_t i = 0; i < scan.columns.size(); ++i) {
    const E57Column& column = scan.columns[i];
    prototype += "<" + column.name;
    if (column.coding == E57Coding::kFloat32) prototype += " type=\"Float\" precision=\"single\"/>\n";
    if (column.coding == E57Coding::kFloat64) prototype += " type=\"Float\"/>\n";
    if (column.coding == E57Coding::kInteger || column.coding == E57Coding::kFlag) {
      const auto [low, high] =
          column.coding == E57Coding::kFlag ? std::pair<std::int64_t, std::int64_t>{0, 1} : e57_range(column.type);
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
        return column.coding == E57Coding::kInteger ? integer_element(name, static_cast<std::int64_t>(value))
                                                    : float_element(name, value);
      };
      out += structure("intensityLimits",
                       limit("intensityMinimum", column.least) + limit("intensityMaximum", column.most));
    }
  }
  std::string colours;
  for (const E57Column& column : scan.columns) {
    if (!column.name.starts_with("color")) continue;
    const auto [low, high] = e57_range(column.type);
    colours += integer_element(column.name + "Minimum", low) + integer_element(column.name + "Maximum", high);
  }
  if (!colours.empty()) out += structure("colorLimits", colours);
  if (!bounds.empty()) out += structure("cartesianBounds", bounds);
  out += "<points type=\"CompressedVector\" fileOffset=\"" + std::to_string(scan.physical_offset) +
         "\" recordCount=\"" + std::to_string(scan.num_points) + "\">\n" + structure("prototype", prototype) +
         "<codecs type=\"Vector\" allowHeterogeneousChildren=\"1\"/>\n</points>\n";
  return out;
}

}  // namespace

std::pair<std::int64_t, std::int64_t> e57_range(ScalarType type) {
  const auto bits = static_cast<unsigned>(8 * scalar_size(type));
  const std::int64_t span = (std::int64_t{1} << bits) - 1;
  const bool is_signed = type == ScalarType::kInt8 || type == ScalarType::kInt16 || type == ScalarType::kInt32;
  const std::int64_t low = is_signed ? -(std::int64_t{1} << (bits - 1)) : 0;
  return {low, low + span};
}

void E57Digest::add(const void* bytes, std::size_t size) {
  const auto* from = static_cast<const unsigned char*>(bytes);
  while (size > 0) {
    std::uint64_t word = 0;
    const std::size_t count = std::min<std::size_t>(size, sizeof word);
    std::memcpy(&word, from, count);
    state_[0] = (state_[0] ^ word) * 0x9E3779B97F4A7C15U;
    state_[0] ^= state_[0] >> 29U;
    state_[1] = (state_[1] + state_[0]) * 0xBF58476D1CE4E5B9U;
    state_[1] ^= state_[1] >> 32U;
    from += count;
    size -= count;
  }
}

/// A UUID of version 8 (RFC 9562).
std::string E57Digest::guid() const {
  static constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string text = "{";
  for (unsigned i = 0; i < 32; ++i) {
    if (i == 8 || i == 12 || i == 16 || i == 20) text += '-';
    auto nibble = static_cast<unsigned>(state_[i / 16] >> (60 - 4 * (i % 16)) & 15U);
    if (i == 12) nibble = 8;
    if (i == 16) nibble = 8 | (nibble & 3U);
    text += kHex[nibble];
  }
  return text + "}";
}

std::string e57_xml(const std::vector<E57WrittenScan>& scans, const std::string& description,
                    const std::string& coordinate_system) {
  E57Digest digest;
  std::string entries;
  for (const E57WrittenScan& scan : scans) {
    const std::string guid = scan.digest.guid();
    digest.add(guid.data(), guid.size());
    entries += structure("vectorChild", scan_xml(scan, description));
  }
  std::string system = coordinate_system;  // often in lines, which mean nothing
  std::replace_if(
      system.begin(), system.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<e57Root type=\"Structure\" xmlns=\"http://www.astm.org/COMMIT/E57/2010-e57-v1.0\" "
         "xmlns:nor=\"http://www.libe57.org/E57_NOR_surface_normals.txt\" xmlns:tcm=\"urn:tcm-icp:attributes\">\n" +
         text_element("formatName", "ASTM E57 3D Imaging Data File") + text_element("guid", digest.guid()) +
         integer_element("versionMajor", 1) + integer_element("versionMinor", 0) +
         text_element("e57LibraryVersion", "tcm-icp") +
         (system.empty() ? std::string() : text_element("coordinateMetadata", system)) +
         "<data3D type=\"Vector\" allowHeterogeneousChildren=\"1\">\n" + entries +
         "</data3D>\n<images2D type=\"Vector\" allowHeterogeneousChildren=\"1\">\n</images2D>\n</e57Root>\n";
}

}  // namespace tcm_icp

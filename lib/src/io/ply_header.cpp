#include "ply_header.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <string_view>

#include "fields.hpp"
#include "scalar.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

class HeaderParser {
 public:
  explicit HeaderParser(InputBuffer& input) : input_(input) {}

  PlyHeader parse() {
    if (input_.head(3) == "\xEF\xBB\xBF") input_.consume(3);
    const std::byte* const magic = input_.peek(3);
    if (!magic || std::memcmp(magic, "ply", 3) != 0) {
      throw InputError(input_.path(), "byte 0", "is not a PLY file: it does not begin with 'ply'",
                       "give the file the extension of its format");
    }
    next_line();
    if (fields_.size() != 1 || fields_[0] != "ply") fail("holds more than 'ply'");
    for (next_line(); fields_.empty() || fields_[0] != "end_header"; next_line()) parse_line();
    check();
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(input_.path(), "header line " + std::to_string(input_.line_number()), problem,
                     "write the file again with another program");
  }

  void next_line() {
    std::string_view line;
    if (!input_.next_line(line)) fail("is the last line, but the header has no 'end_header'");
    // The header's length bounds what it can make us allocate.
    if (input_.offset() > InputBuffer::kMaxLine) fail("is past 1 MiB, but the header has no 'end_header' yet");
    split_fields(line, ' ', fields_);
  }

  void parse_line() {
    if (fields_.empty() || fields_[0] == "comment" || fields_[0] == "obj_info") return;
    if (fields_[0] == "format") return parse_format();
    if (fields_[0] == "element") return parse_element();
    if (fields_[0] == "property") return parse_property();
    fail("begins with " + quoted(fields_[0]) + ", which PLY does not know");
  }

  void parse_format() {
    if (has_format_) fail("is a second 'format' line");
    if (fields_.size() != 3) fail("is not 'format NAME VERSION'");
    if (fields_[1] == "ascii") {
      header_.format = PlyFormat::kAscii;
    } else if (fields_[1] == "binary_little_endian") {
      header_.format = PlyFormat::kBinaryLittleEndian;
    } else if (fields_[1] == "binary_big_endian") {
      header_.format = PlyFormat::kBinaryBigEndian;
    } else {
      fail("names the unknown format " + quoted(fields_[1]));
    }
    if (fields_[2] != "1.0") fail("names the unknown version " + quoted(fields_[2]) + " (1.0 is known)");
    has_format_ = true;
  }

  void parse_element() {
    if (fields_.size() != 3) fail("is not 'element NAME COUNT'");
    PlyElement element;
    element.name = fields_[1];
    const std::string_view count = fields_[2];
    const auto [rest, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (error != std::errc() || rest != count.data() + count.size()) fail(quoted(count) + " is not a count");
    header_.elements.push_back(std::move(element));
  }

  void parse_property() {
    if (header_.elements.empty()) fail("is a property before any element");
    PlyProperty property;
    const bool is_list = fields_.size() == 5 && fields_[1] == "list";
    if (!is_list && fields_.size() != 3) fail("is not 'property TYPE NAME' or 'property list TYPE TYPE NAME'");
    if (is_list) {
      property.list_count = parse_type(fields_[2]);
      if (is_floating(*property.list_count)) fail("counts a list's entries in " + quoted(fields_[2]));
    }
    property.type = parse_type(fields_[is_list ? 3 : 1]);
    property.name = fields_.back();
    header_.elements.back().properties.push_back(std::move(property));
  }

  ScalarType parse_type(std::string_view name) const {
    const auto type = parse_ply_type(name);
    if (!type) fail("names the unknown type " + quoted(name));
    return *type;
  }

  void check() {
    if (!has_format_) fail("ends a header without a 'format' line");
    const auto is_vertex = [](const PlyElement& element) { return element.name == "vertex"; };
    const auto vertex = std::find_if(header_.elements.begin(), header_.elements.end(), is_vertex);
    if (vertex == header_.elements.end()) fail("ends a header without an element 'vertex'");
    if (std::count_if(vertex, header_.elements.end(), is_vertex) > 1) fail("ends a header with two elements 'vertex'");
    header_.vertex = static_cast<std::size_t>(vertex - header_.elements.begin());
    check_names(*vertex);
  }

  void check_names(const PlyElement& vertex) const {
    std::vector<std::string_view> names, scalars;
    for (const auto& property : vertex.properties) {
      names.push_back(property.name);
      if (!property.list_count) scalars.push_back(property.name);
    }
    for (const std::string_view axis : {"x", "y", "z"}) {
      if (std::find(scalars.begin(), scalars.end(), axis) == scalars.end()) {
        fail("ends a header whose vertices have no property " + quoted(axis));
      }
    }
    std::sort(names.begin(), names.end());
    const auto twin = std::adjacent_find(names.begin(), names.end());
    if (twin != names.end()) fail("ends a header whose vertices have two properties " + quoted(*twin));
  }

  InputBuffer& input_;
  PlyHeader header_;
  std::vector<std::string_view> fields_;
  bool has_format_ = false;
};

}  // namespace

bool PlyElement::has_list() const {
  return std::any_of(properties.begin(), properties.end(), [](const auto& p) { return p.list_count.has_value(); });
}

std::size_t PlyElement::scalar_stride() const {
  std::size_t stride = 0;
  for (const auto& property : properties) stride += property.list_count ? 0 : scalar_size(property.type);
  return stride;
}

PlyHeader read_ply_header(InputBuffer& input) { return HeaderParser(input).parse(); }

}  // namespace tcm_icp

#include "e57_header.hpp"

#include <bit>
#include <charconv>
#include <limits>
#include <pugixml.hpp>
#include <string_view>

#include "scalar.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

class Parser {
 public:
  explicit Parser(E57Pages& pages) : pages_(pages) {}

  std::vector<E57Scan> parse() {
    pages_.seek(pages_.logical(pages_.xml_offset(), "its XML part"));
    std::string text(pages_.xml_length(), '\0');  // no longer than the file, as E57Pages has checked
    pages_.read(reinterpret_cast<std::byte*>(text.data()), text.size());
    pugi::xml_document document;
    const auto result =
        document.load_buffer_inplace(text.data(), text.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result) fail(std::string("is not XML (") + result.description() + ")");
    const pugi::xml_node root = document.child("e57Root");
    if (!root) fail("has no element e57Root");
    std::vector<E57Scan> scans;
    for (const pugi::xml_node node : root.child("data3D").children()) {
      scans.push_back(scan_of(node));
      scans.back().coordinate_system = root.child("coordinateMetadata").child_value();
    }
    return scans;
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(pages_.path(), "XML part", problem, "write or copy the file again");
  }

  /// A number of the XML; `otherwise` where there is no text, which is how E57 writes 0 and its defaults.
  double number(std::string_view text, double otherwise) const {
    while (!text.empty() && std::string_view(" \t\r\n").find(text.front()) != std::string_view::npos)
      text.remove_prefix(1);
    while (!text.empty() && std::string_view(" \t\r\n").find(text.back()) != std::string_view::npos)
      text.remove_suffix(1);
    if (text.empty()) return otherwise;
    const auto value = parse_number(text);
    if (!value) fail("holds " + quoted(text) + " in place of a number");
    return *value;
  }

  template <typename T>
  T whole_number(const pugi::xml_attribute& attribute, T otherwise) const {
    const std::string_view text = attribute.value();
    if (text.empty()) return otherwise;
    T value{};
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || rest != text.data() + text.size()) {
      fail("holds " + quoted(text) + " in place of a whole number");
    }
    return value;
  }

  E57Scan scan_of(const pugi::xml_node& node) const {
    E57Scan scan;
    scan.T_file_scan = pose_of(node.child("pose"));
    const pugi::xml_node points = node.child("points");
    if (!points) return scan;  // a scan without points
    scan.num_points = whole_number<std::uint64_t>(points.attribute("recordCount"), 0);
    scan.points_offset = whole_number<std::uint64_t>(points.attribute("fileOffset"), 0);
    scan.is_packed = !points.child("codecs").first_child().empty();
    add_fields(points.child("prototype"), scan.fields);
    return scan;
  }

  std::optional<Eigen::Matrix4d> pose_of(const pugi::xml_node& pose) const {
    if (!pose) return std::nullopt;
    const auto value = [&](const pugi::xml_node& node, const char* name) {
      return number(node.child(name).child_value(), 0);
    };
    Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
    if (const pugi::xml_node r = pose.child("rotation")) {
      // Not normalised here: a quaternion of another length gives a matrix that is not rigid, and is refused as such.
      const double w = value(r, "w"), x = value(r, "x"), y = value(r, "y"), z = value(r, "z");
      T.topLeftCorner<3, 3>() << w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),
          2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x), 2 * (x * z - w * y),
          2 * (y * z + w * x), w * w - x * x - y * y + z * z;
    }
    const pugi::xml_node t = pose.child("translation");
    T.topRightCorner<3, 1>() = Eigen::Vector3d(value(t, "x"), value(t, "y"), value(t, "z"));
    return T;
  }

  void add_fields(const pugi::xml_node& prototype, std::vector<E57Field>& fields, int depth = 0) const {
    constexpr std::size_t kMostFields = 4096;  // a packet has room for a few more
    constexpr int kDeepest = 16;               // nobody nests columns at all
    for (const pugi::xml_node node : prototype.children()) {
      const std::string_view type = node.attribute("type").value();
      if (type == "Structure" || type == "Vector") {
        if (depth == kDeepest) fail("nests the columns of points too deep");
        add_fields(node, fields, depth + 1);
        continue;
      }
      if (fields.size() == kMostFields) fail("has more columns of points than a packet can hold");
      E57Field field;
      field.name = node.name();
      if (type == "Float") {
        const bool is_single = std::string_view(node.attribute("precision").value()) == "single";
        field.kind = is_single ? E57Field::Kind::kFloat32 : E57Field::Kind::kFloat64;
      } else if (type == "Integer" || type == "ScaledInteger") {
        add_bounds(node, field);
        field.kind = type == "Integer" ? E57Field::Kind::kInteger : E57Field::Kind::kScaled;
      }
      fields.push_back(std::move(field));
    }
  }

  void add_bounds(const pugi::xml_node& node, E57Field& field) const {
    using Limits = std::numeric_limits<std::int64_t>;
    field.minimum = whole_number<std::int64_t>(node.attribute("minimum"), Limits::min());
    const auto maximum = whole_number<std::int64_t>(node.attribute("maximum"), Limits::max());
    if (maximum < field.minimum) fail("has a column '" + field.name + "' whose maximum is below its minimum");
    field.range = static_cast<std::uint64_t>(maximum) - static_cast<std::uint64_t>(field.minimum);
    field.scale = number(node.attribute("scale").value(), 1);
    field.shift = number(node.attribute("offset").value(), 0);
  }

  E57Pages& pages_;
};

}  // namespace

unsigned E57Field::bits() const {
  if (kind == Kind::kFloat32) return 32;
  if (kind == Kind::kFloat64) return 64;
  return static_cast<unsigned>(std::bit_width(range));
}

std::vector<E57Scan> read_e57_scans(E57Pages& pages) { return Parser(pages).parse(); }

}  // namespace tcm_icp

#include "e57_source.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "attribute_names.hpp"
#include "e57_writer.hpp"
#include "scalar.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

/// The names other formats have for the same.
std::string usual_name(const std::string& name) {
  static const std::array<std::pair<const char*, const char*>, 9> kUsual{{{"colorRed", "red"},
                                                                          {"colorGreen", "green"},
                                                                          {"colorBlue", "blue"},
                                                                          {"nor:normalX", "nx"},
                                                                          {"nor:normalY", "ny"},
                                                                          {"nor:normalZ", "nz"},
                                                                          {"timeStamp", "time"},
                                                                          {"returnIndex", "return_index"},
                                                                          {"returnCount", "return_count"}}};
  for (const auto& [theirs, ours] : kUsual) {
    if (name == theirs) return ours;
  }
  return attribute_name(name.starts_with(kE57Prefix) ? name.substr(std::string_view(kE57Prefix).size()) : name);
}

/// The smallest type that holds all values of a column.
ScalarType type_of(const E57Field& field) {
  if (field.kind == E57Field::Kind::kFloat32) return ScalarType::kFloat32;
  if (field.kind != E57Field::Kind::kInteger) return ScalarType::kFloat64;
  const auto low = static_cast<double>(field.minimum), high = low + static_cast<double>(field.range);
  for (const ScalarType type : {ScalarType::kUInt8, ScalarType::kInt8, ScalarType::kUInt16, ScalarType::kInt16,
                                ScalarType::kUInt32, ScalarType::kInt32}) {
    if (fits(low, type) && fits(high, type)) return type;
  }
  return ScalarType::kFloat64;
}

}  // namespace

E57Source::E57Source(E57Pages pages, E57Scan scan, ReadAttributes read_attributes)
    : pages_(std::move(pages)), scan_(std::move(scan)) {
  if (scan_.is_packed) {
    throw InputError(pages_.path(), "XML part", "a scan is packed by a codec that is not the standard's",
                     "export it without compression");
  }
  const bool has_points = want_coordinates({"cartesianX", "cartesianY", "cartesianZ"}, "cartesianInvalidState") ||
                          (is_spherical_ = want_coordinates(
                               {"sphericalRange", "sphericalAzimuth", "sphericalElevation"}, "sphericalInvalidState"));
  if (!has_points && scan_.num_points > 0) {
    throw InputError(pages_.path(), "XML part", "a scan has neither Cartesian nor spherical coordinates",
                     "export it with coordinates");
  }
  if (read_attributes == ReadAttributes::kYes) want_attributes();
  points_ = std::make_unique<E57Points>(pages_, scan_, wanted_);
}

std::optional<std::size_t> E57Source::find(const std::string& name) const {
  for (std::size_t i = 0; i < scan_.fields.size(); ++i) {
    if (scan_.fields[i].name == name && scan_.fields[i].kind != E57Field::Kind::kOther) return i;
  }
  return std::nullopt;
}

bool E57Source::want_coordinates(const std::array<const char*, 3>& names, const char* state) {
  std::vector<std::size_t> fields;
  for (const char* const name : names) {
    if (const auto field = find(name)) fields.push_back(*field);
  }
  if (fields.size() < 3) return false;
  const auto field = find(state);
  if (field) fields.push_back(*field);
  has_state_ = field.has_value();
  wanted_ = fields;
  return true;
}

void E57Source::want_attributes() {
  for (std::size_t i = 0; i < scan_.fields.size(); ++i) {
    const E57Field& field = scan_.fields[i];
    if (field.kind == E57Field::Kind::kOther || std::count(wanted_.begin(), wanted_.end(), i) > 0) continue;
    attributes_.push_back(
        {unique_name(usual_name(field.name), "column_" + std::to_string(i + 1), attributes_), type_of(field)});
    wanted_.push_back(i);
  }
}

bool E57Source::next(Eigen::Vector3d& point, std::byte* attributes) {
  if (in_batch_ == batch_) {
    if (num_read_ == scan_.num_points) return false;
    batch_ = static_cast<std::size_t>(std::min<std::uint64_t>(E57Points::kBatch, scan_.num_points - num_read_));
    points_->read(batch_);
    num_read_ += batch_;
    in_batch_ = 0;
  }
  const auto& values = points_->values();
  const std::size_t i = in_batch_++;
  point = {values[0][i], values[1][i], values[2][i]};
  if (is_spherical_) {
    const double range = point[0], azimuth = point[1], elevation = point[2];
    point = {range * std::cos(elevation) * std::cos(azimuth), range * std::cos(elevation) * std::sin(azimuth),
             range * std::sin(elevation)};
  }
  // 1: a direction only, 2: nothing
  if (has_state_ && values[3][i] != 0) point.setConstant(std::numeric_limits<double>::quiet_NaN());
  if (!attributes) return true;
  const std::size_t first = has_state_ ? 4 : 3;
  for (std::size_t k = 0; k < attributes_.size(); ++k) {
    const double value = values[first + k][i];
    const ScalarType type = attributes_[k].type;
    store_scalar(std::isfinite(value) || is_floating(type) ? value : 0, type, attributes);
    attributes += scalar_size(type);
  }
  return true;
}

}  // namespace tcm_icp

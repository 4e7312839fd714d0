#include "ptx_source.hpp"

#include <limits>
#include <utility>

#include "fields.hpp"
#include "scalar.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {

PtxSource::PtxSource(InputBuffer input, CloudIs cloud) : input_(std::move(input)), cloud_(cloud) {
  if (input_.head(3) == "\xEF\xBB\xBF") input_.consume(3);
  const std::uint64_t columns = read_count("the number of columns"), rows = read_count("the number of rows");
  if (rows != 0 && columns > std::numeric_limits<std::uint64_t>::max() / rows) fail("promises more cells than can be");
  num_cells_ = columns * rows;
  read_numbers(3, "the scanner's position");
  for (int axis = 0; axis < 3; ++axis) read_numbers(3, "an axis of the scanner");
  read_pose();
  name_attributes();
}

void PtxSource::fail(const std::string& problem) const {
  throw InputError(input_.path(), input_.line_place(), problem, "write or copy the file again");
}

bool PtxSource::next_fields() {
  std::string_view line;
  do {
    if (!input_.next_line(line)) return false;
    split_fields(line, ' ', fields_);
  } while (fields_.empty());
  return true;
}

std::uint64_t PtxSource::read_count(const char* what) {
  std::uint64_t count = 0;
  if (!next_fields() || fields_.size() != 1 || !is_count_line(fields_[0], count)) {
    fail(std::string("is not ") + what + ", a whole number, with which a PTX cloud begins");
  }
  return count;
}

double PtxSource::parse(std::string_view token) const {
  const auto value = parse_number(token);
  if (!value) fail(quoted(token) + " is not a number");
  return *value;
}

void PtxSource::read_numbers(std::size_t count, const char* what) {
  if (!next_fields() || fields_.size() != count) {
    fail("is not " + std::string(what) + ", which is " + std::to_string(count) + " numbers");
  }
  values_.clear();
  for (const auto field : fields_) values_.push_back(parse(field));
}

void PtxSource::read_pose() {
  // Points are rows there, to be multiplied from the left: each line is a column of ours.
  for (Eigen::Index line = 0; line < 4; ++line) {
    read_numbers(4, "a row of the scan's transformation");
    for (Eigen::Index i = 0; i < 4; ++i) T_file_scan_(i, line) = values_[static_cast<std::size_t>(i)];
  }
}

void PtxSource::name_attributes() {
  if (num_cells_ == 0) return;
  if (!next_fields()) fail("is the last line, but " + std::to_string(num_cells_) + " cells are promised");
  const std::size_t count = fields_.size();
  if (count != 3 && count != 4 && count != 6 && count != 7) {
    fail("has " + std::to_string(count) + " numbers, but a cell is x y z, intensity, red green blue");
  }
  if (count == 4 || count == 7) attributes_.push_back({"intensity", ScalarType::kFloat32});
  if (count >= 6) {
    for (const char* const name : {"red", "green", "blue"}) attributes_.push_back({name, ScalarType::kUInt8});
  }
  has_pending_ = true;
}

bool PtxSource::next(Eigen::Vector3d& point, std::byte* attributes) {
  if (num_read_ == num_cells_) {
    if (cloud_ == CloudIs::kAll && next_fields()) refuse_several(input_);
    return false;
  }
  if (!std::exchange(has_pending_, false) && !next_fields()) {
    fail("is the last line, after " + std::to_string(num_read_) + " of " + std::to_string(num_cells_) + " cells");
  }
  if (fields_.size() != 3 + attributes_.size()) {
    fail("has " + std::to_string(fields_.size()) + " numbers, but the first cell has " +
         std::to_string(3 + attributes_.size()));
  }
  ++num_read_;
  for (std::size_t axis = 0; axis < 3; ++axis) point[static_cast<Eigen::Index>(axis)] = parse(fields_[axis]);
  if (point.isZero(0)) point.setConstant(std::numeric_limits<double>::quiet_NaN());  // no return in this direction
  std::size_t offset = 0;
  for (std::size_t i = 0; i < attributes_.size(); ++i) {
    const double value = parse(fields_[3 + i]);
    const ScalarType type = attributes_[i].type;
    if (!fits(value, type)) fail(quoted(fields_[3 + i]) + " is not a colour from 0 to 255");
    if (attributes) store_scalar(value, type, attributes + offset);
    offset += scalar_size(type);
  }
  return true;
}

}  // namespace tcm_icp

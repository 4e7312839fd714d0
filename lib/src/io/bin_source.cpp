#include "bin_source.hpp"

#include <cstring>
#include <string>
#include <utility>

#include "little_endian.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {

BinSource::BinSource(InputBuffer input, BinLayout layout)
    : input_(std::move(input)), attributes_{{"intensity", ScalarType::kFloat32}} {
  if (layout == BinLayout::kNuScenes) attributes_.push_back({"ring", ScalarType::kFloat32});
  record_size_ = sizeof(float) * (3 + attributes_.size());
  if (input_.size() && *input_.size() % record_size_ != 0) {
    throw InputError(input_.path(), "",
                     "has " + std::to_string(*input_.size()) + " bytes, which are no whole number of points of " +
                         std::to_string(record_size_) + " bytes",
                     "check --bin, or copy the file again");
  }
}

bool BinSource::next(Eigen::Vector3d& point, std::byte* attributes) {
  const std::byte* const record = input_.peek(record_size_);
  if (!record) {
    if (input_.head(1).empty()) return false;
    throw InputError(input_.path(), input_.byte_place(), "ends within a point", "copy the file again");
  }
  for (std::ptrdiff_t axis = 0; axis < 3; ++axis) point[axis] = load<float>(record + 4 * axis);
  if (attributes) std::memcpy(attributes, record + 12, record_size_ - 12);
  input_.consume(record_size_);
  return true;
}

}  // namespace tcm_icp

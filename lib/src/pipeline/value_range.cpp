#include "pipeline/value_range.hpp"

#include <algorithm>
#include <cmath>

#include "io/scalar.hpp"

namespace tcm_icp {

void ValueRange::add(const PointBlock& block, const std::vector<Attribute>& attributes) {
  const auto at = std::find_if(attributes.begin(), attributes.end(),
                               [&](const Attribute& attribute) { return attribute.name == name_; });
  if (at == attributes.end()) return;
  const std::size_t offset = attribute_stride({attributes.begin(), at}), stride = attribute_stride(attributes);
  for (std::size_t i = 0; i < block.size(); ++i) {
    const double value = load_scalar(block.attributes.data() + i * stride + offset, at->type);
    if (!std::isfinite(value)) continue;
    least_ = std::min(least_, value);
    most_ = std::max(most_, value);
  }
}

std::pair<double, double> las_intensity_range(const ValueRange& intensity) {
  constexpr double kMost = 65535;
  const double least = intensity.least(), most = intensity.most();
  if (!(least <= most) || most <= 0) return {0, kMost};  // none, or nothing to scale
  if (least >= 0 && most <= 1) return {0, 1};
  if (least >= 0 && most <= kMost) return {0, kMost};
  return {std::min(least, 0.0), most};
}

}  // namespace tcm_icp

#include "tcm_icp/core/even_sample.hpp"

#include <algorithm>

namespace tcm_icp {

Points even_sample(const Points& points, std::size_t max_count) {
  const std::size_t count = std::min(points.size(), max_count);
  Points sample;
  sample.reserve(count);
  for (std::size_t i = 0; i < count; ++i) sample.push_back(points[i * points.size() / count]);
  return sample;
}

Cloud even_sample(const Cloud& cloud, std::size_t max_count) {
  return {even_sample(cloud.points, max_count), even_sample(cloud.normals, max_count)};
}

}  // namespace tcm_icp

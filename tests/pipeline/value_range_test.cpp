#include "pipeline/value_range.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

namespace tcm_icp {
namespace {

PointBlock block_of(const std::vector<float>& values) {
  PointBlock block;
  for (const float value : values) {
    const float pair[2] = {1e9F, value};
    block.points.emplace_back(0, 0, 0);
    const auto* const bytes = reinterpret_cast<const std::byte*>(pair);
    block.attributes.insert(block.attributes.end(), bytes, bytes + sizeof pair);
  }
  return block;
}

ValueRange range_of(const std::vector<float>& values) {
  ValueRange range("intensity");
  range.add(block_of(values), {{"other", ScalarType::kFloat32}, {"intensity", ScalarType::kFloat32}});
  return range;
}

using Range = std::pair<double, double>;

TEST(ValueRange, IsOfTheFiniteValuesOfThatName) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  ValueRange range = range_of({3, nan, -2, infinite});
  EXPECT_EQ(range.least(), -2);
  EXPECT_EQ(range.most(), 3);
  range.add(block_of({50}), {{"other", ScalarType::kFloat32}, {"time", ScalarType::kFloat32}});
  EXPECT_EQ(range.most(), 3);
}

TEST(LasIntensityRange, TellsSharesAndNumbersFromOtherScales) {
  EXPECT_EQ(las_intensity_range(range_of({0.1F, 0.9F})), Range(0, 1));
  EXPECT_EQ(las_intensity_range(range_of({0, 255})), Range(0, 65535));
  EXPECT_EQ(las_intensity_range(range_of({-2048, 2047})), Range(-2048, 2047));
  EXPECT_EQ(las_intensity_range(range_of({5, 1e6F})), Range(0, 1e6));
  EXPECT_EQ(las_intensity_range(range_of({})), Range(0, 65535));
  EXPECT_EQ(las_intensity_range(range_of({0, 0})), Range(0, 65535));
}

}  // namespace
}  // namespace tcm_icp

// Every file of tests/data/io is read or refused, as its name says: a broken file someone sends in goes there.

#include <gtest/gtest.h>

#include <string>

#include "io/temp_files.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/io/scan_reader.hpp"

namespace tcm_icp {
namespace {

TEST(ShippedFiles, GoodOnesAreReadAndBrokenOnesRefused) {
  int num_good = 0, num_broken = 0;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(TCM_ICP_TEST_DATA) / "io")) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("good_")) {
      EXPECT_EQ(test::read_whole(entry.path()).block.points, Points({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})) << name;
      ++num_good;
    } else {
      ASSERT_TRUE(name.starts_with("broken_")) << name;
      EXPECT_THROW(test::read_whole(entry.path()), InputError) << name;
      ++num_broken;
    }
  }
  EXPECT_GT(num_good, 0);
  EXPECT_GT(num_broken, 0);
}

}  // namespace
}  // namespace tcm_icp

// A set that scans are added to keeps its resolutions, as long as they are near its own.

#include "pipeline/kept_set.hpp"

#include <gtest/gtest.h>

#include "io/temp_files.hpp"

namespace tcm_icp::test {
namespace {

std::vector<SampledScan> scans_of(const std::vector<std::string>& digests) {
  std::vector<SampledScan> scans(digests.size());
  for (std::size_t i = 0; i < digests.size(); ++i) scans[i].digest = digests[i];
  return scans;
}

class KeepResolutions : public ::testing::Test {
 protected:
  KeptSet keep(const std::vector<std::string>& digests, double coarse_m, const SamplingOptions& options = {}) const {
    const StepStore store(folder_.path() / "work");
    return keep_resolutions(store, scans_of(digests), options, {coarse_m, coarse_m / 2});
  }
  TempFolder folder_;
};

TEST_F(KeepResolutions, OfASetThatIsNewAreItsOwn) {
  const KeptSet set = keep({"a", "b"}, 0.1);
  EXPECT_EQ(set.resolutions.coarse_m, 0.1);
  EXPECT_EQ(set.resolutions.fine_m, 0.05);
  EXPECT_TRUE(set.base.empty());
}

TEST_F(KeepResolutions, StayWhereScansAreAdded) {
  keep({"b", "a"}, 0.1 + 1e-17);
  for (int run = 0; run < 2; ++run) {  // and when the larger set is registered again
    const KeptSet set = keep({"a", "c", "b"}, 0.109);
    EXPECT_EQ(set.resolutions.coarse_m, 0.1 + 1e-17);
    EXPECT_EQ(set.base, (std::vector<std::string>{"b", "a"}));
  }
  EXPECT_EQ(keep({"a", "b", "c", "d"}, 0.105).base, (std::vector<std::string>{"a", "c", "b"}));
}

TEST_F(KeepResolutions, AreItsOwnWhereTheOldOnesAreTooFarOff) {
  keep({"a", "b"}, 0.1);
  EXPECT_EQ(keep({"a", "b", "c"}, 0.12).resolutions.coarse_m, 0.12);
  EXPECT_EQ(keep({"a", "b", "d"}, 0.08).resolutions.coarse_m, 0.08);
}

TEST_F(KeepResolutions, AreNotKeptFromSetsWithOtherScansOrOptions) {
  keep({"a", "b"}, 0.1);
  EXPECT_EQ(keep({"a", "c"}, 0.101).resolutions.coarse_m, 0.101);
  EXPECT_EQ(keep({"a"}, 0.102).resolutions.coarse_m, 0.102);
  SamplingOptions options;
  options.coarse_voxels += 1;
  EXPECT_EQ(keep({"a", "b", "e"}, 0.103, options).resolutions.coarse_m, 0.103);
}

TEST_F(KeepResolutions, OfADamagedFileDoNotCount) {
  keep({"a", "b"}, 0.1);
  for (const auto& file : std::filesystem::directory_iterator(folder_.path() / "work/sets")) {
    std::filesystem::resize_file(file.path(), std::filesystem::file_size(file.path()) - 2);
  }
  EXPECT_EQ(keep({"a", "b", "c"}, 0.104).resolutions.coarse_m, 0.104);
}

}  // namespace
}  // namespace tcm_icp::test

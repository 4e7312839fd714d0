#include "tcm_icp/evaluation/truth.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

class TruthFile : public ::testing::Test {
 protected:
  ~TruthFile() override { std::filesystem::remove(path_); }

  Truth read(const std::string& text) {
    std::ofstream(path_) << text;
    return read_truth(path_);
  }

  std::filesystem::path path_ =
      std::filesystem::temp_directory_path() /
      ("tcm_icp_truth_" + std::to_string(getpid()) + ::testing::UnitTest::GetInstance()->current_test_info()->name());
};

const std::string kQuarterTurn = "[[0,-1,0,5],[1,0,0,6],[0,0,1,7],[0,0,0,1]]";

TEST_F(TruthFile, IsReadWithAllItsParts) {
  const Truth truth = read(
      R"({"scans": [{"file": "a.ply", "pose": )" + kQuarterTurn + R"(}, {"file": "b.ply", "group": 2, "pose": )" +
      kQuarterTurn + R"(}], "tolerance": {"rotation_deg": 0.25, "rmse_m": 0.5}, "overlap": [[1, 0.2], [0.3, 1]]})");
  ASSERT_EQ(truth.scans.size(), 2u);
  EXPECT_EQ(truth.scans[0].file, "a.ply");
  EXPECT_EQ(truth.scans[0].group, 0);
  EXPECT_EQ(truth.scans[1].group, 2);
  EXPECT_EQ(truth.scans[0].T_world_scan * Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(5, 7, 7));
  EXPECT_EQ(truth.tolerance.rotation_deg, 0.25);
  EXPECT_EQ(truth.tolerance.rmse_m, 0.5);
  EXPECT_EQ(truth.overlap(0, 1), 0.2);
  EXPECT_FALSE(truth.pair_counts(0, 1, 0.1));  // of different groups
}

TEST_F(TruthFile, HasDefaultsWhereItSaysNothing) {
  const Truth truth = read(R"({"scans": [{"file": "a", "pose": )" + kQuarterTurn + R"(}, {"file": "b", "pose": )" +
                           kQuarterTurn + "}]}");
  EXPECT_EQ(truth.tolerance.rotation_deg, 1.0);
  EXPECT_EQ(truth.tolerance.rmse_m, 0.2);
  EXPECT_TRUE(truth.pair_counts(0, 1, 0.9));
}

TEST_F(TruthFile, ThatIsBrokenIsAnInputError) {
  const std::string scan = R"({"file": "a", "pose": )" + kQuarterTurn + "}";
  EXPECT_THROW(read_truth(path_), InputError);
  EXPECT_THROW(read(""), InputError);
  EXPECT_THROW(read("{\"scans\": ["), InputError);
  EXPECT_THROW(read("[]"), InputError);
  EXPECT_THROW(read("{}"), InputError);
  EXPECT_THROW(read(R"({"scans": [{"file": "a"}]})"), InputError);
  EXPECT_THROW(read(R"({"scans": [{"file": "a", "pose": [[1, 0], [0, 1]]}]})"), InputError);
  EXPECT_THROW(read(R"({"scans": [{"file": "a", "pose": [[1,0,0,0],[0,1],[0,0,1,0],[0,0,0,1]]}]})"), InputError);
  EXPECT_THROW(read(R"({"scans": [{"file": "a", "pose": [[2,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}]})"), InputError);
  EXPECT_THROW(read(R"({"scans": [{"file": "a", "pose": [[-1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}]})"), InputError);
  EXPECT_THROW(read("{\"scans\": [" + scan + "," + scan + "]}"), InputError);
  EXPECT_THROW(read("{\"scans\": [" + scan + "], \"overlap\": [[1, 2], [3, 4]]}"), InputError);
  EXPECT_NO_THROW(read("{\"scans\": [" + scan + "]}"));
}

TEST_F(TruthFile, WithNumbersOrRowsThatCannotBeIsAnInputError) {
  EXPECT_THROW(read(R"({"scans": [{"file": "a.ply", "pose": [[20e610]]}]})"), InputError) << "beyond double";
  for (const std::string group : {"99999999999999999999999999", "-2147483649", "4294967296", "1.5", "null", "\"1\""}) {
    EXPECT_THROW(read(R"({"scans": [{"file": "a.ply", "group": )" + group + R"(, "pose": )" + kQuarterTurn + "}]}"),
                 InputError)
        << group;
  }
  const std::string scan = R"({"file": "a.ply", "pose": )" + kQuarterTurn + "}";
  std::string rows = "[[1";  // a matrix as wide as its first row and as high as all would take terabytes
  for (int i = 0; i < 400'000; ++i) rows += ",1";
  rows += "]";
  for (int i = 0; i < 400'000; ++i) rows += ",[]";
  EXPECT_THROW(read("{\"scans\": [" + scan + "], \"overlap\": " + rows + "]}"), InputError);
}

}  // namespace
}  // namespace tcm_icp

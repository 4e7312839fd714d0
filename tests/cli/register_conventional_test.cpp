// `tcm-icp register --method icp|features`: the same files as by TCM, or a refusal that says what is missing.

#include <algorithm>
#include <fstream>

#include "cli_test.hpp"
#include "result_files.hpp"
#include "support/random_points.hpp"

namespace tcm_icp::test {
namespace {

// With kSmall, ICP ends close to the tolerance, on either side of it.
const Words kEnoughForIcp{"--sampling.working-points", "40000", "--sampling.coarse-voxels", "10000",
                          "--sampling.fine-voxels",    "30000"};

class RegisterConventional : public CliTest {
 protected:
  // The slow ones need what the executable may have been built without.
  void skip_without_pcl() const {
#ifndef TCM_ICP_HAVE_PCL
    GTEST_SKIP() << "built without PCL";
#endif
  }
  nlohmann::json report() const { return read_json(folder() / "result/report.json"); }
};

TEST_F(RegisterConventional, OptionsUnknownMethodIsRefused) {
  expect_refusal(Words{"register", "--out", "result", "--method", "magic"} + town_scans(), 1,
                 {"--method 'magic'", "tcm, icp, features"});
}

#ifndef TCM_ICP_HAVE_PCL
TEST_F(RegisterConventional, OptionsWithoutPclSayWhatIsMissing) {
  for (const char* method : {"icp", "features"}) {
    expect_refusal(Words{"register", "--out", "result", "--method", method} + town_scans(), 1,
                   {method, "libpcl-dev", "TCM_ICP_WITH_PCL"});
  }
}
#endif

TEST_F(RegisterConventional, OptionsOfTcmAreRefused) {
  expect_refusal(Words{"register", "--out", "result", "--method", "icp", "--profile", "paper"} + town_scans(), 1,
                 {"--profile paper", "--method tcm"});
}

TEST_F(RegisterConventional, IcpFromRoughPosesFindsTheTown) {
  skip_without_pcl();
  if (IsSkipped()) return;
  const std::vector<std::optional<Eigen::Isometry3d>> as_they_lie(6, Eigen::Isometry3d::Identity());
  ASSERT_EQ(score_town(as_they_lie, 2).count(PoseVerdict::kWrong), 5U) << "the start must fail";
  const RunResult result =
      run(Words{"register", "--out", "result", "--method", "icp", "--init", town_file("initial_poses.json").string()} +
          kEnoughForIcp + town_scans());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const PoseFile file = read_pose_file(folder() / "result/poses.json");
  const auto right = score_town(file).count(PoseVerdict::kOk);
  EXPECT_GE(right, 5U) << "from 5 degrees and half a metre ICP gets most scans";
  EXPECT_TRUE(std::filesystem::exists(folder() / "result/registered.ply"));
  EXPECT_TRUE(std::filesystem::exists(folder() / "result/transforms/000.ply.txt"));
  EXPECT_EQ(report()["method"], "icp");
  EXPECT_EQ(report()["options"]["outliers"], "none");
  EXPECT_GT(report()["conventional"]["iterations"]["icp"], 15);
  EXPECT_EQ(report()["conventional"]["iterations"]["ransac"], 0);
}

TEST_F(RegisterConventional, EveryScanIsRegisteredAndTheTreeHoldsThem) {
  skip_without_pcl();
  if (IsSkipped()) return;
  for (const char* method : {"icp", "features"}) {
    const RunResult result =
        run(Words{"register", "--force", "--out", "result", "--method", method} + kSmall + town_scans({0, 1, 2}));
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const auto json = report();
    EXPECT_EQ(json["conventional"]["pairs"].size(), 3U);
    EXPECT_EQ(std::count_if(json["conventional"]["pairs"].begin(), json["conventional"]["pairs"].end(),
                            [](const auto& p) { return p["in_tree"].template get<bool>(); }),
              2);
    const std::string page = read_text(folder() / "result/report.html");
    EXPECT_NE(page.find(std::string("Pairs fitted by ") + method), std::string::npos);
    std::size_t references = 0;
    for (const auto& scan : read_pose_file(folder() / "result/poses.json").scans) {
      EXPECT_NE(scan.status, ScanStatus::kUnregistered);
      references += scan.status == ScanStatus::kReference ? 1 : 0;
    }
    EXPECT_EQ(references, 1U);
  }
}

TEST_F(RegisterConventional, FeaturesGiveTheSamePosesForTheSameSeed) {
  skip_without_pcl();
  if (IsSkipped()) return;
  const Words arguments = Words{"--method", "features", "--seed", "7"} + kSmall + town_scans({1, 2});
  ASSERT_EQ(run(Words{"register", "--out", "a"} + arguments).exit_code, 0);
  ASSERT_EQ(run(Words{"register", "--out", "b"} + arguments).exit_code, 0);
  EXPECT_EQ(read_text(folder() / "a/poses.json"), read_text(folder() / "b/poses.json"));
}

// All but one have too few neighbours, hence no normals and no features. PCL reads past the end of a cloud of one.
TEST_F(RegisterConventional, FeaturesTakeAScanOfIsolatedPoints) {
  skip_without_pcl();
  if (IsSkipped()) return;
  Rng rng = make_stream(1, "register_conventional_test");
  std::ofstream out(folder() / "isolated.xyz");
  for (const auto& p : testing::random_points(100, 60, rng)) out << p.transpose() << '\n';
  out << "100 0 0\n102 0 0\n103.4 1.4 0\n";
  out.close();
  const RunResult result = run(Words{"register", "--out", "result", "--method", "features"} + kSmall +
                               town_scans({1, 2}) + Words{(folder() / "isolated.xyz").string()});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(read_pose_file(folder() / "result/poses.json").scans.size(), 3U);
}

TEST_F(RegisterConventional, FeaturesRefuseInitialPoses) {
  skip_without_pcl();
  if (IsSkipped()) return;
  expect_refusal(Words{"register", "--out", "result", "--quiet", "--method", "features", "--init",
                       town_file("initial_poses.json").string()} +
                     kSmall + town_scans({1, 2}),
                 1, {"--init", "--method icp"});
}

}  // namespace
}  // namespace tcm_icp::test

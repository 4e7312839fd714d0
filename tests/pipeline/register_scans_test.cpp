#include "tcm_icp/pipeline/register_scans.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>

#include "pipeline/scene_files.hpp"
#include "support/matchers.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/pipeline/pipeline.hpp"

namespace tcm_icp {
namespace {

using test::TempFolder;
using testing::SceneFiles;

const testing::SyntheticSceneOptions kRubbleScans{
    .shape = testing::SyntheticShape::kRubble, .num_scans = 3, .points_per_scan = 6000, .range_m = 16, .noise_m = 0.01};

SceneFiles rubble(const TempFolder& folder) { return testing::write_scene(folder.path(), kRubbleScans, 0.12, 1, 1); }

RegistrationOptions likely_options() {
  RegistrationOptions options;
  options.confidence = 0.5;
  return options;
}

void expect_same_bits(const Registration& a, const Registration& b) {
  ASSERT_EQ(a.scans.size(), b.scans.size());
  EXPECT_EQ(a.reference, b.reference);
  for (std::size_t i = 0; i < a.scans.size(); ++i) {
    EXPECT_TRUE(a.scans[i].T_reference_scan.matrix() == b.scans[i].T_reference_scan.matrix()) << i;
    EXPECT_EQ(a.scans[i].probability, b.scans[i].probability) << i;
    EXPECT_EQ(a.scans[i].status, b.scans[i].status) << i;
    EXPECT_EQ(a.scans[i].reason, b.scans[i].reason) << i;
  }
  ASSERT_EQ(a.links.size(), b.links.size());
  for (std::size_t k = 0; k < a.links.size(); ++k) EXPECT_EQ(a.links[k].probability, b.links[k].probability);
}

// Points from a function: what a driver of a scanner, or another file format, would be.
class EveryOther : public ScanSource {
 public:
  explicit EveryOther(const Points& points) : points_(points) {}
  const std::vector<Attribute>& attributes() const override { return attributes_; }
  bool next(Eigen::Vector3d& point, std::byte* attributes) override {
    if (next_ >= 2 * points_.size()) return false;
    point = next_ % 2 == 0 ? points_[next_ / 2]
                           : Eigen::Vector3d(Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
    if (attributes != nullptr) *attributes = std::byte{7};
    ++next_;
    return true;
  }

 private:
  const Points& points_;
  std::vector<Attribute> attributes_{{"label", ScalarType::kUInt8}};
  std::size_t next_ = 0;
};

TEST(RegisterScans, CloudsInMemoryFilesAndOwnSourcesGiveTheSameBits) {
  const TempFolder folder;
  const SceneFiles files = rubble(folder);
  const Registration from_files = register_scans(files.paths, likely_options());
  ASSERT_TRUE(from_files.all_registered());
  const Registration from_memory = register_scans(files.scene.scans, likely_options());
  expect_same_bits(from_files, from_memory);
  EXPECT_EQ(from_files.scans[1].name, "1.ply");
  EXPECT_EQ(from_memory.scans[1].name, "cloud_1");

  std::vector<ScanInput> sources;
  for (const auto& cloud : files.scene.scans) {
    const std::string name = "own " + std::to_string(sources.size());
    sources.emplace_back(name, [&cloud] { return std::make_unique<EveryOther>(cloud.points); });
  }
  RunContext two_threads;
  two_threads.num_threads = 2;
  expect_same_bits(from_files, register_scans(sources, likely_options(), two_threads));
}

TEST(RegisterScans, SaysWhatThePipelineSays) {
  const TempFolder folder;
  const SceneFiles files = rubble(folder);
  const Registration registration = register_scans(files.paths, likely_options());
  PipelineOptions options;
  options.decision.confidence = 0.5;
  const PipelineResult result = Pipeline(options).run(files.paths, InitialPoses(3), {});
  EXPECT_LE(testing::worst_error_m(files, result), files.scene.spacing_m / 4);
  for (std::size_t i = 0; i < 3; ++i) {
    const RegisteredScan& scan = registration.scans[i];
    EXPECT_TRUE(scan.T_reference_scan.matrix() == result.poses[i].T_reference_scan.matrix());
    EXPECT_EQ(scan.verdict, result.poses[i].verdict);
    EXPECT_EQ(scan.text, result.poses[i].reason);
    EXPECT_EQ(scan.num_points, kRubbleScans.points_per_scan);
    const bool is_reference = i == registration.reference;
    EXPECT_EQ(scan.status, is_reference ? ScanStatus::kReference : ScanStatus::kRegistered);
    EXPECT_EQ(scan.reason, is_reference ? Reason::kReference : Reason::kAccepted);
    EXPECT_EQ(scan.overlap.has_value(), !is_reference);
    if (!is_reference) {
      EXPECT_EQ(scan.probability, result.decisions[i].probability);
      EXPECT_GT(scan.sigma_position_m.value(), 0);
    }
  }
  EXPECT_EQ(registration.links.size(), result.links.size());
}

TEST(RegisterScans, AScanOfAnotherPlaceIsUnregisteredWithItsReason) {
  const TempFolder folder;
  SceneFiles files = rubble(folder);
  Rng rng = make_stream(9, "elsewhere");
  testing::SyntheticSceneOptions options = kRubbleScans;
  options.num_scans = 1;
  files.scene.scans.push_back(testing::synthetic_scene(options, rng).scans[0]);
  const Registration registration = register_scans(files.scene.scans, likely_options());
  const RegisteredScan& foreign = registration.scans[3];
  EXPECT_FALSE(registration.all_registered());
  EXPECT_EQ(foreign.status, ScanStatus::kUnregistered);
  EXPECT_EQ(foreign.verdict, Verdict::kRejected);
  EXPECT_NE(foreign.reason, Reason::kAccepted);
  EXPECT_NE(foreign.reason, Reason::kNotDecided);
  EXPECT_FALSE(foreign.text.empty());
  EXPECT_TRUE(foreign.T_reference_scan.isApprox(Eigen::Isometry3d::Identity(), 0));
}

TEST(RegisterScans, ProgressIsReportedAndStopsIt) {
  const TempFolder folder;
  const SceneFiles files = rubble(folder);
  RunContext context;
  std::set<std::string> stages;
  context.on_progress = [&](const Progress& p) {
    stages.emplace(p.stage);
    return stages.size() < 3 ? Continue::kYes : Continue::kStop;
  };
  EXPECT_THROW(register_scans(files.scene.scans, likely_options(), context), Cancelled);
  EXPECT_EQ(stages.size(), 3u);
  EXPECT_TRUE(stages.contains("reading"));
}

TEST(RegisterScans, WritesTheFolderOfAResultFromMemory) {
  const TempFolder folder;
  const SceneFiles files = rubble(folder);
  std::vector<ScanInput> scans;
  for (const auto& cloud : files.scene.scans) scans.push_back(scan_in_memory(std::to_string(scans.size()), cloud));
  const Registration registration = register_scans(scans, likely_options());
  const auto out = folder.path() / "out";
  write_registration({out, false, {.each = true}}, scans, registration, likely_options());
  const PoseFile poses = read_pose_file(out / "poses.json");
  ASSERT_EQ(poses.scans.size(), 3u);
  EXPECT_TRUE(poses.scans[2].T_reference_scan.matrix() == registration.scans[2].T_reference_scan.matrix());
  EXPECT_EQ(poses.scans[2].file, "2");
  EXPECT_TRUE(std::filesystem::exists(out / "report.html"));
  EXPECT_TRUE(std::filesystem::exists(out / "scans" / "2.ply"));
  EXPECT_GT(test::read_whole(out / "registered.ply").block.size(), 2 * kRubbleScans.points_per_scan);
  EXPECT_THROW(write_registration({out, false, {}}, scans, registration), OutputError);
  EXPECT_THROW(write_registration({folder.path() / "empty", false, {}}, scans, {}), InvalidOptions);
}

TEST(RegisterScans, RefusesWhatCannotBeRegistered) {
  const Points points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Cloud cloud{points, {}}, two_points{{{0, 0, 0}, {1, 0, 0}}, {}};
  const auto error_of = [](const std::vector<ScanInput>& scans) {
    return test::error_of<InvalidInput>([&] { register_scans(scans); });
  };
  EXPECT_THROW(register_scans(std::vector<Cloud>{cloud}), InvalidOptions);
  EXPECT_NE(error_of({scan_in_memory("a", cloud), scan_in_memory("a", cloud)}).find("named twice"), std::string::npos);
  for (const char* const name : {"", "../a", "/a", "a/"}) {
    EXPECT_NE(error_of({scan_in_memory(name, cloud), scan_in_memory("b", cloud)}).find("name of a scan"),
              std::string::npos)
        << name;
  }
  EXPECT_NE(error_of({scan_in_memory("a", two_points), scan_in_memory("b", cloud)}).find("at least 3"),
            std::string::npos);
  EXPECT_NE(error_of({ScanInput("a", [] { return nullptr; }), scan_in_memory("b", cloud)}).find("no source"),
            std::string::npos);
  RegistrationOptions options;
  options.confidence = 1;
  EXPECT_THROW(options.validate(), InvalidOptions);
  EXPECT_THROW(register_scans(std::vector<Cloud>{cloud, cloud}, options), InvalidOptions);
}

}  // namespace
}  // namespace tcm_icp

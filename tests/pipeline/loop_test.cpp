// Joint adjustment against merging alone, in the whole pipeline.

#include <gtest/gtest.h>

#include "pipeline/scene_files.hpp"
#include "tcm_icp/pipeline/pipeline.hpp"

namespace tcm_icp {
namespace {

TEST(Pipeline, AdjustmentClosesALoopBetterThanMergingAlone) {
  double alone_m = 0, adjusted_m = 0;
  // One loop may fall either way by chance; two together hardly.
  for (const std::uint64_t seed : {1u, 2u}) {
    const test::TempFolder folder;
    const testing::SceneFiles files = testing::write_scene(folder.path(),
                                                           {.shape = testing::SyntheticShape::kRubble,
                                                            .num_scans = 6,
                                                            .points_per_scan = 2000,
                                                            .range_m = 7,
                                                            .noise_m = 0.03},
                                                           0.04, 0.3, seed);
    PipelineOptions merging;
    merging.placement.adjustment_steps = merging.placement.adjustment_lp_steps = 0;
    RunContext context;
    context.num_threads = 2;
    const PipelineResult alone = Pipeline(merging).run(files.paths, files.initial, context);
    const PipelineResult adjusted = Pipeline({}).run(files.paths, files.initial, context);
    for (const auto& result : {&alone, &adjusted}) {
      for (const auto& pose : result->poses)
        ASSERT_NE(pose.status, ScanStatus::kUnregistered) << pose.file << ": " << pose.reason;
    }
    alone_m += testing::worst_error_m(files, alone);
    adjusted_m += testing::worst_error_m(files, adjusted);
  }
  EXPECT_LT(adjusted_m, 0.7 * alone_m);
}

}  // namespace
}  // namespace tcm_icp

#include "tcm_icp/pipeline/pipeline_options.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "tcm_icp/core/error.hpp"
#include "tcm_icp/pipeline/pipeline.hpp"

namespace tcm_icp {
namespace {

struct BadValue {
  std::string field;
  std::function<void(PipelineOptions&)> set;
};

const std::vector<BadValue>& bad_values() {
  using O = PipelineOptions;
  static const std::vector<BadValue> values{
      {"graph_threshold", [](O& o) { o.graph_threshold = -1; }},
      {"graph_threshold", [](O& o) { o.graph_threshold = std::nan(""); }},
      {"max_working_points", [](O& o) { o.sampling.max_working_points = 999; }},
      {"coarse_voxels", [](O& o) { o.sampling.coarse_voxels = 99; }},
      {"fine_voxels", [](O& o) { o.sampling.fine_voxels = o.sampling.coarse_voxels - 1; }},
      {"max_surface_variation", [](O& o) { o.sampling.max_surface_variation = 0.34; }},
      {"max_surface_variation", [](O& o) { o.sampling.max_surface_variation = std::nan(""); }},
      {"kmeans_clusters", [](O& o) { o.outliers.kmeans_clusters = -1; }},
      {"num_neighbors", [](O& o) { o.outliers.num_neighbors = 1; }},
      {"quantile", [](O& o) { o.tcm.quantile = 0; }},
      {"max_samples", [](O& o) { o.tcm.max_samples = 0; }},
      {"tie_breaking", [](O& o) { o.lp.tie_breaking = -1; }},
      {"rank_tolerance", [](O& o) { o.lp.rank_tolerance = 0; }},
      {"coarse_points", [](O& o) { o.samples.coarse_points = 99; }},
      {"fine_points", [](O& o) { o.samples.fine_points = 99; }},
      {"held_out_points", [](O& o) { o.samples.held_out_points = 99; }},
      {"lp_steps", [](O& o) { o.adjustment.lp_steps = -1; }},
      {"adjustment steps", [](O& o) { o.adjustment.steps = -1; }},
      {"points", [](O& o) { o.refinement.points = 19; }},
      {"descent_steps", [](O& o) { o.refinement.descent_steps = 0; }},
      {"annealing_steps", [](O& o) { o.refinement.annealing_steps = -1; }},
      {"initial_temperature", [](O& o) { o.refinement.initial_temperature = 0; }},
      {"final_temperature", [](O& o) { o.refinement.final_temperature = 0; }},
      {"confidence", [](O& o) { o.decision.confidence = 1; }},
      {"confidence", [](O& o) { o.decision.confidence = std::nan(""); }},
      {"final_temperature", [](O& o) { o.refinement.final_temperature = 2 * o.refinement.initial_temperature; }},
  };
  return values;
}

TEST(PipelineOptions, DefaultsAreValid) { EXPECT_NO_THROW(PipelineOptions().validate()); }

TEST(PipelineOptions, ValuesOutOfRangeAreRefusedNamingTheField) {
  for (const auto& bad : bad_values()) {
    PipelineOptions options;
    bad.set(options);
    try {
      options.validate();
      ADD_FAILURE() << bad.field << " was taken";
    } catch (const InvalidOptions& error) {
      EXPECT_NE(std::string(error.what()).find(bad.field), std::string::npos) << error.what();
    }
  }
}

TEST(PipelineOptions, BoundsOfInferenceAreChecked) {
  for (const auto& set : std::vector<std::function<void(InferenceOptions&)>>{
           [](InferenceOptions& o) { o.most_log_odds = 0; }, [](InferenceOptions& o) { o.log_implied = -1; },
           [](InferenceOptions& o) { o.log_implied = 2 * o.log_poses; },
           [](InferenceOptions& o) { o.log_missed = 0.1; }, [](InferenceOptions& o) { o.log_missed_there = 0.1; },
           [](InferenceOptions& o) { o.telling_overlap = 0; }, [](InferenceOptions& o) { o.log_spread = -1; },
           [](InferenceOptions& o) { o.set_spread = -1; }, [](InferenceOptions& o) { o.firm_left = 1.1; },
           [](InferenceOptions& o) { o.loose_left = o.firm_left; }, [](InferenceOptions& o) { o.log_slid = -1; },
           [](InferenceOptions& o) { o.max_starts = 0; }, [](InferenceOptions& o) { o.max_grown_scans = 0; },
           [](InferenceOptions& o) { o.max_sweeps = 0; }, [](InferenceOptions& o) { o.log_alike = -1; }}) {
    PipelineOptions options;
    set(options.inference);
    EXPECT_THROW(options.validate(), InvalidOptions);
  }
}

TEST(PipelineOptions, TheBoundsThemselvesAreValid) {
  PipelineOptions options;
  options.sampling.coarse_voxels = options.sampling.fine_voxels = 100;
  options.sampling.max_surface_variation = 1.0 / 3;
  options.adjustment.lp_steps = options.adjustment.steps = 0;
  options.refinement.annealing_steps = 0;
  options.decision.confidence = 0;
  options.refinement.final_temperature = options.refinement.initial_temperature;
  EXPECT_NO_THROW(options.validate());
}

TEST(Pipeline, ChecksItsOptionsWhenItIsMade) {
  PipelineOptions options;
  options.samples.fine_points = 0;
  EXPECT_THROW(Pipeline pipeline(options), InvalidOptions);
}

}  // namespace
}  // namespace tcm_icp

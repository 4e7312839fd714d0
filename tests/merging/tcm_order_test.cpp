#include "merging/tcm_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "merging/merged_cloud.hpp"
#include "pipeline/prepared_scene.hpp"
#include "tcm_icp/graph/correspondence_measure.hpp"
#include "tcm_icp/pipeline/pipeline_options.hpp"

namespace tcm_icp {
namespace {

// Scans on an ellipse, each of some 9 m around: neighbours overlap more than opposite ones. Scan 0 is merged.
class TcmOrderTest : public ::testing::Test {
 protected:
  TcmOrderTest() {
    MergedCloud merged(s_.resolutions.coarse_m);
    merged.add(s_.scans[0].pyramid.level(0).cloud, Eigen::Isometry3d::Identity());
    cloud_.emplace(merged.pyramid());
    for (const std::size_t i : {3u, 1u, 4u, 2u}) choices_.push_back({i, s_.scene.T_target_source(0, i)});
  }
  std::size_t next(MergeOrder wanted, Profile profile = Profile::kRobust) {
    options_.order = wanted;
    options_.paper_tcm = profile == Profile::kPaper;
    TcmOrder order(s_.scans, options_, context_);
    found_ = find(order);
    return choices_[found_.position].scan;
  }
  struct Found {
    std::size_t position = 0;
    TcmTerms terms;
  };
  Found find(TcmOrder& order) const {
    const auto measures = order.measure(cloud_->level(order.level()), choices_);
    const std::size_t position = order.next(choices_, measures);
    return {position, measures[position].terms};
  }
  std::vector<TcmTerms> robust_terms() const {
    std::vector<TcmTerms> terms;
    const std::size_t level = options_.fits ? 1 : 2;
    const RobustTcmCloud s(cloud_->level(level).cloud.points);
    for (const auto& c : choices_) {
      const RobustTcmCloud scan(s_.scans[c.scan].pyramid.level(level).cloud.points);
      terms.push_back(robust_tcm_terms(s, scan, c.T_reference_scan));
    }
    return terms;
  }
  std::vector<TcmTerms> paper_terms() const {
    std::vector<TcmTerms> terms;
    const TcmCloud s(cloud_->level(0).cloud.points);
    for (const auto& c : choices_) {
      terms.push_back(tcm_terms(s, TcmCloud(s_.scans[c.scan].pyramid.level(0).cloud.points), c.T_reference_scan));
    }
    return terms;
  }
  static std::size_t least(const std::vector<TcmTerms>& terms) {
    return static_cast<std::size_t>(
        std::min_element(terms.begin(), terms.end(),
                         [](const TcmTerms& a, const TcmTerms& b) { return a.tau() < b.tau(); }) -
        terms.begin());
  }

  Rng rng_ = make_stream(1, "tcm_order_test");
  const testing::PreparedScene s_ =
      testing::prepared_scene({.num_scans = 5, .points_per_scan = 3000, .range_m = 9, .noise_m = 0.02}, rng_);
  std::optional<ScanPyramid> cloud_;
  std::vector<MergeChoice> choices_;
  MergeOptions options_;
  RunContext context_;
  Found found_;
};

TEST_F(TcmOrderTest, WithoutFitsACoarserLevelTells) {
  const std::vector<TcmTerms> fine = robust_terms();
  options_.fits = false;
  const std::vector<TcmTerms> coarse = robust_terms();
  ASSERT_NE(fine[0].tau(), coarse[0].tau());
  EXPECT_EQ(next(MergeOrder::kTcm), choices_[least(coarse)].scan);
  EXPECT_EQ(found_.terms.tau(), coarse[least(coarse)].tau());
}

TEST_F(TcmOrderTest, WhatLiesInOneVoxelIsMergedLast) {
  options_.fits = false;
  std::vector<PreparedScan> scans = s_.scans;
  const std::size_t tiny = next(MergeOrder::kTcm);
  const Cloud& cloud = scans[tiny].pyramid.level(0).cloud;
  scans[tiny].pyramid = ScanPyramid({{cloud.points[0]}, {cloud.normals[0]}}, s_.resolutions.coarse_m, 4);
  TcmOrder order(scans, options_, context_);
  const auto measures = order.measure(cloud_->level(order.level()), choices_);
  EXPECT_NE(choices_[order.next(choices_, measures)].scan, tiny);

  const Cloud point{{Eigen::Vector3d::Zero()}, {Eigen::Vector3d::UnitZ()}};
  for (const MergeMeasure& m : order.measure(PyramidLevel(1, point), choices_)) EXPECT_TRUE(std::isinf(m.terms.tau()));
}

TEST_F(TcmOrderTest, TheLeastTauIsNext) {
  const auto terms = robust_terms();
  for (const MergeOrder wanted : {MergeOrder::kTcm, MergeOrder::kRobustTcm}) {
    next(wanted);
    EXPECT_EQ(found_.position, least(terms));
    EXPECT_EQ(found_.terms.tau(), terms[found_.position].tau());
    EXPECT_GT(found_.terms.tau(), 0);
  }
}

TEST_F(TcmOrderTest, TcmIsThePapersWhereItsProfileOrTheOrderAsksForIt) {
  const auto terms = paper_terms();
  ASSERT_NE(terms[least(terms)].tau(), robust_terms()[least(terms)].tau());
  for (const auto& [order, profile] :
       {std::pair(MergeOrder::kTcm, Profile::kPaper), std::pair(MergeOrder::kPaperTcm, Profile::kPaper),
        std::pair(MergeOrder::kPaperTcm, Profile::kRobust)}) {
    next(order, profile);
    EXPECT_EQ(found_.terms.tau(), terms[found_.position].tau());
    EXPECT_EQ(found_.terms.tau(), terms[least(terms)].tau());
  }
  next(MergeOrder::kRobustTcm, Profile::kPaper);
  EXPECT_EQ(found_.terms.tau(), robust_terms()[found_.position].tau());
}

TEST_F(TcmOrderTest, TheOrderOfTheChoicesDecidesNothing) {
  const std::size_t scan = next(MergeOrder::kTcm);
  std::reverse(choices_.begin(), choices_.end());
  EXPECT_EQ(next(MergeOrder::kTcm), scan);
}

TEST_F(TcmOrderTest, ByOverlapTheLargestIsNext) {
  const PyramidLevel& s = cloud_->level(1);
  std::vector<double> shares;
  for (const auto& c : choices_) {
    const PyramidLevel& scan = s_.scans[c.scan].pyramid.level(1);
    shares.push_back(overlap(s, scan, c.T_reference_scan, 2 * s.voxel_size_m));
  }
  ASSERT_LT(*std::min_element(shares.begin(), shares.end()), *std::max_element(shares.begin(), shares.end()));
  next(MergeOrder::kOverlap);
  EXPECT_EQ(shares[found_.position], *std::max_element(shares.begin(), shares.end()));
}

TEST_F(TcmOrderTest, AsTheFilesStandTheFirstChoiceIsNext) {
  next(MergeOrder::kFile);
  EXPECT_EQ(found_.position, 0u);
  std::reverse(choices_.begin(), choices_.end());
  next(MergeOrder::kFile);
  EXPECT_EQ(found_.position, 0u);
}

TEST_F(TcmOrderTest, AtRandomTheSeedDecidesEachDrawAnew) {
  options_.order = MergeOrder::kRandom;
  std::set<std::vector<std::size_t>> drawn;
  for (context_.seed = 0; context_.seed < 8; ++context_.seed) {
    const auto draw = [&] {
      TcmOrder order(s_.scans, options_, context_);
      std::vector<std::size_t> scans;
      for (int k = 0; k < 3; ++k) scans.push_back(choices_[find(order).position].scan);
      return scans;
    };
    drawn.insert(draw());
    EXPECT_EQ(drawn.count(draw()), 1u) << "the same seed, the same scans";
  }
  EXPECT_GT(drawn.size(), 4u) << "of 64, 8 draws hardly give the same ones";
}

TEST_F(TcmOrderTest, ThreadsDoNotChangeABit) {
  next(MergeOrder::kTcm);
  const Found one = found_;
  context_.num_threads = 2;
  next(MergeOrder::kTcm);
  EXPECT_EQ(found_.position, one.position);
  EXPECT_EQ(found_.terms.tau(), one.terms.tau());
}

}  // namespace
}  // namespace tcm_icp

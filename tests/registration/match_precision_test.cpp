#include "tcm_icp/registration/match_precision.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "registration/joint_normal_equations.hpp"
#include "support/joint_scene.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

// Every other match is of a crown: normals that do not agree, and 33 times the error.
constexpr double kNoise_m = 0.003, kRoughNoise_m = 0.1;

testing::JointScene half_rough_scene(Rng& rng) {
  testing::JointScene scene = testing::joint_scene({.noise_m = kNoise_m}, rng);
  for (auto& link : scene.links) {
    for (std::size_t k = 0; k < link.matches.size(); ++k) {
      Correspondence& match = link.matches[k];
      const bool rough = k % 2 == 0;
      match.agreement = rough ? 0.9 * uniform01(rng) : 1 - 0.01 * uniform01(rng);
      if (rough) match.target += kRoughNoise_m * standard_normal(rng) * match.normal;
    }
  }
  return scene;
}

// Largest error [m] of the steps that Huber's least squares find.
double error_m(const testing::JointScene& scene) {
  JointNormalEquations equations(scene.frames, 0);
  const double threshold_m = 1.345 * robust_noise_m(scene.links);
  for (const auto& link : scene.links) {
    equations.add(link, huber_sums(link, scene.frames[link.target], scene.frames[link.source], threshold_m));
  }
  const Eigen::VectorXd x = equations.solve();
  double largest_m = 0;
  for (std::size_t i = 1; i < scene.frames.size(); ++i) {
    const Twist step_m = x.segment<6>(static_cast<Eigen::Index>(6 * i));
    largest_m = std::max(largest_m, (step_m - scene.truth_m[i]).norm());
  }
  return largest_m;
}

TEST(SetPrecisions, RoughPlacesWeighLessAndTheStepsComeOutBetter) {
  Rng rng = make_stream(1, "match_precision_test");
  // Steps of nothing: residuals are the errors.
  testing::JointScene scene = half_rough_scene(rng);
  for (auto& link : scene.links) {
    for (auto& match : link.matches) {
      const double home = residual_gradient(match, scene.frames[link.source]).dot(scene.truth_m[link.source]) -
                          residual_gradient(match, scene.frames[link.target]).dot(scene.truth_m[link.target]);
      match.target -= home * match.normal;
    }
  }
  for (Twist& step : scene.truth_m) step.setZero();
  const double before_m = error_m(scene);
  set_precisions(scene.links);
  double rough = 0, smooth = std::numeric_limits<double>::infinity();
  for (const auto& link : scene.links) {
    for (const auto& match : link.matches) {
      if (match.agreement < 0.85) rough = std::max(rough, match.precision);
      if (match.agreement > 0.995) smooth = std::min(smooth, match.precision);
    }
  }
  // The errors are 33 times as large; classes that hold a few of the other kind take a little of that.
  EXPECT_GT(smooth, 20 * rough);
  EXPECT_LE(smooth, kMaxPrecision);
  EXPECT_LT(error_m(scene), before_m / 2);
}

TEST(SetPrecisions, AllAreAboutOneWhereNormalsTellNothing) {
  Rng rng = make_stream(2, "match_precision_test");
  testing::JointScene scene = testing::joint_scene({.noise_m = kNoise_m, .step_m = 0}, rng);
  for (auto& link : scene.links) {
    for (auto& match : link.matches) match.agreement = uniform01(rng);
  }
  set_precisions(scene.links);
  for (const auto& link : scene.links) {
    // 300 matches a class: their median is good to a tenth, twice that is allowed.
    for (const auto& match : link.matches) EXPECT_NEAR(match.precision, 1, 0.2);
  }
}

TEST(SetPrecisions, ResidualsHaveOneStandardDeviationThen) {
  Rng rng = make_stream(3, "match_precision_test");
  testing::JointScene scene = half_rough_scene(rng);
  const double noise_m = robust_noise_m(scene.links);
  set_precisions(scene.links);
  EXPECT_NEAR(robust_noise_m(scene.links), noise_m, 0.1 * noise_m);
}

TEST(SetPrecisions, NeitherTheOrderOfLinksNorASecondCallChangesThem) {
  Rng rng = make_stream(4, "match_precision_test");
  testing::JointScene scene = half_rough_scene(rng);
  std::vector<JointLink> turned(scene.links.rbegin(), scene.links.rend());
  set_precisions(scene.links);
  set_precisions(turned);
  set_precisions(turned);
  for (std::size_t l = 0; l < turned.size(); ++l) {
    const JointLink& same = scene.links[turned.size() - 1 - l];
    for (std::size_t k = 0; k < same.matches.size(); ++k) {
      ASSERT_EQ(same.matches[k].precision, turned[l].matches[k].precision);
    }
  }
}

// Two points that are each other's nearest make a match of both links: one agreement, summed in another order.
TEST(SetPrecisions, DoNotDependOnTheRoundingOfAgreements) {
  Rng rng = make_stream(5, "match_precision_test");
  const testing::JointScene scene = half_rough_scene(rng);
  const auto precisions = [&] {
    std::vector<JointLink> links = scene.links;
    for (std::size_t l = 0; l + 1 < links.size(); l += 2) {
      for (std::size_t k = 0; k < std::min(links[l].matches.size(), links[l + 1].matches.size()); ++k) {
        links[l + 1].matches[k].agreement = links[l].matches[k].agreement * (1 + 1e-15 * standard_normal(rng));
      }
    }
    // One below and one above all twins, so that borders are drawn at the second of two.
    links[0].matches[0].agreement = 0;
    links[1].matches[0].agreement = 1;
    set_precisions(links);
    std::vector<double> out;
    for (const auto& link : links) {
      for (const auto& match : link.matches) out.push_back(match.precision);
    }
    return out;
  };
  const std::vector<double> expected = precisions();
  for (int draw = 0; draw < 20; ++draw) ASSERT_EQ(precisions(), expected);
}

// What a street's pilasters do: one match in five is of two faces, a step apart, and all of these draw one way.
TEST(SetPrecisions, DoubtedMatchesWeighByTheirOwnDeviationWhereItIsLarger) {
  Rng rng = make_stream(6, "match_precision_test");
  testing::JointScene scene = testing::joint_scene({.noise_m = kNoise_m, .step_m = 0}, rng);
  std::vector<std::vector<bool>> doubted;
  for (auto& link : scene.links) {
    doubted.emplace_back(link.matches.size(), false);
    for (std::size_t k = 0; k < link.matches.size(); k += 5) {
      const double away = link.source < link.target ? 1 : -1;
      Correspondence& match = link.matches[k];
      match.source += (away * match.normal.x() > 0 ? 1 : -1) * 8 * kNoise_m * match.normal;
      doubted.back()[k] = true;
    }
  }
  set_precisions(scene.links);
  const double believed_m = error_m(scene);
  set_precisions(scene.links, doubted);
  for (std::size_t l = 0; l < doubted.size(); ++l) EXPECT_LT(scene.links[l].matches[0].precision, 0.15);
  EXPECT_LT(error_m(scene), believed_m / 2);
}

TEST(SetPrecisions, DoubtThatResidualsDoNotBearOutChangesLittle) {
  Rng rng = make_stream(7, "match_precision_test");
  testing::JointScene scene = testing::joint_scene({.noise_m = kNoise_m, .step_m = 0}, rng);
  std::vector<std::vector<bool>> doubted;
  for (const auto& link : scene.links) {
    doubted.emplace_back();
    for (std::size_t k = 0; k < link.matches.size(); ++k) doubted.back().push_back(uniform01(rng) < 0.2);
  }
  set_precisions(scene.links, doubted);
  for (const auto& link : scene.links) {
    for (const auto& match : link.matches) EXPECT_NEAR(match.precision, 1, 0.2);
  }
}

TEST(SetPrecisions, AreFiniteWhereThereIsNothingOrNoErrorToGoBy) {
  std::vector<JointLink> none;
  set_precisions(none);
  std::vector<JointLink> exact{{0, 1, Correspondences(900)}};
  for (std::size_t k = 0; k < 900; ++k) {
    Correspondence& match = exact[0].matches[k];
    match.source = match.target = Eigen::Vector3d(static_cast<double>(k), 0, 0);
    match.normal = Eigen::Vector3d::UnitZ();
    match.agreement = static_cast<double>(k % 10) / 10;
  }
  set_precisions(exact);
  for (const auto& match : exact[0].matches) EXPECT_EQ(match.precision, 1);
  // Exact but for the half whose normals agree least.
  for (auto& match : exact[0].matches) match.target.z() = match.agreement < 0.45 || match.source.x() > 890 ? 0.1 : 0;
  set_precisions(exact);
  for (const auto& match : exact[0].matches) {
    EXPECT_TRUE(std::isfinite(match.precision));
    EXPECT_LE(match.precision, kMaxPrecision);
    EXPECT_GT(match.precision, 0);
  }
}

}  // namespace
}  // namespace tcm_icp

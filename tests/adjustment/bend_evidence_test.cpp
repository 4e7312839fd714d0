#include "adjustment/bend_evidence.hpp"

#include <gtest/gtest.h>

#include "support/joint_scene.hpp"
#include "tcm_icp/core/random.hpp"

namespace tcm_icp {
namespace {

// Which points share a cube of twice the edge, the numbers without the last three bits tell.
TEST(BendEvidence, CubesOfTwiceTheEdgeLackThreeBits) {
  const Eigen::Vector3d centre(3, -2, 1);
  Rng rng = make_stream(1, "bend_evidence_test");
  const auto point = [&] {
    return Eigen::Vector3d(centre + 3 * Eigen::Vector3d::NullaryExpr([&] { return standard_normal(rng); }));
  };
  int alike = 0;
  for (int k = 0; k < 1000; ++k) {
    const Eigen::Vector3d p = point(), q = point();
    const bool share = cube_of(p, centre, 4) == cube_of(q, centre, 4);
    EXPECT_EQ(cube_of(p, centre, 2) >> 3 == cube_of(q, centre, 2) >> 3, share);
    alike += share ? 1 : 0;
  }
  EXPECT_GT(alike, 10);
  EXPECT_LT(alike, 950);
}

TEST(BendEvidence, ErrorsOfAPlaceAddUp) {
  // Two scores of each place: once they add up, once they take each other away. Places take each other away, too, so
  // that larger cubes hold nothing.
  const std::size_t num_places = 2 * least_cubes();
  std::vector<PlacedScore<1>> alike, opposite;
  for (std::size_t k = 0; k < num_places; ++k) {
    const std::uint64_t cube = k << 30;
    for (const double sign : {1.0, -1.0}) {
      const double of_place = k % 2 == 0 ? 1 : -1;
      alike.push_back({cube, Eigen::Matrix<double, 1, 1>(of_place)});
      opposite.push_back({cube, Eigen::Matrix<double, 1, 1>(sign)});
    }
  }
  EXPECT_DOUBLE_EQ(squares_of_places(alike), 4.0 * static_cast<double>(num_places));
  EXPECT_EQ(squares_of_places(opposite), 0);
}

// One number a scan, which moves its matches along the normal by as much as each is told to.
struct OneNumber {
  testing::JointScene scene;
  std::vector<std::vector<double>> by;  // of each match of each link

  double gradient(const JointLink& link, const Correspondence& match, bool is_target) const {
    const auto k = static_cast<std::size_t>(&link - scene.links.data());
    const double own = by[k][static_cast<std::size_t>(&match - link.matches.data())];
    return is_target ? -own : own;
  }
};

OneNumber one_number(double deviation_m, std::uint64_t seed) {
  Rng rng = make_stream(seed, "bend_evidence_test");
  OneNumber out{testing::joint_scene({.num_scans = 10, .noise_m = 0.01, .step_m = 0}, rng), {}};
  std::vector<double> numbers_m;
  for (int i = 0; i < 10; ++i) numbers_m.push_back(deviation_m * standard_normal(rng));
  for (auto& link : out.scene.links) {
    auto& by = out.by.emplace_back();
    for (auto& match : link.matches) {
      by.push_back(standard_normal(rng));
      match.target -= (numbers_m[link.source] - numbers_m[link.target]) * by.back() * match.normal;
    }
  }
  return out;
}

BendPrior prior_of(const OneNumber& set, const std::vector<bool>& asked) {
  return likeliest_prior<1>(set.scene.links, set.scene.frames, asked, {0.01, 0.2}, 1,
                            [&](const JointLink& link, const Correspondence& match, bool is_target) {
                              return set.gradient(link, match, is_target);
                            });
}

TEST(BendEvidence, ItsDeviationIsFoundHoweverLargeItIs) {
  const std::vector<bool> all(10, true);
  for (const double deviation_m : {0.005, 0.05}) {
    double squares_m2 = 0;
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
      const BendPrior prior = prior_of(one_number(deviation_m, seed), all);
      ASSERT_TRUE(prior.any());
      squares_m2 += prior.deviation_m * prior.deviation_m / 4;
    }
    EXPECT_GT(std::sqrt(squares_m2), 0.5 * deviation_m);
    EXPECT_LT(std::sqrt(squares_m2), 1.5 * deviation_m);
  }
}

TEST(BendEvidence, NothingIsNothing) {
  EXPECT_FALSE(prior_of(one_number(0.05, 1), std::vector<bool>(10, false)).any());
  int found = 0;
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    const BendPrior prior = prior_of(one_number(0, seed), std::vector<bool>(10, true));
    found += prior.any() ? 1 : 0;
    EXPECT_LT(prior.deviation_m, 0.002);
  }
  EXPECT_LE(found, 2);
}

}  // namespace
}  // namespace tcm_icp

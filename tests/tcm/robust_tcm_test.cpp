#include "tcm_icp/tcm/robust_tcm.hpp"

#include <gtest/gtest.h>

#include "support/random_points.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/core/rigid_transform.hpp"

namespace tcm_icp {
namespace {

using testing::scaled;

Points line(std::size_t count, double step, double y) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) points.emplace_back(step * static_cast<double>(i), y, 0);
  return points;
}

// An uneven sheet of edge 10 m, `from` metres along x.
Points sheet(double from, std::size_t count, Rng& rng) {
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double x = from + 10 * uniform01(rng), y = 10 * uniform01(rng);
    points.emplace_back(x, y, std::sin(x) + std::cos(2 * y));
  }
  return points;
}

TEST(RobustTcm, HasTheValueWorkedOutByHand) {
  // a: 8 points at x = 0..7, y = 0. b: 4 points at x = 0, 2, 4, 6, y = 3, a quarter as the share.
  // b to a: every point has one straight below: 9, so Q_b = 9, whatever the share.
  // a to b: 9 at even x, 10 at odd x; ranked 9 9 9 9 10 ...; share 0.25 * 4/8 of 8 points: the first: 9. f = 18.
  // Spacings 1 and 2: g = 1 + 1/2.
  const TcmTerms terms = robust_tcm_terms(RobustTcmCloud(line(8, 1, 0)), RobustTcmCloud(line(4, 2, 3)));
  EXPECT_DOUBLE_EQ(terms.f, 18);
  EXPECT_DOUBLE_EQ(terms.g, 1.5);
  EXPECT_DOUBLE_EQ(terms.h, 1);
  EXPECT_DOUBLE_EQ(terms.tau(), 27);
}

TEST(RobustTcm, AHigherQuantileReachesTheFartherPoints) {
  // As above with all points: a's share 1 * 4/8 of 8 = the fourth: 9; with 8 points of b (x = 0..14) it is the
  // eighth: 10.
  RobustTcmOptions all;
  all.quantile = 1;
  EXPECT_DOUBLE_EQ(robust_tcm_terms(RobustTcmCloud(line(8, 1, 0), all), RobustTcmCloud(line(4, 2, 3), all)).f, 9 + 9);
  // b's farthest: x = 14 from x = 7: 49 + 9 = 58.
  EXPECT_DOUBLE_EQ(robust_tcm_terms(RobustTcmCloud(line(8, 1, 0), all), RobustTcmCloud(line(8, 2, 3), all)).f, 10 + 58);
}

TEST(RobustTcm, EqualSpacingsDoNotMakeItZero) {
  EXPECT_DOUBLE_EQ(robust_tcm_terms(RobustTcmCloud(line(8, 1, 0)), RobustTcmCloud(line(8, 1, 3))).tau(), 18);
}

TEST(RobustTcm, ADuplicateOrAStrayPointDoesNotDecide) {
  Rng rng = make_stream(3, "robust_tcm_test");
  const Points a = sheet(0, 400, rng), b = sheet(4, 400, rng);
  const double tau = robust_tcm_terms(RobustTcmCloud(a), RobustTcmCloud(b)).tau();
  const double printed = tcm({a, {}}, {b, {}});
  Points spoilt = b;
  spoilt.push_back(b.front());
  spoilt.emplace_back(1e6, 0, 0);
  // One rank in a hundred moves f by a few percent; the printed measure moves by orders of magnitude.
  EXPECT_NEAR(robust_tcm_terms(RobustTcmCloud(a), RobustTcmCloud(spoilt)).tau(), tau, 0.1 * tau);
  EXPECT_GT(tcm({a, {}}, {spoilt, {}}), 100 * printed);
}

TEST(RobustTcm, GrowsAsTheOverlapShrinks) {
  Rng rng = make_stream(5, "robust_tcm_test");
  const RobustTcmCloud a(sheet(0, 1000, rng));
  double before = 0;
  for (const double from : {2.0, 5.0, 8.0, 9.5, 12.0}) {
    const double tau = robust_tcm_terms(a, RobustTcmCloud(sheet(from, 1000, rng))).tau();
    EXPECT_GT(tau, before) << "shifted by " << from << " m";
    before = tau;
  }
}

TEST(RobustTcm, DoesNotChargeASmallScanForTheRestOfALargeOne) {
  Rng rng = make_stream(6, "robust_tcm_test");
  Points large;
  for (int strip = 0; strip < 10; ++strip) {
    for (const auto& p : sheet(10 * strip, 1000, rng)) large.push_back(p);
  }
  const double inside = robust_tcm_terms(RobustTcmCloud(large), RobustTcmCloud(sheet(40, 1000, rng))).f;
  const double beside = robust_tcm_terms(RobustTcmCloud(large), RobustTcmCloud(sheet(104, 1000, rng))).f;
  EXPECT_LT(inside, 0.2) << "spacing of the sheet is about 0.3 m";
  EXPECT_LT(inside, beside);
}

TEST(RobustTcm, ScalesWithTheSquareAndIgnoresACommonMotion) {
  Rng rng = make_stream(9, "robust_tcm_test");
  const Points a = sheet(0, 300, rng), b = sheet(3, 500, rng);
  const double tau = robust_tcm_terms(RobustTcmCloud(a), RobustTcmCloud(b)).tau();
  const RobustTcmCloud large_a(scaled(a, 1000)), large_b(scaled(b, 1000));
  EXPECT_NEAR(robust_tcm_terms(large_a, large_b).tau(), 1e6 * tau, 1e-8 * 1e6 * tau);
  Twist twist;
  twist << 0.9, -1.3, 0.4, 5, 6, -7;
  const Eigen::Isometry3d T = isometry_from_twist(twist);
  const RobustTcmCloud moved_a(transformed({a, {}}, T).points), moved_b(transformed({b, {}}, T).points);
  EXPECT_NEAR(robust_tcm_terms(moved_a, moved_b).tau(), tau, 1e-9 * tau);
  EXPECT_NEAR(robust_tcm_terms(moved_a, RobustTcmCloud(b), T).tau(), tau, 1e-9 * tau);
}

TEST(RobustTcm, DuplicatesOnlyAreAsDenseAsEachOther) {
  const Points here(3, Eigen::Vector3d(0, 0, 0)), there(5, Eigen::Vector3d(0, 3, 4));
  const TcmTerms terms = robust_tcm_terms(RobustTcmCloud(here), RobustTcmCloud(there));
  EXPECT_DOUBLE_EQ(terms.g, 1);
  EXPECT_DOUBLE_EQ(terms.f, 50);  // 25 both ways
}

TEST(RobustTcm, RefusesTooFewPointsAndBadOptions) {
  EXPECT_THROW(RobustTcmCloud(Points{{0, 0, 0}}), InvalidInput);
  RobustTcmOptions options;
  options.quantile = 0;
  EXPECT_THROW(RobustTcmCloud(line(3, 1, 0), options), InvalidOptions);
  options.quantile = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(RobustTcmCloud(line(3, 1, 0), options), InvalidOptions);
  options = {};
  options.max_samples = 0;
  EXPECT_THROW(RobustTcmCloud(line(3, 1, 0), options), InvalidOptions);
}

}  // namespace
}  // namespace tcm_icp

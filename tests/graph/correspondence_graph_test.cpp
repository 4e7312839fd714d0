#include "tcm_icp/graph/correspondence_graph.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

using Scans = std::vector<std::size_t>;
constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// 0-1 0.1, 0-2 0.3, 1-2 0.2, 3-4 0.4; all others 0.9.
Eigen::MatrixXd five_scans() {
  Eigen::MatrixXd m = Eigen::MatrixXd::Constant(5, 5, 0.9);
  m(0, 1) = m(1, 0) = 0.1;
  m(0, 2) = m(2, 0) = 0.3;
  m(1, 2) = m(2, 1) = 0.2;
  m(3, 4) = m(4, 3) = 0.4;
  return m;
}

TEST(CorrespondenceGraph, ConnectsWhatIsBelowTheThreshold) {
  const CorrespondenceGraph graph = build_correspondence_graph(five_scans(), 0.5);
  EXPECT_EQ(graph.adjacency, (std::vector<Scans>{{1, 2}, {0, 2}, {0, 1}, {4}, {3}}));
  EXPECT_EQ(graph.degree(0), 2u);
  EXPECT_EQ(graph.degree(3), 1u);
  EXPECT_EQ(graph.component, (Scans{0, 0, 0, 1, 1}));
  EXPECT_EQ(graph.num_components, 2u);
  EXPECT_EQ(graph.reference, 2u) << "degree 2 like 0 and 1, but in the middle of five";
  EXPECT_FALSE(graph.threshold_from_data);
}

TEST(CorrespondenceGraph, AMeasureAtTheThresholdDoesNotConnect) {
  const CorrespondenceGraph graph = build_correspondence_graph(five_scans(), 0.1);
  EXPECT_EQ(graph.num_components, 5u);
  EXPECT_EQ(graph.component, (Scans{0, 1, 2, 3, 4}));
  EXPECT_EQ(graph.reference, 2u);
}

TEST(CorrespondenceGraph, TheDiagonalIsNotLookedAt) {
  Eigen::MatrixXd m = five_scans();
  m.diagonal().setConstant(kNaN);
  EXPECT_EQ(build_correspondence_graph(m, 0.5).adjacency, build_correspondence_graph(five_scans(), 0.5).adjacency);
}

TEST(CorrespondenceGraph, ThresholdFromTheDataConnectsTheNearerHalf) {
  // Ranked: 0.1 0.2 0.3 0.4 then six of 0.9; the lower middle of ten is the fifth: 0.9, and all pairs are connected.
  // Without one pair at 0.9 (infinite: no measure) nine are left, with the fifth 0.9 still; without three, seven, the
  // fourth is 0.4.
  Eigen::MatrixXd m = five_scans();
  m(0, 3) = m(3, 0) = m(0, 4) = m(4, 0) = m(1, 4) = m(4, 1) = kNone;
  EXPECT_NEAR(correspondence_threshold(m), 0.4, 1e-15);
  const CorrespondenceGraph graph = build_correspondence_graph(m);
  EXPECT_TRUE(graph.threshold_from_data);
  EXPECT_EQ(graph.degree(3), 1u);
  EXPECT_EQ(graph.num_components, 2u);
}

TEST(CorrespondenceGraph, ThresholdFromTheDataHasNoUnit) {
  Eigen::MatrixXd m = five_scans();
  m(0, 3) = m(3, 0) = m(0, 4) = m(4, 0) = m(1, 4) = m(4, 1) = kNone;
  EXPECT_EQ(build_correspondence_graph(m).adjacency, build_correspondence_graph(1000 * m).adjacency);
}

TEST(CorrespondenceGraph, TwoScansAreConnectedByAThresholdFromTheData) {
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(2, 2);
  m(0, 1) = m(1, 0) = 3;
  const CorrespondenceGraph graph = build_correspondence_graph(m);
  EXPECT_EQ(graph.num_components, 1u);
  EXPECT_EQ(graph.reference, 0u) << "both are as near the middle: the earlier one";
}

TEST(CorrespondenceGraph, NothingMeasuredConnectsNothing) {
  const CorrespondenceGraph graph = build_correspondence_graph(Eigen::MatrixXd::Constant(3, 3, kNone));
  EXPECT_EQ(graph.num_components, 3u);
  EXPECT_EQ(graph.reference, 1u);
}

TEST(CorrespondenceGraph, OneScanIsItsOwnReference) {
  const CorrespondenceGraph graph = build_correspondence_graph(Eigen::MatrixXd::Zero(1, 1));
  EXPECT_EQ(graph.reference, 0u);
  EXPECT_EQ(graph.num_components, 1u);
}

TEST(CorrespondenceGraph, RefusesWhatIsNoSymmetricMatrix) {
  EXPECT_THROW(build_correspondence_graph(Eigen::MatrixXd()), InvalidInput);
  EXPECT_THROW(build_correspondence_graph(Eigen::MatrixXd::Zero(2, 3)), InvalidInput);
  Eigen::MatrixXd m = five_scans();
  m(0, 1) = 0.11;
  EXPECT_THROW(build_correspondence_graph(m), InvalidInput);
  m(0, 1) = m(1, 0) = kNaN;
  EXPECT_THROW(build_correspondence_graph(m), InvalidInput);
  EXPECT_THROW(build_correspondence_graph(five_scans(), kNaN), InvalidInput);
}

TEST(ChooseReference, TakesTheMostConnected) { EXPECT_EQ(choose_reference({{1}, {0, 2}, {1, 3}, {2, 0, 1}}), 3u); }

TEST(ChooseReference, AmongEqualsTakesTheMiddleOfTheListThenTheEarlier) {
  EXPECT_EQ(choose_reference({{}, {}, {}, {}, {}}), 2u);
  EXPECT_EQ(choose_reference({{}, {}, {}, {}}), 1u) << "1 and 2 are as near the middle 1.5";
  EXPECT_EQ(choose_reference({{3}, {}, {}, {0}}), 0u);
}

TEST(ChooseReference, RefusesAnEmptyList) { EXPECT_THROW(choose_reference({}), InvalidInput); }

}  // namespace
}  // namespace tcm_icp

#include "pipeline/name_order.hpp"

#include <gtest/gtest.h>

namespace tcm_icp {
namespace {

using Order = std::vector<std::size_t>;

TEST(NameOrder, IsOfTheFilesNotOfTheirFolders) {
  EXPECT_EQ(order_by_name({"a/3.ply", "c/1.ply", "b/2.ply"}), (Order{1, 2, 0}));
  EXPECT_EQ(in_order(std::vector<char>{'c', 'a', 'b'}, {1, 2, 0}), (std::vector<char>{'a', 'b', 'c'}));
}

TEST(NameOrder, IsTakenBackInAllThatNumbersScans) {
  const Order order{2, 0, 1};  // the first by name was the last given
  PipelineResult result;
  result.reference = 0;
  result.scans.resize(3);
  result.poses.resize(3);
  for (std::size_t k = 0; k < 3; ++k) {
    result.scans[k].file = result.poses[k].file = std::string(1, "abc"[k]);
  }
  result.graph.measure = Eigen::MatrixXd::Zero(3, 3);
  result.graph.measure(0, 1) = result.graph.measure(1, 0) = 7;
  result.graph.adjacency = {{1, 2}, {0}, {0}};
  result.graph.component = {0, 1, 2};
  result.merges.resize(1);
  result.merges[0].scan = 1;
  result.merges[0].members = {1, 2};
  result.links.resize(1);
  result.links[0].b = 1;
  result.hypotheses.resize(1);
  result.hypotheses[0].a = 1;
  result.hypotheses[0].b = 2;
  result.adjustment.outlying_pairs = {{0, 2}};
  result.pairs.resize(1);
  result.pairs[0].target = 1;
  restore_order(order, result);

  EXPECT_EQ(result.reference, 2u);
  EXPECT_EQ(result.scans[2].file, "a");
  EXPECT_EQ(result.poses[0].file, "b");
  EXPECT_EQ(result.graph.measure(2, 0), 7);
  EXPECT_EQ(result.graph.measure(0, 2), 7);
  EXPECT_EQ(result.graph.measure.sum(), 14);
  EXPECT_EQ(result.graph.adjacency, (std::vector<Order>{{2}, {2}, {0, 1}}));
  EXPECT_EQ(result.graph.component, (Order{1, 2, 0}));
  EXPECT_EQ(result.merges[0].scan, 0u);
  EXPECT_EQ(result.merges[0].members, (Order{0, 1}));
  EXPECT_EQ(std::pair(result.links[0].a, result.links[0].b), std::pair(std::size_t{2}, std::size_t{0}));
  EXPECT_EQ(std::pair(result.hypotheses[0].a, result.hypotheses[0].b), std::pair(std::size_t{0}, std::size_t{1}));
  EXPECT_EQ(result.adjustment.outlying_pairs[0], std::pair(std::size_t{2}, std::size_t{1}));
  EXPECT_EQ(std::pair(result.pairs[0].source, result.pairs[0].target), std::pair(std::size_t{2}, std::size_t{0}));
}

}  // namespace
}  // namespace tcm_icp

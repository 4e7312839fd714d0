#include "pipeline/scan_order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace tcm_icp {
namespace {

using Order = std::vector<std::size_t>;

struct Content {
  std::uint64_t num_points;
  double extent_m, spacing_m;
};

SampledScan scan(const Content& content) {
  SampledScan out;
  out.scan.num_raw_points = content.num_points;
  out.scan.extent_m = content.extent_m;
  out.scan.spacing_m = content.spacing_m;
  return out;
}

Order order(const std::vector<Content>& contents, const std::vector<std::filesystem::path>& paths) {
  std::vector<SampledScan> scans;
  for (std::size_t i = 0; i < contents.size(); ++i) {
    scans.push_back(scan(contents[i]));
    scans.back().scan.file = paths[i].filename();
  }
  return order_by_content(scans);
}

TEST(OrderByContent, CountsDecideThenExtentsThenSpacings) {
  EXPECT_EQ(order({{300, 1, 1}, {100, 9, 9}, {200, 1, 1}}, {"a", "b", "c"}), (Order{1, 2, 0}));
  EXPECT_EQ(order({{100, 3, 1}, {100, 1, 9}, {100, 2, 1}}, {"a", "b", "c"}), (Order{1, 2, 0}));
  EXPECT_EQ(order({{100, 1, 3}, {100, 1, 1}, {100, 1, 2}}, {"a", "b", "c"}), (Order{1, 2, 0}));
  EXPECT_TRUE(order({}, {}).empty());
}

TEST(OrderByContent, NamesDecideAmongScansThatAreAlikeAlone) {
  EXPECT_EQ(order({{300, 1, 1}, {100, 1, 1}, {200, 1, 1}}, {"c", "a", "b"}),
            order({{300, 1, 1}, {100, 1, 1}, {200, 1, 1}}, {"a", "c", "b"}));
  EXPECT_EQ(order({{100, 1, 1}, {100, 1, 1}, {100, 1, 1}}, {"x/c", "z/a", "y/b"}), (Order{1, 2, 0}))
      << "of the files, not of their folders";
}

TEST(OrderByContent, AnyOrderOfTheListGivesTheSameScans) {
  std::vector<Content> contents;
  std::vector<std::filesystem::path> paths;
  for (const std::uint64_t n : {100u, 200u}) {
    for (const double extent_m : {1.0, 2.0}) {
      for (const double spacing_m : {0.1, 0.2}) {
        contents.push_back({n, extent_m, spacing_m});
        paths.emplace_back(std::string(1, static_cast<char>('a' + paths.size())));
      }
    }
  }
  const auto names = [](const Order& by, const std::vector<std::filesystem::path>& of) {
    std::string out;
    for (const std::size_t i : by) out += of[i].string();
    return out;
  };
  const std::string expected = names(order(contents, paths), paths);
  EXPECT_EQ(expected, "abcdefgh");
  for (int shift = 1; shift < 8; ++shift) {
    std::rotate(contents.begin(), contents.begin() + 3, contents.end());
    std::rotate(paths.begin(), paths.begin() + 3, paths.end());
    EXPECT_EQ(names(order(contents, paths), paths), expected) << shift;
  }
}

// Each is alike the next but for rounding, but the first not the last: ties of ties are no ties.
TEST(OrderByContent, AChainOfTiesComesInOneOrderWhateverTheList) {
  const std::vector<std::pair<double, std::string>> scans{{1, "c"}, {1 + 0.7e-6, "b"}, {1 + 1.4e-6, "a"}};
  std::set<std::string> orders;
  Order list{0, 1, 2};
  do {
    std::vector<Content> contents;
    std::vector<std::filesystem::path> paths;
    for (const std::size_t i : list) {
      contents.push_back({100, scans[i].first, 1});
      paths.emplace_back(scans[i].second);
    }
    std::string names;
    for (const std::size_t i : order(contents, paths)) names += paths[i].string();
    orders.insert(names);
  } while (std::next_permutation(list.begin(), list.end()));
  EXPECT_EQ(orders.size(), 1u) << *orders.begin() << " and " << *orders.rbegin();
}

TEST(InOrder, TakesValuesAsTheOrderSays) {
  EXPECT_EQ(in_order(std::vector<char>{'c', 'a', 'b'}, {1, 2, 0}), (std::vector<char>{'a', 'b', 'c'}));
  EXPECT_EQ(order_of_list(3), (Order{0, 1, 2}));
  EXPECT_EQ(in_order(std::vector<char>{'c', 'a', 'b'}, order_of_list(3)), (std::vector<char>{'c', 'a', 'b'}));
}

TEST(RestoreOrder, IsTakenBackInAllThatNumbersScans) {
  const Order order{2, 0, 1};  // the first that was worked on was the last given
  PipelineResult result;
  result.reference = 0;
  result.scans.resize(3);
  result.poses.resize(3);
  result.evidence.resize(3);
  result.free_space.resize(3);
  result.viewpoints.resize(3);
  result.measurements.resize(3);
  result.decisions.resize(3);
  result.uncertainty.poses.resize(3);
  for (std::size_t k = 0; k < 3; ++k) {
    result.scans[k].file = result.poses[k].file = result.decisions[k].text = std::string(1, "abc"[k]);
    result.evidence[k].emplace().num_points = k;
    result.free_space[k].num_points = k;
    result.viewpoints[k].emplace().place.x() = static_cast<double>(k);
    result.measurements[k].emplace().num_moved = k;
    result.uncertainty.poses[k].centre.x() = static_cast<double>(k);
  }
  result.graph.measure = Eigen::MatrixXd::Zero(3, 3);
  result.graph.measure(0, 1) = result.graph.measure(1, 0) = 7;
  result.graph.adjacency = {{1, 2}, {0}, {0}};
  result.graph.component = {0, 1, 2};
  result.graph.reference = 1;
  result.merges.resize(1);
  result.merges[0].scan = 1;
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
  for (std::size_t k = 0; k < 3; ++k) {
    const std::string file(1, "abc"[k]);
    EXPECT_EQ(result.scans[order[k]].file, file);
    EXPECT_EQ(result.poses[order[k]].file, file);
    EXPECT_EQ(result.decisions[order[k]].text, file);
    EXPECT_EQ(result.evidence[order[k]]->num_points, k);
    EXPECT_EQ(result.free_space[order[k]].num_points, k);
    EXPECT_EQ(result.viewpoints[order[k]]->place.x(), static_cast<double>(k));
    EXPECT_EQ(result.measurements[order[k]]->num_moved, k);
    EXPECT_EQ(result.uncertainty.poses[order[k]].centre.x(), static_cast<double>(k));
    EXPECT_EQ(result.graph.component[order[k]], k);
  }
  EXPECT_EQ(result.graph.measure(2, 0), 7);
  EXPECT_EQ(result.graph.measure(0, 2), 7);
  EXPECT_EQ(result.graph.measure.sum(), 14);
  EXPECT_EQ(result.graph.adjacency, (std::vector<Order>{{2}, {2}, {0, 1}}));
  EXPECT_EQ(result.graph.reference, 0u);
  EXPECT_EQ(result.merges[0].scan, 0u);
  EXPECT_EQ(std::pair(result.links[0].a, result.links[0].b), std::pair(std::size_t{2}, std::size_t{0}));
  EXPECT_EQ(std::pair(result.hypotheses[0].a, result.hypotheses[0].b), std::pair(std::size_t{0}, std::size_t{1}));
  EXPECT_EQ(result.adjustment.outlying_pairs[0], std::pair(std::size_t{2}, std::size_t{1}));
  EXPECT_EQ(std::pair(result.pairs[0].source, result.pairs[0].target), std::pair(std::size_t{2}, std::size_t{0}));
}

TEST(RestoreOrder, ThereAndBackIsWhereItWas) {
  const Order order{3, 1, 0, 2};
  Order back(4);
  for (std::size_t k = 0; k < 4; ++k) back[order[k]] = k;
  PipelineResult result;
  result.reference = 2;
  result.graph.measure = Eigen::MatrixXd::Random(4, 4);
  result.graph.adjacency = {{1, 2}, {0}, {0, 3}, {2}};
  result.graph.component = {0, 0, 0, 0};
  for (const std::size_t i : {0u, 1u, 2u, 3u}) {
    result.scans.emplace_back().file = std::string(1, "abcd"[i]);
    result.merges.emplace_back().scan = i;
  }
  const PipelineResult before = result;
  restore_order(order, result);
  ASSERT_NE(result.scans[0].file, before.scans[0].file);
  ASSERT_NE(result.reference, before.reference);
  restore_order(back, result);
  EXPECT_EQ(result.reference, before.reference);
  EXPECT_TRUE(result.graph.measure == before.graph.measure);
  EXPECT_EQ(result.graph.adjacency, before.graph.adjacency);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(result.scans[i].file, before.scans[i].file);
    EXPECT_EQ(result.merges[i].scan, before.merges[i].scan);
  }
}

TEST(RestoreOrder, WhatAProfileDoesNotFillInStaysEmpty) {
  PipelineResult result;
  result.scans.resize(2);
  result.graph.measure = Eigen::MatrixXd::Zero(2, 2);
  result.graph.adjacency.resize(2);
  result.graph.component.resize(2);
  restore_order({1, 0}, result);
  EXPECT_TRUE(result.decisions.empty());
  EXPECT_TRUE(result.viewpoints.empty());
  EXPECT_TRUE(result.uncertainty.poses.empty());
}

}  // namespace
}  // namespace tcm_icp

#include "pipeline/scan_order.hpp"

#include <algorithm>
#include <numeric>

namespace tcm_icp {
namespace {

template <typename T>
void restore(const std::vector<std::size_t>& order, std::vector<T>& values) {
  if (values.empty()) return;  // not of this profile
  std::vector<T> out(values.size());
  for (std::size_t k = 0; k < order.size(); ++k) out[order[k]] = std::move(values[k]);
  values = std::move(out);
}

void renumber(const std::vector<std::size_t>& order, std::vector<std::size_t>& scans) {
  for (std::size_t& scan : scans) scan = order[scan];
}

void restore_graph(const std::vector<std::size_t>& order, CorrespondenceGraph& graph) {
  graph.reference = order[graph.reference];
  for (auto& scans : graph.adjacency) {
    renumber(order, scans);
    std::sort(scans.begin(), scans.end());
  }
  restore(order, graph.adjacency);
  restore(order, graph.component);
  const Eigen::MatrixXd measure = graph.measure;
  for (Eigen::Index a = 0; a < measure.rows(); ++a) {
    for (Eigen::Index b = 0; b < measure.cols(); ++b) {
      const auto row = static_cast<Eigen::Index>(order[static_cast<std::size_t>(a)]);
      graph.measure(row, static_cast<Eigen::Index>(order[static_cast<std::size_t>(b)])) = measure(a, b);
    }
  }
}

}  // namespace

std::vector<std::size_t> order_of_list(std::size_t num_scans) {
  std::vector<std::size_t> order(num_scans);
  std::iota(order.begin(), order.end(), std::size_t{0});
  return order;
}

std::vector<std::size_t> order_by_content(const std::vector<SampledScan>& scans) {
  std::vector<std::size_t> order = order_of_list(scans.size());
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const Scan &x = scans[a].scan, &y = scans[b].scan;
    if (x.num_raw_points != y.num_raw_points) return x.num_raw_points < y.num_raw_points;
    if (x.extent_m != y.extent_m) return x.extent_m < y.extent_m;
    if (x.spacing_m != y.spacing_m) return x.spacing_m < y.spacing_m;
    return x.file < y.file;
  });
  return order;
}

void restore_order(const std::vector<std::size_t>& order, PipelineResult& result) {
  result.reference = order[result.reference];
  restore(order, result.scans);
  restore(order, result.poses);
  restore(order, result.evidence);
  restore(order, result.free_space);
  restore(order, result.viewpoints);
  restore(order, result.measurements);
  restore(order, result.decisions);
  restore_graph(order, result.graph);
  restore(order, result.uncertainty.poses);
  for (MergeRecord& record : result.merges) record.scan = order[record.scan];
  const auto restore_pairs = [&order](auto& records) {
    for (auto& record : records) {
      record.a = order[record.a];
      record.b = order[record.b];
    }
  };
  restore_pairs(result.links);
  restore_pairs(result.hypotheses);
  for (auto& [a, b] : result.adjustment.outlying_pairs) {
    a = order[a];
    b = order[b];
  }
  for (PairFit& pair : result.pairs) {
    pair.source = order[pair.source];
    pair.target = order[pair.target];
  }
}

}  // namespace tcm_icp

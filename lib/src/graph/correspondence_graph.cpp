#include "tcm_icp/graph/correspondence_graph.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

using Adjacency = std::vector<std::vector<std::size_t>>;

void check(const Eigen::MatrixXd& measure) {
  if (measure.rows() == 0 || measure.rows() != measure.cols()) {
    throw InvalidInput("the correspondence matrix is " + std::to_string(measure.rows()) + " x " +
                       std::to_string(measure.cols()) + "; it must be square and not empty");
  }
  for (Eigen::Index i = 0; i < measure.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      // NaN fails the comparison too.
      if (!(measure(i, j) == measure(j, i))) {
        throw InvalidInput("the correspondence of scans " + std::to_string(j) + " and " + std::to_string(i) +
                           " is not a number, or not the same both ways");
      }
    }
  }
}

Adjacency connect(const Eigen::MatrixXd& measure, double threshold) {
  Adjacency adjacency(static_cast<std::size_t>(measure.rows()));
  for (Eigen::Index i = 0; i < measure.rows(); ++i) {
    for (Eigen::Index j = 0; j < measure.rows(); ++j) {
      if (i != j && measure(i, j) < threshold) {
        adjacency[static_cast<std::size_t>(i)].push_back(static_cast<std::size_t>(j));
      }
    }
  }
  return adjacency;
}

void number_components(CorrespondenceGraph& graph) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  graph.component.assign(graph.size(), kNone);
  for (std::size_t first = 0; first < graph.size(); ++first) {
    if (graph.component[first] != kNone) continue;
    std::vector<std::size_t> waiting{first};
    graph.component[first] = graph.num_components;
    while (!waiting.empty()) {
      const std::size_t scan = waiting.back();
      waiting.pop_back();
      for (const std::size_t next : graph.adjacency[scan]) {
        if (graph.component[next] != kNone) continue;
        graph.component[next] = graph.num_components;
        waiting.push_back(next);
      }
    }
    ++graph.num_components;
  }
}

}  // namespace

double correspondence_threshold(const Eigen::MatrixXd& measure) {
  check(measure);
  std::vector<double> values;
  for (Eigen::Index i = 0; i < measure.rows(); ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      if (std::isfinite(measure(i, j))) values.push_back(measure(i, j));
    }
  }
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  // Just above: connected means strictly below the threshold, and two scans have but one measure.
  return std::nextafter(*middle, std::numeric_limits<double>::infinity());
}

CorrespondenceGraph build_correspondence_graph(const Eigen::MatrixXd& measure, std::optional<double> threshold) {
  check(measure);
  if (threshold && std::isnan(*threshold)) throw InvalidInput("the correspondence threshold is not a number");
  CorrespondenceGraph graph;
  graph.measure = measure;
  graph.threshold_from_data = !threshold;
  graph.threshold = threshold ? *threshold : correspondence_threshold(measure);
  graph.adjacency = connect(measure, graph.threshold);
  number_components(graph);
  graph.reference = choose_reference(graph.adjacency);
  return graph;
}

std::size_t choose_reference(const Adjacency& adjacency) {
  if (adjacency.empty()) throw InvalidInput("there is no scan to choose a reference from");
  // Twice the distance from the middle (n - 1) / 2 of the list, to stay in whole numbers.
  const auto off_middle = [&](std::size_t i) {
    const std::size_t last = adjacency.size() - 1;
    return 2 * i > last ? 2 * i - last : last - 2 * i;
  };
  std::size_t best = 0;
  for (std::size_t i = 1; i < adjacency.size(); ++i) {
    const bool more = adjacency[i].size() > adjacency[best].size();
    const bool equal = adjacency[i].size() == adjacency[best].size();
    if (more || (equal && off_middle(i) < off_middle(best))) best = i;
  }
  return best;
}

}  // namespace tcm_icp

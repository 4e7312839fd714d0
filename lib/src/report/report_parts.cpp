#include "report_parts.hpp"

#include <cmath>

namespace tcm_icp {

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json vector(const Eigen::Vector3d& v) { return {number(v.x()), number(v.y()), number(v.z())}; }

std::string json_text(const Json& json) { return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n"; }

Json to_json(const Eigen::MatrixXd& matrix) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(number(matrix(i, j)));
    rows.push_back(row);
  }
  return rows;
}

const char* name_of(LpFormulation formulation) {
  switch (formulation) {
    case LpFormulation::kPointToPlane:
      return "plane";
    case LpFormulation::kPointToPoint:
      return "point";
    case LpFormulation::kEntries:
      return "entries";
    case LpFormulation::kLeastSquares:
      return "squares";
  }
  return "unknown";
}

const char* name_of(MergeOrder order) {
  switch (order) {
    case MergeOrder::kTcm:
      return "tcm";
    case MergeOrder::kPaperTcm:
      return "paper-tcm";
    case MergeOrder::kRobustTcm:
      return "robust-tcm";
    case MergeOrder::kOverlap:
      return "overlap";
    case MergeOrder::kFile:
      return "file";
    case MergeOrder::kRandom:
      return "random";
  }
  return "unknown";
}

const char* name_of(OutlierMethod method) {
  switch (method) {
    case OutlierMethod::kKMeans:
      return "kmeans";
    case OutlierMethod::kDistance:
      return "distance";
    case OutlierMethod::kLof:
      return "lof";
    case OutlierMethod::kNone:
      return "none";
  }
  return "unknown";
}

Json to_json(const ScanSummary& s) {
  const OutlierSummary& o = s.outliers.summary();
  return {{"file", s.file},
          {"unit", s.unit},
          {"points", s.num_points},
          {"dropped_points", s.num_dropped_points},
          {"working_points", s.num_working_points},
          {"working_voxel_m", s.voxel_size_m},
          {"spacing_m", s.spacing_m},
          {"noise_m", s.noise_m},
          {"extent_m", s.extent_m},
          {"outliers",
           {{"method", name_of(o.method)},
            {"clusters", o.num_clusters},
            {"struck_clusters", o.num_struck_clusters},
            {"radius_m", o.radius_m},
            {"threshold", o.threshold},
            {"working_points_removed", o.num_outliers}}}};
}

Json to_json(const CorrespondenceGraph& graph, std::size_t reference, const std::vector<ScanSummary>& scans) {
  Json edges = Json::array(), degrees = Json::array();
  for (std::size_t i = 0; i < graph.size(); ++i) {
    degrees.push_back(graph.degree(i));
    for (const std::size_t j : graph.adjacency[i]) {
      if (i < j) edges.push_back({scans[i].file, scans[j].file});
    }
  }
  return {{"reference", scans[reference].file},
          {"threshold", number(graph.threshold)},
          {"threshold_from_data", graph.threshold_from_data},
          {"measure", to_json(graph.measure)},
          {"degrees", degrees},
          {"edges", edges}};
}

}  // namespace tcm_icp

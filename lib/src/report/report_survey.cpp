#include "report_parts.hpp"

namespace tcm_icp {
namespace {

Json to_json(const PointResidual& p) {
  const bool is_known = p.status != PointStatus::kNotRegistered;
  return {{"name", p.point.name},
          {"scan", p.point.scan.empty() ? "*" : p.point.scan},
          {"kind", p.point.is_scanner ? "scanner" : "target"},
          {"status", to_string(p.status)},
          {"given_m", vector(p.point.given)},
          {"residual_m", is_known ? vector(p.residual_m) : Json(nullptr)},
          {"sigma_m", is_known ? vector(p.sigma_m) : Json(nullptr)},
          {"redundancy", p.redundancy},
          {"test", number(p.test)}};
}

}  // namespace

Json survey_json(const SurveyRecord& survey) {
  if (!survey.has_frame && survey.points.empty() && survey.remarks.empty()) return nullptr;
  Json points = Json::array();
  for (const auto& point : survey.points) points.push_back(to_json(point));
  return {{"has_frame", survey.has_frame},
          {"defined_by", survey.defined_by},
          {"crs", survey.crs.empty() ? Json(nullptr) : Json(survey.crs)},
          {"rotations_determined", survey.num_rotations},
          {"degrees_of_freedom", survey.degrees_of_freedom},
          {"variance_factor", number(survey.variance_factor)},
          {"largest_change_m", survey.largest_change_m},
          {"remarks", survey.remarks},
          {"points", points}};
}

}  // namespace tcm_icp

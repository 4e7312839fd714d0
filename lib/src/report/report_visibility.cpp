#include "report_parts.hpp"

namespace tcm_icp {

Json to_json(const FreeSpaceEvidence& e) {
  if (e.num_points == 0 && e.num_matches == 0) return nullptr;
  return {{"points", e.num_points},
          {"violations", e.violation_share()},
          {"matches", e.num_matches},
          {"opposed", e.opposed_share()},
          {"veto", e.vetoes()}};
}

Json to_json(const Viewpoint& v) {
  const bool by_lines = v.evidence == ViewpointEvidence::kScanLines;
  return {{"determined", v.determined()},
          {"evidence", by_lines ? "scan lines" : "occlusion"},
          {"line_share", by_lines ? Json(v.line_share) : Json()},
          {"place", {number(v.place.x()), number(v.place.y()), number(v.place.z())}},
          {"hidden_share", by_lines ? Json() : Json(v.hidden_share)},
          {"radius_m", number(v.radius_m)}};
}

}  // namespace tcm_icp

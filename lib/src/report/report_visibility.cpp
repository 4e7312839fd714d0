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
  const char* evidence = by_lines ? "scan lines" : v.evidence == ViewpointEvidence::kDensity ? "density" : "occlusion";
  Json json{{"determined", v.determined()},
            {"place", {number(v.place.x()), number(v.place.y()), number(v.place.z())}},
            {"radius_m", number(v.radius_m)},
            {"evidence", evidence}};
  json[by_lines ? "line_share" : "hidden_share"] = by_lines ? v.line_share : v.hidden_share;
  return json;
}

}  // namespace tcm_icp

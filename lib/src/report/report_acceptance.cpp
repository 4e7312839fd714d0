// The user's limits, held against each scan and link.

#include <cmath>
#include <cstdio>

#include "report/residual_statistics.hpp"
#include "report_parts.hpp"

namespace tcm_icp {
namespace {

std::string millimetres(double length_m) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g mm", 1000 * length_m);
  return text;
}

std::string percent_text(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.0f %%", 100 * share);
  return text;
}

// Names of what fails, for a person.
class Failures {
 public:
  void most(const char* what, double value, double limit, const std::string& shown, const std::string& bound) {
    if (limit > 0 && !(value <= limit)) list_.push_back(std::string(what) + " " + shown + ", above " + bound);
  }
  void least(const char* what, double value, double limit) {
    if (limit > 0 && !(value >= limit)) {
      list_.push_back(std::string(what) + " " + percent_text(value) + ", below " + percent_text(limit));
    }
  }
  void add(const std::string& text) { list_.push_back(text); }
  Json json() const { return {{"passed", list_.empty()}, {"failures", list_}}; }

 private:
  Json list_ = Json::array();
};

void check_residual(const Json& residuals, double limit_m, bool needed, Failures& failures) {
  if (residuals.is_null()) {
    if (needed && limit_m > 0) failures.add("no points to measure residuals with");
    return;
  }
  const double rms_m = residuals.at("rms_m").get<double>();
  failures.most("RMS residual", rms_m, limit_m, millimetres(rms_m), millimetres(limit_m));
}

Json scan_acceptance(const Json& scan, const AcceptanceLimits& limits, bool is_reference_frame) {
  Failures failures;
  if (scan.at("status") == "unregistered") {
    failures.add("not registered");
    return failures.json();
  }
  check_residual(scan.at("residuals"), limits.residual_m, true, failures);
  const bool is_reference = scan.at("status") == "reference";
  if (!scan.at("evidence").is_null()) {
    failures.least("overlap", scan.at("evidence").at("overlap").get<double>(), limits.overlap);
  }
  if (limits.sigma_m > 0 && !(is_reference && is_reference_frame)) {
    if (!scan.contains("uncertainty") || scan.at("uncertainty").is_null()) {
      failures.add("standard deviation of its position is not determined");
    } else {
      double square = 0;
      for (const auto& s : scan.at("uncertainty").at("sigma_position_m")) {
        square += s.is_number() ? s.get<double>() * s.get<double>() : HUGE_VAL;
      }
      const double sigma_m = std::sqrt(square);
      failures.most("standard deviation of its position", sigma_m, limits.sigma_m, millimetres(sigma_m),
                    millimetres(limits.sigma_m));
    }
  }
  return failures.json();
}

}  // namespace

void add_residuals(const PipelineResult& result, double limit_m, Json& report) {
  const ResidualsOfRun residuals = residuals_of(result, limit_m);
  for (std::size_t i = 0; i < residuals.scans.size(); ++i)
    report["scans"][i]["residuals"] = to_json(residuals.scans[i]);
  for (std::size_t k = 0; k < residuals.links.size(); ++k)
    report["links"][k]["residuals"] = to_json(residuals.links[k]);
  report["residuals"] = to_json(residuals.all);
}

void add_acceptance(const AcceptanceLimits& limits, bool is_reference_frame, Json& report) {
  if (!limits.any()) return;
  std::size_t failed_scans = 0, failed_links = 0;
  for (auto& scan : report["scans"]) {
    scan["acceptance"] = scan_acceptance(scan, limits, is_reference_frame);
    failed_scans += scan["acceptance"]["passed"] == true ? 0 : 1;
  }
  for (auto& link : report["links"]) {
    Failures failures;
    check_residual(link.at("residuals"), limits.residual_m, false, failures);
    failures.least("overlap", link.at("evidence").at("overlap").get<double>(), limits.overlap);
    link["acceptance"] = failures.json();
    failed_links += link["acceptance"]["passed"] == true ? 0 : 1;
  }
  const auto limit = [](double value) { return value > 0 ? Json(value) : Json(nullptr); };
  report["acceptance"] = {{"residual_m", limit(limits.residual_m)}, {"overlap", limit(limits.overlap)},
                          {"sigma_m", limit(limits.sigma_m)},       {"passed", failed_scans == 0},
                          {"failed_scans", failed_scans},           {"failed_links", failed_links}};
}

}  // namespace tcm_icp

#include "survey_setup.hpp"

#include <algorithm>
#include <boost/algorithm/string/trim.hpp>
#include <cctype>
#include <charconv>
#include <fstream>
#include <iterator>
#include <numbers>

#include "run_setup.hpp"
#include "tcm_icp/core/error.hpp"
#include "tcm_icp/io/pose_io.hpp"
#include "tcm_icp/io/scan_path.hpp"
#include "tcm_icp/survey/control_file.hpp"
#include "values_by_scan.hpp"

namespace tcm_icp::app {
namespace {

constexpr const char* kWithoutFrame = ": without --control, --gnss or --fix results are in the frame of a scan";

bool has_frame(const SurveyOptions& s) { return !s.control.empty() || !s.positions.empty() || !s.fixed.empty(); }

void check(const RegisterOptions& o) {
  const SurveyOptions& s = o.survey;
  if (has_frame(s) && o.method != Method::kTcm) {
    throw InvalidOptions("--control, --gnss and --fix belong to --method tcm; leave --method out");
  }
  if (!s.fixed.empty() && o.initial_poses.empty()) {
    throw InvalidOptions("--fix " + s.fixed.front() +
                         ": keeps a scan where --init puts it; give --init POSES.json, too");
  }
  if (!s.crs.empty() && !has_frame(s)) throw InvalidOptions("--crs" + std::string(kWithoutFrame));
}

bool is_epsg(const std::string& text) {
  const std::string start = "EPSG:";
  return text.starts_with(start) && text.size() > start.size() &&
         std::all_of(text.begin() + static_cast<std::ptrdiff_t>(start.size()), text.end(),
                     [](unsigned char c) { return std::isdigit(c) != 0; });
}

bool is_well_known_text(const std::string& text) {
  const auto bracket = text.find('[');
  return bracket != std::string::npos && bracket > 0 && text.ends_with(']') &&
         std::all_of(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(bracket),
                     [](unsigned char c) { return std::isupper(c) != 0 || std::isdigit(c) != 0 || c == '_'; });
}

std::string read_crs(const std::string& option) {
  std::string text = boost::algorithm::trim_copy(option);
  if (is_epsg(text) || is_well_known_text(text)) return text;
  std::ifstream in(option, std::ios::binary);
  if (in && !std::filesystem::is_directory(option)) {
    text.assign(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    boost::algorithm::trim(text);
    if (is_epsg(text) || is_well_known_text(text)) return text;
    throw InputError(option, "", "holds no coordinate system", "it must be EPSG:n or well-known text (.wkt, .prj)");
  }
  throw InvalidOptions("--crs '" + option + "': give EPSG:n, well-known text, or a file that holds it (.wkt, .prj)");
}

/// Initial poses with standard deviations are observations; others are where searches may start.
void add_priors(const RegisterOptions& o, const std::vector<std::string>& names, Survey& survey) {
  if (o.initial_poses.empty() || o.initial_poses == kFromHeaders) return;
  if (o.method != Method::kTcm || o.pipeline.profile != Profile::kRobust) return;
  const auto sigmas = read_initial_sigmas(o.initial_poses, names);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (sigmas[i]) survey.priors.push_back({names[i], sigmas[i]->position_m, sigmas[i]->rotation_rad});
  }
}

double parse_level_sigma(const std::string& option, const std::string& text) {
  double degrees = 0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), degrees);
  if (error == std::errc() && rest == text.data() + text.size() && degrees >= 0 && degrees < 45) return degrees;
  throw InvalidOptions("--level-sigma " + option + ": give degrees, at least 0 and below 45, or SCAN=DEGREES");
}

void add_levels(const SurveyOptions& options, const std::vector<std::filesystem::path>& scans,
                const std::vector<std::string>& names, Survey& survey) {
  const auto sigmas_deg = values_by_scan<double>(options.level_sigmas_deg, "--level-sigma", scans, parse_level_sigma);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    if (sigmas_deg[i].value_or(0) > 0) survey.levels.push_back({names[i], *sigmas_deg[i] * std::numbers::pi / 180});
  }
  if (survey.levels.empty() || has_frame(options)) return;
  throw InvalidOptions("--level-sigma" + std::string(kWithoutFrame));
}

}  // namespace

Survey read_survey(const RegisterOptions& options, const std::vector<std::filesystem::path>& scans) {
  check(options);
  const SurveyOptions& s = options.survey;
  Survey survey;
  if (!s.control.empty()) survey.points = read_control_file(s.control, scans);
  if (!s.positions.empty()) {
    const auto positions = read_scanner_positions(s.positions, scans);
    survey.points.insert(survey.points.end(), positions.begin(), positions.end());
  }
  const std::vector<std::string> names = scan_names(scans);
  for (const auto& fixed : s.fixed) {
    for (const std::size_t i : scans_called(fixed, scans, "--fix " + fixed)) {
      if (std::find(survey.fixed.begin(), survey.fixed.end(), names[i]) == survey.fixed.end()) {
        survey.fixed.push_back(names[i]);
      }
    }
  }
  add_priors(options, names, survey);
  add_levels(s, scans, names, survey);
  if (!s.crs.empty()) survey.crs = read_crs(s.crs);
  return survey;
}

void settle_coordinate_system(const RegisterOptions& options, const std::vector<std::filesystem::path>& scans,
                              const RunContext& context, Survey& survey) {
  const std::string of_scans = report_coordinate_systems(
      scans, survey.empty() ? "which results do not keep" : "which results keep unless --crs names another", context);
  if (!survey.empty() && options.survey.crs.empty()) survey.crs = of_scans;
}

}  // namespace tcm_icp::app

#include "survey_table.hpp"

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

#include "figure.hpp"
#include "text_width.hpp"

namespace tcm_icp::app {
namespace {

constexpr std::size_t kFigureWidth = 8, kStatusWidth = 14;

std::string scan_of(const PointResidual& p) { return p.point.scan.empty() ? "*" : p.point.scan; }

}  // namespace

void print_survey_table(const SurveyRecord& survey, std::size_t width, std::ostream& out) {
  if (survey.points.empty()) return;
  constexpr std::size_t kFigures = 2 + 5 * (2 + kFigureWidth) + kStatusWidth, kNarrowest = 9;
  std::size_t names = 5, scans = 4;
  for (const auto& p : survey.points) {
    names = std::max(names, num_characters(p.point.name));
    scans = std::max(scans, num_characters(scan_of(p)));
  }
  const std::size_t room = width > kFigures + 2 ? (width - kFigures - 2) / 2 : 0;
  names = std::min(names, std::max(kNarrowest, room));
  scans = std::min(scans, std::max(kNarrowest, room));
  std::string head = left("point", names) + "  " + left("scan", scans) + "  " + left("status", kStatusWidth);
  std::string units(num_characters(head), ' ');
  for (const char* const name : {"dX", "dY", "dZ", "sigma", "test"}) head += "  " + right(name, kFigureWidth);
  for (int k = 0; k < 4; ++k) units += "  " + right("[mm]", kFigureWidth);
  out << head << '\n' << units << '\n';
  for (const auto& p : survey.points) {
    out << left(shortened(p.point.name, names), names) << "  " << left(shortened(scan_of(p), scans), scans) << "  "
        << left(to_string(p.status), kStatusWidth);
    for (int axis = 0; axis < 3; ++axis) out << "  " << right(figure("%.1f", 1000 * p.residual_m[axis]), kFigureWidth);
    out << "  " << right(figure("%.1f", 1000 * p.sigma_m.norm() / std::sqrt(3.0)), kFigureWidth) << "  "
        << right(figure("%.1f", p.test), kFigureWidth) << '\n';
  }
}

}  // namespace tcm_icp::app

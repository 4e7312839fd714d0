#include "register_choices.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "suggestion.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp::app {
namespace {

// Enumerations stand on the command line by name.
template <typename Enum, std::size_t N>
struct Names {
  const char* option;
  std::array<std::pair<const char*, Enum>, N> entries;

  Enum parse(const std::string& text) const {
    std::string all;
    std::vector<std::string> known;
    for (const auto& [name, value] : entries) {
      if (text == name) return value;
      all += (all.empty() ? "" : ", ") + std::string(name);
      known.emplace_back(name);
    }
    throw InvalidOptions(std::string("--") + option + " '" + text + "': choose one of " + all +
                         did_you_mean(text, known));
  }
  const char* name(Enum wanted) const {
    for (const auto& [name, value] : entries) {
      if (value == wanted) return name;
    }
    return "";
  }
};

constexpr Names<Method, 3> kMethods{"method",
                                    {{{"tcm", Method::kTcm}, {"icp", Method::kIcp}, {"features", Method::kFeatures}}}};
constexpr Names<Profile, 2> kProfiles{"profile", {{{"robust", Profile::kRobust}, {"paper", Profile::kPaper}}}};
constexpr Names<LpSolver, 2> kSolvers{"solver", {{{"glpk", LpSolver::kGlpk}, {"cgal", LpSolver::kCgal}}}};
constexpr Names<LpFormulation, 4> kFormulations{"lp.formulation",
                                                {{{"plane", LpFormulation::kPointToPlane},
                                                  {"point", LpFormulation::kPointToPoint},
                                                  {"entries", LpFormulation::kEntries},
                                                  {"squares", LpFormulation::kLeastSquares}}}};
constexpr Names<MergeOrder, 6> kMergeOrders{"merge-order",
                                            {{{"tcm", MergeOrder::kTcm},
                                              {"paper-tcm", MergeOrder::kPaperTcm},
                                              {"robust-tcm", MergeOrder::kRobustTcm},
                                              {"overlap", MergeOrder::kOverlap},
                                              {"file", MergeOrder::kFile},
                                              {"random", MergeOrder::kRandom}}}};
constexpr Names<LeftOut, 7> kLeftOut{"without",
                                     {{{"nothing", LeftOut::kNothing},
                                       {"features", LeftOut::kFeatures},
                                       {"slides", LeftOut::kSlides},
                                       {"implied", LeftOut::kImpliedPoses},
                                       {"free-space", LeftOut::kFreeSpace},
                                       {"twins", LeftOut::kTwins},
                                       {"constant", LeftOut::kSetConstant}}}};
constexpr Names<OutlierMethod, 4> kOutlierMethods{"outliers",
                                                  {{{"kmeans", OutlierMethod::kKMeans},
                                                    {"distance", OutlierMethod::kDistance},
                                                    {"lof", OutlierMethod::kLof},
                                                    {"none", OutlierMethod::kNone}}}};
constexpr Names<Refinement, 5> kRefinements{"refinement",
                                            {{{"auto", Refinement::kAuto},
                                              {"none", Refinement::kNone},
                                              {"descent", Refinement::kDescent},
                                              {"annealing", Refinement::kAnnealing},
                                              {"both", Refinement::kDescentThenAnnealing}}}};

constexpr Names<PaperMatches, 3> kPaperMatches{"paper.matches",
                                               {{{"nearest", PaperMatches::kNearest},
                                                 {"threshold", PaperMatches::kThreshold},
                                                 {"mutual", PaperMatches::kMutual}}}};
constexpr Names<PaperSlack, 4> kPaperSlacks{"paper.slack",
                                            {{{"both", PaperSlack::kBoth},
                                              {"above", PaperSlack::kAbove},
                                              {"below", PaperSlack::kBelow},
                                              {"between", PaperSlack::kBetween}}}};
constexpr Names<PaperEnd, 2> kPaperEnds{"paper.end", {{{"motion", PaperEnd::kMotion}, {"slack", PaperEnd::kSlack}}}};
constexpr Names<PaperPoints, 2> kPaperPoints{"paper.points",
                                             {{{"sample", PaperPoints::kSample}, {"all", PaperPoints::kAll}}}};
constexpr Names<PaperUnknowns, 2> kPaperUnknowns{
    "paper.unknowns", {{{"entries", PaperUnknowns::kEntries}, {"twist", PaperUnknowns::kTwist}}}};
constexpr Names<PaperDescent, 2> kPaperDescents{
    "paper.descent", {{{"scans", PaperDescent::kWholeScans}, {"matches", PaperDescent::kMatches}}}};

constexpr Names<CloudFormat, 6> kFormats{"format",
                                         {{{"ply", CloudFormat::kPly},
                                           {"las", CloudFormat::kLas},
                                           {"pcd", CloudFormat::kPcd},
                                           {"text", CloudFormat::kText},
                                           {"e57", CloudFormat::kE57},
                                           {"ptx", CloudFormat::kPtx}}}};
constexpr Names<CloudColour, 2> kColours{"colour", {{{"keep", CloudColour::kKeep}, {"scan", CloudColour::kScan}}}};

std::string shortest_digits(double value) {
  std::array<char, 32> text;
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

/// "5cm" is a likely mistake, so the error tells the unit.
double parse_voxel(const std::string& text) {
  double length = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), length);
  if (error == std::errc() && end == text.data() + text.size() && std::isfinite(length) && length >= 0) return length;
  throw InvalidOptions("--voxel '" + text +
                       "': give a length of at least 0 as a bare number, in the unit of the scans (0.05 for 5 cm where "
                       "that is the metre; 0: all points)");
}

/// "6mm", "0.6 cm", "0.006": a bare number is metres, as results are.
double parse_length(const std::string& option, const std::string& text) {
  constexpr std::array<std::pair<std::string_view, double>, 6> kUnits{
      {{"", 1}, {"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"um", 1e-6}, {"ft", 0.3048}}};
  double length = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), length);
  std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  unit.remove_prefix(std::min(unit.find_first_not_of(' '), unit.size()));
  for (const auto& [name, metres] : kUnits) {
    if (error == std::errc() && unit == name && std::isfinite(length) && length >= 0) return length * metres;
  }
  throw InvalidOptions("--" + option + " '" + text +
                       "': give a length of at least 0 with its unit: 6mm, 0.6cm, 0.006m (m where there is none; 0: no "
                       "limit)");
}

/// "30%" or "0.3".
double parse_share(const std::string& option, const std::string& text) {
  double share = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), share);
  const std::string_view rest(end, static_cast<std::size_t>(text.data() + text.size() - end));
  if (rest == "%" || rest == " %") share /= 100;
  const bool is_known = rest.empty() || rest == "%" || rest == " %";
  if (error == std::errc() && is_known && share >= 0 && share <= 1) return share;
  throw InvalidOptions("--" + option + " '" + text + "': give a share of 0% to 100%: 30% or 0.3 (0: no limit)");
}

}  // namespace

Choices::Choices(const PipelineOptions& p)
    : profile(kProfiles.name(p.profile)),
      solver(kSolvers.name(p.lp.lp.solver)),
      outliers(kOutlierMethods.name(p.outliers.method)),
      refinement(kRefinements.name(p.refinement.method)),
      formulation(kFormulations.name(p.formulation)),
      merge_order(kMergeOrders.name(p.merge_order)),
      without(kLeftOut.name(p.without)),
      paper_matches(kPaperMatches.name(p.paper.matches)),
      paper_slack(kPaperSlacks.name(p.paper.slack)),
      paper_end(kPaperEnds.name(p.paper.end)),
      paper_points(kPaperPoints.name(p.paper.points)),
      paper_unknowns(kPaperUnknowns.name(p.paper.unknowns)),
      paper_descent(kPaperDescents.name(p.paper.descent)) {}

Choices::Choices(const RegisterOptions& o) : Choices(o.pipeline) {
  method = kMethods.name(o.method);
  format = kFormats.name(o.clouds.format);
  colour = kColours.name(o.clouds.colour);
  voxel = shortest_digits(o.clouds.voxel_m);
  accept_residual = shortest_digits(o.report.accept.residual_m);
  accept_overlap = shortest_digits(o.report.accept.overlap);
  accept_sigma = shortest_digits(o.report.accept.sigma_m);
}

void Choices::apply(PipelineOptions& p) const {
  p.profile = kProfiles.parse(profile);
  p.lp.lp.solver = kSolvers.parse(solver);
  p.outliers.method = kOutlierMethods.parse(outliers);
  p.refinement.method = kRefinements.parse(refinement);
  p.formulation = kFormulations.parse(formulation);
  p.merge_order = kMergeOrders.parse(merge_order);
  p.without = kLeftOut.parse(without);
  p.paper.matches = kPaperMatches.parse(paper_matches);
  p.paper.slack = kPaperSlacks.parse(paper_slack);
  p.paper.end = kPaperEnds.parse(paper_end);
  p.paper.points = kPaperPoints.parse(paper_points);
  p.paper.unknowns = kPaperUnknowns.parse(paper_unknowns);
  p.paper.descent = kPaperDescents.parse(paper_descent);
}

void Choices::apply_beside_pipeline(RegisterOptions& o) const {
  o.method = kMethods.parse(method);
  o.clouds.format = kFormats.parse(format);
  o.clouds.colour = kColours.parse(colour);
  o.clouds.voxel_m = parse_voxel(voxel);
  o.clouds.validate();
  o.report.accept = {parse_length("accept-residual", accept_residual), parse_share("accept-overlap", accept_overlap),
                     parse_length("accept-sigma", accept_sigma)};
}

void Choices::use_conventional_defaults(bool asks_for_outliers) {
  if (profile != kProfiles.name(Profile::kRobust)) {
    throw InvalidOptions("--profile " + profile + " belongs to --method tcm; leave one of the two out");
  }
  if (!asks_for_outliers) outliers = kOutlierMethods.name(OutlierMethod::kNone);
}

}  // namespace tcm_icp::app

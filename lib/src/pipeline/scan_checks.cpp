#include "pipeline/scan_checks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/figure_text.hpp"
#include "tcm_icp/core/error.hpp"

namespace tcm_icp {
namespace {

struct UnitPair {
  double ratio;  ///< of lengths of the scan to lengths of the others, were they the same in truth
  const char* mine;
  const char* theirs;
};

constexpr double kMmPerM = 1000, kMPerFt = 0.3048;  // both by definition; the US survey foot differs by 2e-6
constexpr std::array kUnitPairs{UnitPair{kMmPerM, "mm", "m"},
                                UnitPair{1 / kMmPerM, "m", "mm"},
                                UnitPair{1 / kMPerFt, "ft", "m"},
                                UnitPair{kMPerFt, "m", "ft"},
                                UnitPair{kMmPerM * kMPerFt, "mm", "ft"},
                                UnitPair{1 / (kMmPerM * kMPerFt), "ft", "mm"}};

constexpr std::size_t kNumFigures = 3;
using Figures = std::array<double, kNumFigures>;  // logarithms of extent, spacing, noise; -inf where there is none

// Least spread taken for granted of each: the largest root mean square, over nine simulated sets of six scans (each
// scene of `tcm-icp simulate --scans 6 --seed 3`, and datasets/town), of the log ratio of a scan to the median of the
// others. A set that spreads more has its own.
constexpr Figures kLeastSpread{0.173, 0.199, 0.862};

// 99.9 % quantile of chi squared with as many degrees of freedom as figures: one ordinary scan in a thousand is beyond.
constexpr std::array<double, kNumFigures + 1> kFarthest{0, 10.83, 13.82, 16.27};

Figures figures_of(const ScanSummary& s) { return {std::log(s.extent_m), std::log(s.spacing_m), std::log(s.noise_m)}; }

// What is left when thousands are taken out: the spread of a set must not come from other scans in millimetres.
double without_thousands(double log_ratio) {
  const double thousand = std::log(kMmPerM);
  return log_ratio - thousand * std::round(log_ratio / thousand);
}

struct Comparison {
  double log_ratio = 0;  ///< of the scan's figure to the median of the others
  double spread = 0;     ///< of the others' figures
};

// The lower of two in the middle, not their mean: half of the others in millimetres must not make up a unit between.
double lower_median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// One for each figure that all scans have.
std::vector<Comparison> compare(const std::vector<Figures>& figures, std::size_t scan) {
  std::vector<Comparison> out;
  for (std::size_t k = 0; k < kNumFigures; ++k) {
    if (std::any_of(figures.begin(), figures.end(), [k](const Figures& f) { return !std::isfinite(f[k]); })) continue;
    std::vector<double> others;
    for (std::size_t j = 0; j < figures.size(); ++j) {
      if (j != scan) others.push_back(figures[j][k]);
    }
    const double middle = lower_median(others);
    double squares = 0;
    for (const double value : others) squares += std::pow(without_thousands(value - middle), 2);
    const double own = std::sqrt(squares / static_cast<double>(others.size()));
    out.push_back({figures[scan][k] - middle, std::max(own, kLeastSpread[k])});
  }
  return out;
}

// How far the figures are from `log_ratio`, squared and summed.
double distance(const std::vector<Comparison>& figures, double log_ratio) {
  double sum = 0;
  for (const Comparison& c : figures) sum += std::pow((c.log_ratio - log_ratio) / c.spread, 2);
  return sum;
}

std::optional<UnitPair> likely_units(const std::vector<Comparison>& figures) {
  const double farthest = kFarthest[figures.size()];
  if (figures.empty() || distance(figures, 0) <= farthest) return std::nullopt;
  std::optional<UnitPair> best;
  for (const UnitPair& units : kUnitPairs) {
    const double shift = std::log(units.ratio);
    // Rooms of other sizes change extent and spacing alike, but not the noise of the instrument.
    const bool all_nearer = std::all_of(figures.begin(), figures.end(), [shift](const Comparison& c) {
      return std::abs(c.log_ratio - shift) < std::abs(c.log_ratio);
    });
    if (!all_nearer || distance(figures, shift) > farthest) continue;
    if (!best || distance(figures, shift) < distance(figures, std::log(best->ratio))) best = units;
  }
  return best;
}

std::string doubt(const std::string& file, const UnitPair& units, bool has_noise) {
  const std::string mine = units.mine, theirs = units.theirs;
  const std::string others = theirs == "m" ? "" : "--unit " + theirs + " ";
  return file + ": " + (has_noise ? "extent, point spacing and noise" : "extent and point spacing") + " are about " +
         figure(units.ratio, 4) + " times those of the other scans, as if it were in " + mine + " and they in " +
         theirs + "; if that is so, say " + others + "--unit " + file + "=" + mine;
}

}  // namespace

std::vector<std::string> unit_doubts(const std::vector<ScanSummary>& scans) {
  std::vector<std::string> doubts;
  if (scans.size() < 2) return doubts;
  std::vector<Figures> figures;
  for (const auto& s : scans) figures.push_back(figures_of(s));
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const auto compared = compare(figures, i);
    const auto units = likely_units(compared);
    if (!units || (scans.size() == 2 && units->ratio < 1)) continue;
    doubts.push_back(doubt(scans[i].file, *units, compared.size() == kNumFigures));
  }
  return doubts;
}

std::vector<std::string> warn_of_units(const std::vector<ScanSummary>& scans, const RunContext& context) {
  std::vector<std::string> doubts = unit_doubts(scans);
  for (const auto& doubt : doubts) context.warn(doubt);
  return doubts;
}

std::vector<std::pair<std::string, std::string>> find_twins(const std::vector<SampledScan>& scans) {
  std::vector<std::pair<std::string, std::string>> twins;
  for (std::size_t i = 1; i < scans.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const Scan &a = scans[i].scan, &b = scans[j].scan;
      const bool same =
          a.num_raw_points == b.num_raw_points && a.origin == b.origin && a.cloud.points == b.cloud.points;
      if (!same) continue;
      twins.emplace_back(a.file, b.file);
      break;
    }
  }
  return twins;
}

void refuse_twins(const std::vector<SampledScan>& scans) {
  for (const auto& [copy, original] : find_twins(scans)) {
    throw InvalidInput(copy + " has the same points as " + original +
                       ": a copy would bear its original out; leave one of the two out");
  }
}

}  // namespace tcm_icp

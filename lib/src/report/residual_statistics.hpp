#pragma once
// Figures of distances between a scan's points and other scans' surfaces.

#include <optional>
#include <vector>

#include "report/report_parts.hpp"
#include "tcm_icp/pipeline/report_options.hpp"

namespace tcm_icp {

/// Histogram of signed distances over [-width_m * counts / 2, ...]; those beyond are in the outermost classes.
struct ResidualStatistics {
  std::size_t num = 0;
  double median_m = 0, p95_m = 0;        ///< of the absolute values
  double rms_all_m = 0;                  ///< leaves, passers-by and edges count as much as walls
  double rms_m = 0;                      ///< of those within three robust standard deviations (4.45 medians)
  double mean_m = 0;                     ///< with signs: of a link it should be about 0
  std::optional<double> share_accepted;  ///< within the limit asked for
  double class_m = 0;                    ///< width of a class of the histogram
  std::vector<std::size_t> counts;
};

/// Nothing of no distances. @param limit_m  0: none. @param most_m  where the histogram ends, either way
std::optional<ResidualStatistics> residual_statistics(std::vector<float> distances_m, double limit_m, double most_m);

Json to_json(const std::optional<ResidualStatistics>& statistics);

/// Of each link, and of each scan with all links of it that were not rejected.
struct ResidualsOfRun {
  std::vector<std::optional<ResidualStatistics>> links, scans;
  std::optional<ResidualStatistics> all;
};
ResidualsOfRun residuals_of(const PipelineResult& result, double limit_m);

}  // namespace tcm_icp

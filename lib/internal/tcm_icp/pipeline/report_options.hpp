#pragma once
// What a report says beside what the run found: whose it is, and what the user asks of the result.

#include <cstddef>
#include <string>

namespace tcm_icp {

/// 0: nothing is asked.
struct AcceptanceLimits {
  double residual_m = 0;  ///< [m] >= 0; RMS distance of points from the other scan's surface, of a link and of a scan
  double overlap = 0;     ///< 0..1; of a scan with all others together
  double sigma_m = 0;     ///< [m] >= 0; standard deviation of a scan's position

  bool any() const { return residual_m > 0 || overlap > 0 || sigma_m > 0; }
  void validate() const;  ///< throws InvalidOptions naming field, value and bound
};

struct ReportOptions {
  AcceptanceLimits accept;
  std::string project, client, instrument, surveyor;  ///< empty: not told
  std::size_t view_points = 250'000;  ///< of the 3D view and the pictures, over all scans; 0: neither is made
};

}  // namespace tcm_icp

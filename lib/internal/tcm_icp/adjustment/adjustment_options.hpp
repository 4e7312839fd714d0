#pragma once
// The joint adjustment of all poses.

namespace tcm_icp {

struct AdjustmentOptions {
  int lp_steps = 2;       ///< >= 0; linear programs over all poses at once, at the fine resolution
  int steps = 10;         ///< >= 0; most Gauss-Newton steps over all poses at once, after the programs
  bool bending = true;    ///< how scanners that spun and moved bend their scans is solved for in these steps
  void validate() const;  ///< throws InvalidOptions
};

}  // namespace tcm_icp

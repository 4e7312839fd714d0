#pragma once
// What the joint adjustment did.

#include <cstddef>
#include <utility>
#include <vector>

#include "tcm_icp/registration/linear_program.hpp"
#include "tcm_icp/registration/registration_result.hpp"

namespace tcm_icp {

/// The last joint adjustment of a run.
struct AdjustmentRecord {
  LpFigures lp;                            ///< of the joint linear programs
  LpStatus lp_status = LpStatus::kNotRun;  ///< of the last
  std::size_t num_lp_matches = 0;          ///< of the last
  double lp_rms_move_m = 0;                ///< [m] of the scans, in the last that was solved
  int num_steps = 0;                       ///< of the least squares that follow
  double rms_move_m = 0;                   ///< [m] of the scans, in the last of them
  double bending_m = 0;  ///< [m] RMS offset of points that scanners' motion during a turn was found to cause
  double motion_m = 0;   ///< [m] RMS motion of the scanners during a turn, as far as it was found
  std::vector<std::pair<std::size_t, std::size_t>>
      outlying_pairs;  ///< fit far worse than the others, see outlying_links
};

}  // namespace tcm_icp

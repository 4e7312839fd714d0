#pragma once
// The truth about a set of scans, as truth.json has it.

#include <Eigen/Geometry>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace tcm_icp {

struct TrueScan {
  std::string file;
  Eigen::Isometry3d T_world_scan = Eigen::Isometry3d::Identity();
  int group = 0;  ///< scans of different groups share nothing and cannot be registered to each other
};

/// A pose is right where both hold.
struct Tolerance {
  double rotation_deg = 1.0;
  double rmse_m = 0.2;
};

struct Truth {
  std::vector<TrueScan> scans;
  Tolerance tolerance;
  /// (i, j): share of the points of scan i that have a point of scan j nearby; empty where the file does not say.
  Eigen::MatrixXd overlap;

  /// Whether a pair counts: the same group, and the larger of its two overlaps is at least `min_overlap` (always where
  /// overlaps are not known).
  bool pair_counts(std::size_t i, std::size_t j, double min_overlap) const;
};

/// {"scans": [{"file", "pose", "group"?}], "tolerance"?: {"rotation_deg"?, "rmse_m"?}, "overlap"?: NxN}; what else it
/// holds is passed over.
/// @throws InputError  if it cannot be read, a pose is not a finite rigid 4x4 (within 1e-3), a file is named twice, or
/// the
///                     overlap matrix has another size
Truth read_truth(const std::filesystem::path& path);

}  // namespace tcm_icp

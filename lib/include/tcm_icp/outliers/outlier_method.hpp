#pragma once
// How outliers of a scan are found.

namespace tcm_icp {

/// What counts as an outlier; docs/decisions/0005-outlier-threshold.md compares them.
enum class OutlierMethod {
  kKMeans,    ///< the paper's: far from every k-means centroid
  kDistance,  ///< far from its nearest neighbours (CGAL::remove_outliers)
  kLof,       ///< much sparser than its neighbours' neighbourhoods (local outlier factor)
  kNone,      ///< no point is removed
};

}  // namespace tcm_icp

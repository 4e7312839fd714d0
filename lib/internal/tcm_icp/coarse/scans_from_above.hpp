#pragma once
// What height maps of scans are made of: which ways may be up, and where the scan lies as seen from there.

#include <cstddef>
#include <span>
#include <vector>

#include "tcm_icp/coarse/height_map.hpp"
#include "tcm_icp/coarse/vertical.hpp"
#include "tcm_icp/core/cloud.hpp"

namespace tcm_icp {

/// Found when it is asked for, and kept: every search of a set's pairs asks for it.
class ScansFromAbove {
 public:
  /// @param clouds  one for each scan, which must outlive this: evenly sampled, each in its own frame; normals sharpen
  ///                what is found
  explicit ScansFromAbove(std::vector<const Cloud*> clouds, const VerticalOptions& vertical = {});

  std::size_t size() const { return clouds_.size(); }
  const VerticalOptions& vertical() const { return vertical_; }
  const Cloud& cloud(std::size_t scan) const { return *clouds_[scan]; }

  /// Of these scans, what is not known yet. Cost: 5 to 10 ms a scan of 50,000 points.
  /// @throws InvalidInput  if a cloud has fewer than 3 points, or all are equal
  void find(std::span<const std::size_t> scans, int num_threads);
  void find_all(int num_threads);

  /// For each way that may be up; none before find().
  const std::vector<Footprint>& footprints(std::size_t scan) const { return footprints_[scan]; }

 private:
  std::vector<const Cloud*> clouds_;
  VerticalOptions vertical_;
  std::vector<std::vector<Footprint>> footprints_;
};

}  // namespace tcm_icp

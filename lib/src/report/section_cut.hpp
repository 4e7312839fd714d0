#pragma once
// Thin sections through the merged cloud where two scans meet.

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "tcm_icp/pipeline/pipeline_result.hpp"

namespace tcm_icp {

struct SectionPoint {
  float along = 0, across = 0;  ///< [m] from the section's middle: along the surface, and off it
  std::size_t scan = 0;
};

/// A window on a plane across a surface: `along` the surface, `across` it, and `half_thickness_m` to either side.
struct SectionCut {
  std::size_t link = 0;                                              ///< position of the link whose scans meet here
  Eigen::Isometry3d T_section_view = Eigen::Isometry3d::Identity();  ///< x along, y across, z out of the plane
  double half_along_m = 0, half_across_m = 0, half_thickness_m = 0;
  bool is_level = false;  ///< the plane is level: a piece of a plan; else it is upright
  std::vector<SectionPoint> points;
};

/// At most two: where the scans of the link with the largest residuals meet, and of the link of other scans that have
/// the most points in common. Empty where residuals are not known.
std::vector<SectionCut> choose_sections(const PipelineResult& result);

/// Takes the raw points of a registered scan that lie within a section. O(points).
class SectionCutter {
 public:
  SectionCutter(std::vector<SectionCut>& cuts, const PipelineResult& result);
  void add(std::size_t scan, std::span<const Eigen::Vector3d> raw);

 private:
  std::vector<SectionCut>& cuts_;
  std::vector<std::vector<Eigen::Isometry3d>> T_section_raw_;  // of each cut and scan
};

}  // namespace tcm_icp

#include "report/section_cut.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "report/residual_statistics.hpp"

namespace tcm_icp {
namespace {

// In voxels of the adjustment: a few of them make a wall, and one is thin enough for it to be straight.
constexpr double kAlongInVoxels = 8, kThicknessInVoxels = 1;
constexpr double kAspect = 0.24;  // of the window
constexpr std::size_t kMostPoints = 60'000;

SectionCut cut_at(const PipelineResult& result, std::size_t number) {
  const LinkRecord& link = result.links[number];
  Eigen::Isometry3d T_view_a =
      result.poses[link.a].T_reference_scan * Eigen::Translation3d(result.scans[link.a].origin);
  T_view_a.pretranslate(-result.local_origin());
  const Eigen::Vector3d at = T_view_a * link.residuals.contact->point;
  const Eigen::Vector3d across = (T_view_a.linear() * link.residuals.contact->normal).normalized();
  // Level through walls, upright through floors.
  const bool is_wall = std::abs(across.z()) < 0.7;
  const Eigen::Vector3d hint = is_wall ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d out = (hint - hint.dot(across) * across).normalized();
  Eigen::Isometry3d T_view_section = Eigen::Isometry3d::Identity();
  T_view_section.linear() << across.cross(out), across, out;
  T_view_section.translation() = at;
  SectionCut cut;
  cut.link = number;
  cut.T_section_view = T_view_section.inverse();
  cut.half_along_m = kAlongInVoxels * result.fine_voxel_m;
  cut.half_across_m = kAspect * cut.half_along_m;
  cut.half_thickness_m = kThicknessInVoxels * result.fine_voxel_m;
  cut.is_level = is_wall;
  return cut;
}

double rms(const std::vector<LinkResidual>& residuals) {
  std::vector<float> distances;
  for (const LinkResidual& r : residuals) distances.push_back(r.distance_m);
  const auto statistics = residual_statistics(std::move(distances), 0, 1);
  return statistics ? statistics->rms_m : 0;
}

}  // namespace

std::vector<SectionCut> choose_sections(const PipelineResult& result) {
  const auto usable = [&](const LinkRecord& link) {
    return link.residuals.contact && link.verdict != Verdict::kRejected &&
           result.poses[link.a].status != ScanStatus::kUnregistered &&
           result.poses[link.b].status != ScanStatus::kUnregistered;
  };
  std::optional<std::size_t> worst, firmest;
  double most_m = -1;
  for (std::size_t k = 0; k < result.links.size(); ++k) {
    if (!usable(result.links[k])) continue;
    const double rms_m = rms(result.links[k].residuals.matches);
    if (rms_m <= most_m) continue;
    worst = k;
    most_m = rms_m;
  }
  for (std::size_t k = 0; k < result.links.size(); ++k) {
    if (!usable(result.links[k]) || k == *worst) continue;
    const std::size_t n = result.links[k].residuals.contact->num_matches;
    if (!firmest || n > result.links[*firmest].residuals.contact->num_matches) firmest = k;
  }
  std::vector<SectionCut> cuts;
  for (const auto& k : {worst, firmest}) {
    if (k) cuts.push_back(cut_at(result, *k));
  }
  return cuts;
}

SectionCutter::SectionCutter(std::vector<SectionCut>& cuts, const PipelineResult& result) : cuts_(cuts) {
  for (const SectionCut& cut : cuts) {
    T_section_raw_.emplace_back();
    for (const ScanPose& pose : result.poses) {
      Eigen::Isometry3d T_view_raw = pose.T_reference_scan;
      T_view_raw.pretranslate(-result.local_origin());
      T_section_raw_.back().push_back(cut.T_section_view * T_view_raw);
    }
  }
}

void SectionCutter::add(std::size_t scan, std::span<const Eigen::Vector3d> raw) {
  for (std::size_t k = 0; k < cuts_.size(); ++k) {
    SectionCut& cut = cuts_[k];
    if (cut.points.size() >= kMostPoints) continue;
    const Eigen::Isometry3d& T = T_section_raw_[k][scan];
    const Eigen::Vector3d out = T.matrix().row(2).head<3>();
    const double shift = T.translation().z();
    for (const Eigen::Vector3d& p : raw) {
      if (std::abs(out.dot(p) + shift) > cut.half_thickness_m) continue;  // most leave here
      const Eigen::Vector3d at = T * p;
      if (std::abs(at.x()) > cut.half_along_m || std::abs(at.y()) > cut.half_across_m) continue;
      cut.points.push_back({static_cast<float>(at.x()), static_cast<float>(at.y()), scan});
    }
  }
}

}  // namespace tcm_icp

#include "scans/matched_sides.hpp"

namespace tcm_icp {
namespace {

bool know_sides(const Sight& target, const Sight& source) { return target.knows_sides() && source.knows_sides(); }

// By guesses, where a scan has no better.
bool is_opposed(const Sight& target, const Sight& source, const Eigen::Isometry3d& T_source_target,
                const Correspondence& m) {
  return target.guessed_side(m.target, m.normal) *
             source.guessed_side(T_source_target * m.source, T_source_target.linear() * m.normal) <
         0;
}

}  // namespace

void drop_opposed(const Sight& target, const Sight& source, const Eigen::Isometry3d& T_target_source,
                  Correspondences& matches) {
  if (!know_sides(target, source)) return;
  const Eigen::Isometry3d T_source_target = T_target_source.inverse();
  std::erase_if(matches, [&](const Correspondence& m) { return is_opposed(target, source, T_source_target, m); });
}

std::vector<bool> may_be_opposed(const Sight& target, const Sight& source, const Eigen::Isometry3d& T_target_source,
                                 const Correspondences& matches) {
  std::vector<bool> out(matches.size(), false);
  if (know_sides(target, source)) return out;
  const Eigen::Isometry3d T_source_target = T_target_source.inverse();
  for (std::size_t k = 0; k < matches.size(); ++k) out[k] = is_opposed(target, source, T_source_target, matches[k]);
  return out;
}

}  // namespace tcm_icp

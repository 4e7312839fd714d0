#include "scans/matched_sides.hpp"

namespace tcm_icp {

void drop_opposed(const Sight& target, const Sight& source, const Eigen::Isometry3d& T_target_source,
                  Correspondences& matches) {
  if (!target.knows_sides() || !source.knows_sides()) return;
  const Eigen::Isometry3d T_source_target = T_target_source.inverse();
  std::erase_if(matches, [&](const Correspondence& m) {
    return target.side(m.target, m.normal) *
               source.side(T_source_target * m.source, T_source_target.linear() * m.normal) <
           0;
  });
}

std::vector<bool> may_be_opposed(const Sight& target, const Sight& source, const Eigen::Isometry3d& T_target_source,
                                 const Correspondences& matches) {
  const Eigen::Isometry3d T_source_target = T_target_source.inverse();
  std::vector<bool> out;
  for (const Correspondence& m : matches) {
    out.push_back(target.guessed_side(m.target, m.normal) *
                      source.guessed_side(T_source_target * m.source, T_source_target.linear() * m.normal) <
                  0);
  }
  return out;
}

}  // namespace tcm_icp

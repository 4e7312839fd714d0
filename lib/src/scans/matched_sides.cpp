#include "scans/matched_sides.hpp"

#include <algorithm>
#include <vector>

namespace tcm_icp {
namespace {

// Of a pair's matches, by noise, thin things and what moved. Beyond it those of opposite sides are not used.
constexpr double kMaxOpposedShare = 0.12;

}  // namespace

void drop_opposed(const Sight& target, const Sight& source, const Eigen::Isometry3d& T_target_source,
                  Correspondences& matches) {
  if (!target.knows_sides() || !source.knows_sides()) return;
  const Eigen::Isometry3d T_source_target = T_target_source.inverse();
  std::vector<int> agreement;  // 1: the same side, -1: opposite ones, 0: not known
  for (const Correspondence& m : matches) {
    agreement.push_back(target.side(m.target, m.normal) *
                        source.side(T_source_target * m.source, T_source_target.linear() * m.normal));
  }
  const auto opposed = std::count(agreement.begin(), agreement.end(), -1);
  const auto known = opposed + std::count(agreement.begin(), agreement.end(), 1);
  if (static_cast<double>(opposed) <= kMaxOpposedShare * static_cast<double>(known)) return;
  std::size_t i = 0;
  std::erase_if(matches, [&](const Correspondence&) { return agreement[i++] < 0; });
}

}  // namespace tcm_icp

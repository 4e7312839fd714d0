#pragma once
// What holds a part of a component to the rest, and where else it could hang.

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "inference/alike_parts.hpp"
#include "inference/compared_pairs.hpp"

namespace tcm_icp {

/// A part of a component that moves as one against the rest, and the evidence across.
struct Cut {
  std::vector<std::size_t> moved;  ///< ascending; without the reference
  double support = 0;              ///< of the pairs across at the poses as they are, less log_poses
  /// Of the best clearly different motion of the part; 0 where none is likelier than that all hypotheses are wrong.
  double other_support = 0;
  /// That motion in the reference's frame, T_new = motion * T_old, where there is one.
  std::optional<Eigen::Isometry3d> other_motion;
  /// Of all places that hypotheses of the scans that hold the part lead it to, but for that one, together.
  double odds_elsewhere = 0;

  bool moves(std::size_t scan) const { return std::binary_search(moved.begin(), moved.end(), scan); }

  /// Log-odds of the poses against all other places and against none at all. One place at most is right: many that are
  /// unlikely each are likely together, and of many pairs that were compared in vain one looks good by chance.
  double lead() const;
};

/// The cut between `moved` and the other members.
/// @param most_lead  >= 0; other places that leave a larger lead are not looked for
Cut measure_cut(const PairGraph& graph, const Component& component, std::vector<std::size_t> moved,
                double most_lead = std::numeric_limits<double>::infinity());

/// The parts that minimum cuts of the pairs' support against twins leave, without the reference, each once: for any two
/// members the weakest hold between them is among them. Cost: minimum_cuts().
std::vector<std::vector<std::size_t>> weakest_parts(const PairGraph& graph, const Component& component,
                                                    const AlikeParts& alike);

/// The cuts of those parts, of those that are but alike and of every member by itself, each once; the same
/// for any number of threads. Cost: minimum_cuts(), and PairsAcross::best_elsewhere() for each.
/// @param most_lead  as in measure_cut()
std::vector<Cut> weakest_cuts(const PairGraph& graph, const Component& component, int num_threads = 1,
                              double most_lead = std::numeric_limits<double>::infinity());

/// The cut with the least lead of those that move the scan; nullptr where none does.
const Cut* weakest_cut_of(std::size_t scan, const std::vector<Cut>& cuts);

/// Those of the moved that pairs across the cut hold where they are: there, more may be found out. All of them where
/// none does.
std::vector<std::size_t> frontier(const PairGraph& graph, const Component& component, const Cut& cut);

/// A number for each scan, the same for those whose poses to one another are clear: members of one component that no
/// cut with a lead below `clear_lead` parts. `cuts` are the weakest of each component.
std::vector<std::size_t> clear_groups(const std::vector<Component>& components,
                                      const std::vector<std::vector<Cut>>& cuts, double clear_lead,
                                      std::size_t num_scans);

/// The least lead of the cuts that part two members. Cost: cuts times scans once, then at most the cuts a question.
class Leads {
 public:
  Leads(const std::vector<Cut>& cuts, std::size_t num_scans);
  /// Infinite where no cut parts them.
  double between(std::size_t a, std::size_t b) const;

 private:
  struct Sides {
    double lead;
    std::vector<bool> moves;  // each scan
  };
  std::vector<Sides> sides_;  // the least lead first
};

}  // namespace tcm_icp

#pragma once
// The poses that most hypotheses of a set agree on.

#include <vector>

#include "inference/compared_pairs.hpp"

namespace tcm_icp {

/// Sum of the support of all pairs of members, less log_poses for every member but one: the logarithm of how much
/// likelier the hypotheses are with these poses than if all of them were wrong.
double log_likelihood(const PairGraph& graph, const Component& component);

/// Components of the set, the largest first, each the likeliest poses found among the scans that are left: grown scan
/// by scan from the strongest hypotheses, and from what is left of the largest of the components that are `known`, then
/// improved by moves of single scans and of groups to other poses that hypotheses lead to, as long as the likelihood
/// grows. A scan that more speaks against than for is in none. The reference is the member with the most support.
/// The threads share the work and do not change the result. Cost: about max_grown_scans, or the scans times
/// least_starts, times pairs of a scan, and poses of a scan squared.
/// @param known         likeliest by fewer hypotheses, or by other log-odds
/// @param least_starts  >= 1; of however large a set, what is known among them
std::vector<Component> likeliest_components(const PairGraph& graph, const std::vector<Component>& known = {},
                                            int least_starts = 2, int num_threads = 1);

/// The component with its poses moved as `cuts` allow, as long as the likelihood grows. For tests, and after new
/// hypotheses.
void improve(const PairGraph& graph, Component& component, int num_threads = 1);

/// The same poses in the frame of another member.
void change_reference(Component& component, std::size_t reference);

}  // namespace tcm_icp

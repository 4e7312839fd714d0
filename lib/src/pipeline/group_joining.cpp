#include "group_joining.hpp"

#include <algorithm>
#include <string>

#include "merged_cloud.hpp"
#include "pair_search.hpp"
#include "scan_set.hpp"
#include "scan_sight.hpp"

namespace tcm_icp {
namespace {

/// Least log-odds for a group to join another: many scans at once are at stake, and chance has had many poses to choose
/// from. In a hall of equal bays wrong joins came to 3.9, right ones to 7.7 and more.
constexpr double kMinGroupLogOdds = 6;
constexpr std::size_t kMemberCandidates = 8;

struct Groups {
  std::vector<AdjustedSet> sets;        // those of several scans first
  std::vector<std::size_t> set_number;  // in the list given; none for single scans
  std::size_t num_large = 0;
};

Groups list_groups(const std::vector<AdjustedSet>& sets, std::size_t num_scans) {
  Groups groups;
  std::vector<bool> taken(num_scans, false);
  for (std::size_t s = 0; s < sets.size(); ++s) {
    if (sets[s].num_placed() < 2) continue;
    for (std::size_t i = 0; i < num_scans; ++i) taken[i] = taken[i] || sets[s].placed[i];
    groups.sets.push_back(sets[s]);
    groups.set_number.push_back(s);
  }
  groups.num_large = groups.sets.size();
  for (std::size_t i = 0; i < num_scans; ++i) {
    if (!taken[i]) groups.sets.push_back(set_of_one(i, num_scans));
  }
  return groups;
}

std::vector<std::size_t> members_of(const AdjustedSet& set) {
  std::vector<std::size_t> members;
  for (std::size_t i = 0; i < set.placed.size(); ++i) {
    if (set.placed[i]) members.push_back(i);
  }
  return members;
}

// In the local frame of the group's reference.
SampledScan merged(const AdjustedSet& set, const std::string& name, const MergeInput& input,
                   const Resolutions& resolutions) {
  MergedCloud cloud(resolutions.fine_m);
  for (const std::size_t i : members_of(set)) cloud.add(input.scans[i].fine.cloud, set.T_reference_scan[i]);
  SampledScan sampled;
  sampled.scan.file = name;
  sampled.scan.cloud = cloud.level().cloud;
  sampled.surface_normals = sampled.scan.cloud.normals;
  return sampled;
}

// What links between members of the one and of the other say of b's pose in a's frame.
double support_of_members(const AdjustedSet& a, const AdjustedSet& b, const Eigen::Isometry3d& T_a_b,
                          const MergeInput& input, const Resolutions& resolutions) {
  std::vector<Eigen::Isometry3d> T_a_scan = a.T_reference_scan;
  double sum = 0;
  for (const std::size_t i : members_of(b)) {
    T_a_scan[i] = T_a_b * b.T_reference_scan[i];
    sum += input.graph.support(i, a.placed, T_a_scan, input.scans[i].moments, kSameLinkPose * resolutions.coarse_m)
               .log_odds;
  }
  return sum;
}

// Of the scans of the one and of the other group, with b at that pose in a's frame.
FreeSpaceEvidence free_space_of_members(const AdjustedSet& a, const AdjustedSet& b, const Eigen::Isometry3d& T_a_b,
                                        const MergeInput& input) {
  FreeSpaceEvidence sum;
  for (const std::size_t i : members_of(a)) {
    for (const std::size_t j : members_of(b)) {
      sum +=
          free_space(input.scans[i], input.scans[j], a.T_reference_scan[i].inverse() * T_a_b * b.T_reference_scan[j]);
    }
  }
  return sum;
}

// Where the likeliest links between members would put group b in group a's frame.
std::vector<PoseCandidate> candidates_of_members(const AdjustedSet& a, const AdjustedSet& b, const PoseGraph& graph) {
  std::vector<std::pair<double, PoseCandidate>> found;
  for (const std::size_t i : members_of(a)) {
    for (const std::size_t j : members_of(b)) {
      const auto link = graph.links().find({std::min(i, j), std::max(i, j)});
      if (link == graph.links().end()) continue;
      for (const LinkHypothesis& h : link->second.hypotheses) {
        PoseCandidate candidate = h.candidate;
        candidate.T_target_source =
            a.T_reference_scan[i] * link->second.T_other(j, h) * b.T_reference_scan[j].inverse();
        found.emplace_back(-h.log_odds, candidate);
      }
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
  std::vector<PoseCandidate> out;
  for (std::size_t k = 0; k < std::min(kMemberCandidates, found.size()); ++k) out.push_back(found[k].second);
  return out;
}

// The members of `group`, whose reference lies at `T` in the frame of `to`, become members of `to`.
void take_over(const AdjustedSet& group, const Eigen::Isometry3d& T, const MergeRecord& record, AdjustedSet& to) {
  const bool single = group.num_placed() == 1;
  for (const std::size_t i : members_of(group)) {
    to.placed[i] = true;
    to.T_reference_scan[i] = T * group.T_reference_scan[i];
    to.evidence[i] = i == group.reference ? record.evidence : group.evidence[i];
    to.reasons[i] = record.reason;
    if (single) to.group_log_odds[i] = record.evidence->link_log_odds;
  }
}

}  // namespace

std::optional<GroupJoin> join_groups(const MergeInput& input, const Resolutions& resolutions,
                                     const std::vector<AdjustedSet>& sets, std::vector<MergeRecord>& merges) {
  const std::size_t num_scans = input.scans.size();
  const Groups groups = list_groups(sets, num_scans);
  const std::size_t n = groups.sets.size();
  if (groups.num_large == 0 || n < 2) return std::nullopt;

  std::vector<SampledScan> sampled;
  std::vector<std::string> names;
  for (const auto& set : groups.sets) {
    const std::size_t others = set.num_placed() - 1;
    names.push_back(input.files[set.reference] + (others > 0 ? " and " + std::to_string(others) + " more" : ""));
    sampled.push_back(merged(set, names.back(), input, resolutions));
  }
  const Resolutions group_resolutions = choose_resolutions(sampled, input.options.sampling, input.context.num_threads);
  const std::vector<PreparedScan> clouds =
      prepare_scans(sampled, group_resolutions, input.options.placement, input.context);
  PairSearch search(clouds, names, input.options, input.context);
  for (std::size_t a = groups.num_large; a < n; ++a) {
    for (std::size_t b = a + 1; b < n; ++b) search.leave_out(a, b);  // known already
  }
  PoseGraph found(n), graph(n);
  search.run(found);
  for (std::size_t a = 0; a < groups.num_large; ++a) {
    for (std::size_t b = a + 1; b < n; ++b) {
      // One by one: each is fitted, however many there are.
      for (const PoseCandidate& c : candidates_of_members(groups.sets[a], groups.sets[b], input.graph)) {
        found.add(fit_candidates(clouds, a, b, {c}, input.options), clouds[b].moments, group_resolutions.coarse_m);
      }
    }
  }
  for (const auto& [pair, link] : found.links()) {
    const AdjustedSet& a = groups.sets[pair.first];
    const AdjustedSet& b = groups.sets[pair.second];
    CandidateLink weighed{pair.first, pair.second, {}};
    for (LinkHypothesis h : link.hypotheses) {
      if (free_space_of_members(a, b, h.T_a_b, input).vetoes()) continue;
      const double members = support_of_members(a, b, h.T_a_b, input, resolutions);
      input.context.debug(names[pair.first] + " to " + names[pair.second] + ": log-odds " + std::to_string(h.log_odds) +
                          ", their members' " + std::to_string(members));
      h.log_odds += members;
      if (h.log_odds >= kMinGroupLogOdds) weighed.hypotheses.push_back(h);
    }
    graph.add(weighed);
  }

  const std::vector<std::optional<Eigen::Isometry3d>> no_guess(n);
  const MergeInput among_groups{clouds, names, no_guess, graph, input.options, input.context};
  for (std::size_t first = 0; first < groups.num_large; ++first) {
    // The smaller joins the larger: a pose that failed so is not tried the other way round.
    std::vector<bool> wanted(n, true);
    std::fill_n(wanted.begin(), first, false);
    Merging merging(among_groups, first, wanted);
    std::vector<MergeRecord> records;
    merging.run(records);
    GroupJoin join{{groups.set_number[first]}, groups.sets[first]};
    for (MergeRecord& record : records) {
      const std::size_t group = record.scan;
      record.scan = groups.sets[group].reference;
      record.members = members_of(groups.sets[group]);
      merges.push_back(record);
      if (!record.accepted) continue;
      take_over(groups.sets[group], merging.T_reference_scan()[group], record, join.set);
      if (group < groups.num_large) join.parts.push_back(groups.set_number[group]);
    }
    if (join.set.num_placed() > groups.sets[first].num_placed()) return join;
  }
  return std::nullopt;
}

}  // namespace tcm_icp

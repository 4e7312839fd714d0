#include "pipeline/leaving_scans.hpp"

#include <algorithm>
#include <iterator>

namespace tcm_icp {
namespace {

using Scans = std::vector<std::size_t>;

// Of two parts that may lie elsewhere to one another, the larger stays.
Scans smaller_side(const Cut& cut, const Scans& members) {
  if (2 * cut.moved.size() <= members.size()) return cut.moved;
  Scans others;
  std::set_difference(members.begin(), members.end(), cut.moved.begin(), cut.moved.end(), std::back_inserter(others));
  return others;
}

// What the pairs across speak against, as poses are adjusted: hypotheses hung it there that the others do not bear out.
// Wherever it belongs, it spoils what is measured of its neighbours here.
const Cut* most_contradicted(const std::vector<Cut>& cuts, const std::vector<Decision>& decisions) {
  const Cut* worst = nullptr;
  for (const Cut& cut : cuts) {
    const bool fails =
        std::any_of(cut.moved.begin(), cut.moved.end(), [&](std::size_t i) { return !decisions[i].accepted(); });
    if (cut.support >= 0 || !fails) continue;
    const bool is_worse = worst == nullptr || cut.support < worst->support ||
                          (cut.support == worst->support && cut.moved.size() > worst->moved.size());
    if (is_worse) worst = &cut;
  }
  return worst;
}

// What may lie elsewhere leaves as a whole.
Scans leaving_with(std::size_t scan, const Scans& members, const Decision& decision, const std::vector<Cut>& cuts) {
  const Cut* cut = weakest_cut_of(scan, cuts);
  if (decision.reason != Reason::kAmbiguous || cut == nullptr) return {scan};
  return smaller_side(*cut, members);
}

}  // namespace

Scans leaving_scans(const Scans& members, const std::vector<Decision>& decisions, const std::vector<Cut>& cuts,
                    const ScanPairs& pairs) {
  Scans worst_first;
  for (const std::size_t i : members) {
    if (!decisions[i].accepted()) worst_first.push_back(i);
  }
  if (worst_first.empty()) return {};
  if (const Cut* contradicted = most_contradicted(cuts, decisions)) return smaller_side(*contradicted, members);
  std::stable_sort(worst_first.begin(), worst_first.end(),
                   [&](std::size_t x, std::size_t y) { return decisions[x].probability < decisions[y].probability; });
  Scans leaving;
  std::vector<bool> is_touched(decisions.size(), false);  // does not pass, or is linked to what does not
  for (const std::size_t i : worst_first) {
    const Scans part = leaving_with(i, members, decisions[i], cuts);
    const bool waits = std::any_of(part.begin(), part.end(), [&](std::size_t j) { return is_touched[j]; }) ||
                       (!leaving.empty() && 2 * part.size() > members.size() - leaving.size());
    if (!waits) leaving.insert(leaving.end(), part.begin(), part.end());
    std::vector<bool> fails(decisions.size(), false);
    for (const std::size_t j : part) is_touched[j] = fails[j] = true;
    for (const auto& [a, b] : pairs) {
      if (fails[a] || fails[b]) is_touched[a] = is_touched[b] = true;
    }
  }
  return leaving;
}

}  // namespace tcm_icp

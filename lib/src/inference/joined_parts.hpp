#pragma once
// Scans of a component joined to parts, one after another, by what pairs between them tell.

#include <algorithm>
#include <cstddef>
#include <map>
#include <numeric>
#include <queue>
#include <vector>

namespace tcm_icp {

/// A part is named by one of its scans. `Tally` is what one or more pairs tell of one side as seen from the other: it
/// adds up, and counts its `pairs`.
template <typename Tally>
class JoinedParts {
 public:
  explicit JoinedParts(std::size_t num_scans)
      : part_(num_scans), size_(num_scans, 1), within_(num_scans), between_(num_scans) {
    std::iota(part_.begin(), part_.end(), std::size_t{0});
  }

  void add(std::size_t a, std::size_t b, const Tally& of_a, const Tally& of_b) {
    between_[a][b] += of_a;
    between_[b][a] += of_b;
  }

  /// Joins parts with pairs between them, those first whose tally of both sides promises more, as long as two may be
  /// one; what may not is asked again when either has grown.
  /// Cost: a logarithm for the neighbours of each part that is joined.
  template <typename Promise, typename MayBeOne>
  void join(Promise promise, MayBeOne may_be_one) {
    std::priority_queue<Joint> open;
    const auto consider = [&](std::size_t part) {
      for (const auto& [other, tally] : between_[part]) {
        const Tally both = both_sides(part, other);
        open.push({promise(both), std::min(part, other), std::max(part, other), both.pairs});
      }
    };
    for (std::size_t part = 0; part < part_.size(); ++part) consider(part);
    while (!open.empty()) {
      const Joint joint = open.top();
      open.pop();
      if (!has_between(joint.into, joint.from) || both_sides(joint.into, joint.from).pairs != joint.pairs) continue;
      if (!may_be_one(joint.into, joint.from)) continue;
      join_two(joint.into, joint.from);
      consider(joint.into);
    }
  }

  std::size_t part_of(std::size_t scan) const { return part_[scan]; }
  double size(std::size_t part) const { return size_[part]; }
  const Tally& within(std::size_t part) const { return within_[part]; }
  bool has_between(std::size_t part, std::size_t other) const { return between_[part].contains(other); }
  const Tally& of(std::size_t part, std::size_t other) const { return between_[part].at(other); }
  Tally both_sides(std::size_t part, std::size_t other) const {
    Tally out = of(part, other);
    out += of(other, part);
    return out;
  }

  /// The parts of the members that are told from any other by `are_apart`, ascending, or all members that are not of it
  /// where it has the reference. Some may be named twice.
  template <typename AreApart>
  std::vector<std::vector<std::size_t>> parts(const std::vector<std::size_t>& members, std::size_t reference,
                                              AreApart are_apart) const {
    const std::size_t of_reference = part_[reference];
    std::map<std::size_t, std::vector<std::size_t>> parts;
    for (const std::size_t i : members) {
      if (part_[i] == of_reference) continue;
      parts[part_[i]].push_back(i);
      parts[of_reference].push_back(i);
    }
    std::vector<std::vector<std::size_t>> out;
    for (auto& [part, scans] : parts) {
      const bool is_told = std::any_of(between_[part].begin(), between_[part].end(),
                                       [&](const auto& other) { return are_apart(part, other.first); });
      if (is_told) out.push_back(std::move(scans));
    }
    return out;
  }

 private:
  // Two parts that may be joined, as they were.
  struct Joint {
    double promise;
    std::size_t into, from;
    double pairs;  // between them: with every join either has more

    // Of two that promise the same the earlier parts go first: no accident decides.
    bool operator<(const Joint& other) const {
      if (promise != other.promise) return promise < other.promise;
      return into != other.into ? into > other.into : from > other.from;
    }
  };

  void join_two(std::size_t into, std::size_t from) {
    size_[into] += size_[from];
    within_[into] += within_[from];
    within_[into] += both_sides(into, from);
    between_[into].erase(from);
    between_[from].erase(into);
    for (const auto& [other, tally] : between_[from]) {
      between_[into][other] += tally;
      between_[other][into] += between_[other][from];
      between_[other].erase(from);
    }
    between_[from].clear();
    std::replace(part_.begin(), part_.end(), from, into);
  }

  std::vector<std::size_t> part_;                      // of every scan
  std::vector<double> size_;                           // of every part: its scans
  std::vector<Tally> within_;                          // of every part
  std::vector<std::map<std::size_t, Tally>> between_;  // of every part, by each other one
};

}  // namespace tcm_icp

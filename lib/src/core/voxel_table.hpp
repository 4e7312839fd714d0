#pragma once
// A hash from voxels to consecutive numbers, for clouds of known points.

#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "tcm_icp/core/voxel_sampler.hpp"

namespace tcm_icp {

/// Numbers voxels in the order in which they come. Half the time a typical sample takes is look-ups, and nodes of
/// std::unordered_map cost a cache miss each: a slot is 8 bytes here (open addressing, linear probing), and keys are
/// compared only where 32 bits of their hashes agree. Points of a scan come along surfaces, so that the voxel of the
/// point before is often the next one's, too.
class VoxelTable {
 public:
  VoxelTable() : slots_(1024) {}

  std::uint32_t size() const { return static_cast<std::uint32_t>(keys_.size()); }
  const std::vector<VoxelKey>& keys() const { return keys_; }

  /// The voxel's number; size() before the call where the voxel is new.
  std::uint32_t find_or_insert(const VoxelKey& key) {
    if (last_ < keys_.size() && keys_[last_] == key) return last_;
    const auto tag = static_cast<std::uint32_t>(VoxelKeyHash{}(key));
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = tag & mask;
    for (; slots_[i].number != kNone; i = (i + 1) & mask) {
      if (slots_[i].tag == tag && keys_[slots_[i].number] == key) return last_ = slots_[i].number;
    }
    last_ = size();
    slots_[i] = {tag, last_};
    keys_.push_back(key);
    if (2 * keys_.size() > slots_.size()) grow();
    return last_;
  }

  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// The voxel's number; kNone where it has none.
  std::uint32_t find(const VoxelKey& key) const {
    const auto tag = static_cast<std::uint32_t>(VoxelKeyHash{}(key));
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t i = tag & mask; slots_[i].number != kNone; i = (i + 1) & mask) {
      if (slots_[i].tag == tag && keys_[slots_[i].number] == key) return slots_[i].number;
    }
    return kNone;
  }

  static constexpr int kBlock = 27;

  /// find() of the n-th voxel, n < kBlock, of those that touch the key's, itself the middle one.
  std::uint32_t find_in_block(const VoxelKey& key, int n) const {
    return find({key.x + n % 3 - 1, key.y + n / 3 % 3 - 1, key.z + n / 9 - 1});
  }

 private:
  struct Slot {
    std::uint32_t tag = 0;
    std::uint32_t number = kNone;
  };

  // Begun small: as long as the table fits the cache a look-up costs a tenth.
  void grow() {
    std::vector<Slot> old(2 * slots_.size());
    old.swap(slots_);
    const std::size_t mask = slots_.size() - 1;
    for (const Slot& slot : old) {
      if (slot.number == kNone) continue;
      std::size_t i = slot.tag & mask;
      while (slots_[i].number != kNone) i = (i + 1) & mask;
      slots_[i] = slot;
    }
  }

  std::vector<Slot> slots_;
  std::vector<VoxelKey> keys_;
  std::uint32_t last_ = kNone;
};

}  // namespace tcm_icp

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace arete {

/// A map from ids to indices: a hash table of open addressing with linear probing, at most half full, and
/// deletion without tombstones ([Knuth1998], section 6.4, algorithms L and R). Ids come in runs (the
/// triangles of a root, of a star), so the hash is multiplicative: a run does not fill a stretch of the
/// table. Expected O(1) per operation. 8 bytes per slot.
class IdIndexMap {
 public:
  bool contains(std::uint32_t id) const { return slots_[find(id)].id == id; }
  /// Precondition: the map contains the id.
  std::uint32_t& operator[](std::uint32_t id) { return slots_[find(id)].index; }

  /// Precondition: the map does not contain the id, which is not 0xFFFFFFFF.
  void insert(std::uint32_t id, std::uint32_t index) {
    if (2 * ++size_ > slots_.size()) grow();
    slots_[find(id)] = {id, index};
  }

  /// @return The index of the id. Precondition: the map contains the id.
  std::uint32_t erase(std::uint32_t id) {
    --size_;
    std::uint32_t gap = find(id);
    const std::uint32_t index = slots_[gap].index;
    // Entries that follow move into the gap, unless their own slot lies after it.
    for (std::uint32_t i = next(gap); slots_[i].id != kNone; i = next(i)) {
      if (((i - slotOf(slots_[i].id)) & mask()) < ((i - gap) & mask())) continue;
      slots_[gap] = slots_[i];
      gap = i;
    }
    slots_[gap].id = kNone;
    return index;
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
  struct Slot {
    std::uint32_t id = kNone, index = 0;
  };

  std::uint32_t mask() const { return static_cast<std::uint32_t>(slots_.size() - 1); }
  std::uint32_t next(std::uint32_t slot) const { return (slot + 1) & mask(); }
  std::uint32_t slotOf(std::uint32_t id) const {
    return static_cast<std::uint32_t>((id * 0x9E3779B97F4A7C15ull) >> shift_);
  }
  /// The slot that has the id, or the free one where it would be inserted.
  std::uint32_t find(std::uint32_t id) const {
    std::uint32_t slot = slotOf(id);
    while (slots_[slot].id != id && slots_[slot].id != kNone) slot = next(slot);
    return slot;
  }
  void grow() {
    const std::vector<Slot> old = std::move(slots_);
    slots_.assign(2 * old.size(), {});
    --shift_;
    for (const Slot& slot : old)
      if (slot.id != kNone) slots_[find(slot.id)] = slot;
  }

  int shift_ = 64 - 4;
  std::size_t size_ = 0;
  std::vector<Slot> slots_ = std::vector<Slot>(16);
};

}  // namespace arete

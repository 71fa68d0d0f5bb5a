// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace arete {

/// Where each of some ids stands in a list: a hash table of open addressing, at most half full, whose ids are
/// found by going on from their slot (Knuth, The Art of Computer Programming 3, 6.4, algorithms L and R). Ids
/// come in runs, a root's, a star's; their hash scatters them, or runs would fill whole stretches of the
/// table. Expected O(1) each.
class IdIndexMap {
 public:
  bool contains(std::uint32_t id) const { return slots_[find(id)].id == id; }
  /// Precondition: the table has the id.
  std::uint32_t& operator[](std::uint32_t id) { return slots_[find(id)].place; }

  /// Precondition: the table does not have the id.
  void insert(std::uint32_t id, std::uint32_t place) {
    if (2 * ++size_ > slots_.size()) grow();
    slots_[find(id)] = {id, place};
  }

  /// Returns its place. Precondition: the table has the id.
  std::uint32_t erase(std::uint32_t id) {
    --size_;
    std::uint32_t gap = find(id);
    const std::uint32_t place = slots_[gap].place;
    // What follows moves up, unless its own slot lies after the gap.
    for (std::uint32_t i = next(gap); slots_[i].id != kNone; i = next(i)) {
      if (((i - slotOf(slots_[i].id)) & mask()) < ((i - gap) & mask())) continue;
      slots_[gap] = slots_[i];
      gap = i;
    }
    slots_[gap].id = kNone;
    return place;
  }

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;
  struct Slot {
    std::uint32_t id = kNone, place = 0;
  };

  std::uint32_t mask() const { return static_cast<std::uint32_t>(slots_.size() - 1); }
  std::uint32_t next(std::uint32_t slot) const { return (slot + 1) & mask(); }
  std::uint32_t slotOf(std::uint32_t id) const {
    return static_cast<std::uint32_t>((id * 0x9E3779B97F4A7C15ull) >> shift_);
  }
  /// The slot that has the id, or the free one where it would be.
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

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace arete {

/// Places of the triangles of a front in a buffer that is sorted by material. A triangle keeps its slot from
/// update to update, or moves to that of one that left, so that few slots are to be sent. Every material has
/// a quarter of spare room behind its triangles; when one has no room left all are packed anew. Memory: about
/// 16 bytes a triangle of the front, and the spare room.
class MaterialSlots {
 public:
  struct Range {
    std::uint32_t first = 0, count = 0, room = 0;
  };
  explicit MaterialSlots(std::uint32_t materials) : ranges_(materials) {}

  /// Brings the slots to a front, as IncrementalCut::triangles() lists it.
  /// @param materialOf The same for a triangle in every update, less than the number of materials.
  /// O(front) comparisons, and O(changes) apart from them.
  template <class MaterialOf>
  void update(std::span<const std::uint32_t> front, const MaterialOf& materialOf) {
    changed_.clear();
    isPacked_ = false;
    for (std::size_t i = front.size(); i < front_.size(); ++i) remove(slotOf_[i], materialOf(front_[i]));
    const std::size_t common = std::min(front.size(), front_.size());
    slotOf_.resize(front.size());
    bool haveRoom = true;
    for (std::size_t i = 0; i < front.size() && haveRoom; ++i) {
      if (i < common) {
        if (front[i] == front_[i]) continue;
        const std::uint32_t before = materialOf(front_[i]);
        if (materialOf(front[i]) == before) {
          put(slotOf_[i], i, front[i]);
          continue;
        }
        remove(slotOf_[i], before);
      }
      haveRoom = append(i, front[i], materialOf(front[i]));
    }
    front_.assign(front.begin(), front.end());
    if (!haveRoom) pack(materialOf);
    std::ranges::sort(changed_);
    changed_.erase(std::ranges::unique(changed_).begin(), changed_.end());
  }

  /// The triangle of every slot; what spare slots have is not to be drawn.
  std::span<const std::uint32_t> triangles() const { return triangleAt_; }
  /// By material.
  std::span<const Range> ranges() const { return ranges_; }
  /// The last update packed all slots anew: everything is to be sent.
  bool isPacked() const { return isPacked_; }
  /// Ascending, the slots that the last update wrote. Empty if it packed them.
  std::span<const std::uint32_t> changed() const { return changed_; }

 private:
  void put(std::uint32_t slot, std::size_t index, std::uint32_t triangle) {
    triangleAt_[slot] = triangle;
    indexAt_[slot] = static_cast<std::uint32_t>(index);
    slotOf_[index] = slot;
    changed_.push_back(slot);
  }

  bool append(std::size_t index, std::uint32_t triangle, std::uint32_t material) {
    Range& range = ranges_[material];
    if (range.count == range.room) return false;
    put(range.first + range.count++, index, triangle);
    return true;
  }

  /// The last triangle of the material fills the gap.
  void remove(std::uint32_t slot, std::uint32_t material) {
    Range& range = ranges_[material];
    const std::uint32_t last = range.first + --range.count;
    if (slot != last) put(slot, indexAt_[last], triangleAt_[last]);
  }

  template <class MaterialOf>
  void pack(const MaterialOf& materialOf) {
    for (Range& range : ranges_) range = {};
    for (const std::uint32_t t : front_) ++ranges_[materialOf(t)].room;
    std::uint32_t end = 0;
    for (Range& range : ranges_) {
      range.first = end;
      range.room += range.room / 4;
      end += range.room;
    }
    triangleAt_.assign(end, front_.empty() ? 0 : front_.front());
    indexAt_.assign(end, 0);
    for (std::size_t i = 0; i < front_.size(); ++i) append(i, front_[i], materialOf(front_[i]));
    changed_.clear();
    isPacked_ = true;
  }

  std::vector<Range> ranges_;
  std::vector<std::uint32_t> front_, slotOf_;  // by index in the front
  std::vector<std::uint32_t> triangleAt_, indexAt_;
  std::vector<std::uint32_t> changed_;
  bool isPacked_ = false;
};

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The front of a packet while its nodes are read or written. A triangle that the packet created and that will
// be removed has a record: its corners, and what lies across each edge, updated as stars replace floors.
// Records of removed triangles are reused, so that they stay in a cache. While a triangle has a record, its
// remover is a mark with the index of the record. Triangles without a remover (one in three; the finest
// triangulation) are known when they are created. They are never read, so they share one dummy record.
// Triangles that are left to other packets are known then, too.
//
// A triangle that another packet created and left has a border record instead (Arrays::border), written when
// that packet ended and constant since. A triangle that it names across an edge may have been removed since.
// The edge still exists, so the star of the remover has it in its link, and the search goes on with the
// triangle at that slot. All nodes on this way are ancestors of the node that is coded. So packets that do
// not depend on each other do not read what the other writes, except to prefetch. In a damaged file they may;
// then they read some value, which is checked before it is used. A mark with the index of a border record is
// written after the record.

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <vector>

#include "io/store/packed/nodes/arrays.h"
#include "io/store/packed/nodes/shapes.h"

namespace arete::packed {

/// What lies across an edge: 4 * (a record of the front) + the edge of its triangle, or kForeign + an index
/// in the front's list of triangles of other packets (which may have been removed, see above), or kNoSide.
using Side = std::uint32_t;
inline constexpr Side kForeign = 1u << 31;
inline constexpr Side kNoSide = ~0u;

/// Edge i of a triangle goes from corner i to the next one.
inline constexpr std::array<std::uint8_t, 4> kNextEdge = {1, 2, 0, 0};

/// A node's floor while the node is coded.
struct Floor {
  /// 8 numbers per triangle: its corners at 0, its id at kId, what lies across its edges at kAcross.
  static constexpr unsigned kId = 3, kAcross = 4;
  std::array<std::uint32_t, 8 * kMaxFloor> words;
  int size = 0;
  std::array<std::uint32_t, kMaxHoleCorners + 1> link;  ///< the last is read ahead and not used
  std::array<Side, kMaxHoleCorners> outer;
  int corners = 0;
  bool isOpen = false;
  bool isAtBorder = false;  ///< an edge of the link has nothing across

  std::uint32_t id(int triangle) const { return words[8 * static_cast<unsigned>(triangle) + kId]; }
};

/// Memory of a front, reused from packet to packet because fresh memory costs time.
struct FrontSpace {
  /// A triangle that the packet created.
  struct alignas(32) Record {
    std::array<std::uint32_t, 3> corners;
    std::uint32_t id;
    std::array<Side, 3> across;
    std::uint32_t border;  ///< its index in Arrays::border, if it is left to others
  };
  std::vector<Record> pool;
  std::vector<std::uint32_t> free;     ///< indices of free records, and some spare entries
  std::vector<std::uint32_t> foreign;  ///< ids
};

class Front {
 public:
  /// A triangle that this packet created.
  struct Own {
    std::uint32_t record, id;
  };

  /// The largest number of records: Side has 29 bits for one, and foreign triangles are numbered likewise.
  static constexpr std::uint64_t kMostRecords = (std::uint64_t{1} << 29) - 256;
  /// Whether a packet of so many nodes needs no more. A star has two triangles more than its floor, and
  /// triangles of other packets have no record.
  static bool canHold(std::uint64_t nodes, std::uint64_t borders) {
    return 2 * nodes + std::min(kMaxFloor * nodes, borders) <= kMostRecords;
  }

  Front(Arrays& arrays, const Packet& packet, FrontSpace& space)
      : a_(arrays),
        pool_(space.pool),
        free_(space.free),
        foreign_(space.foreign),
        firstBorder_(static_cast<std::uint32_t>(a_.roots + packet.firstBorder)),
        borderEnd_(std::uint64_t{firstBorder_} + packet.borders),
        nextBorder_(firstBorder_) {
    pool_.assign(1, Record{{}, kGone, {}, kNotLeft});
    foreign_.clear();
    free_.resize(std::max(free_.size(), kSpare));
  }

  /// Removes a triangle: `node` becomes its remover and it becomes triangle `at` of the floor.
  /// @return false if the triangle does not exist (a damaged file)
  bool take(Own own, std::uint32_t node, Floor& floor, int at) {
    return pool_[own.record].id == own.id && takeRecord(own.record, 0, node, floor, at);
  }
  /// The same for a border record; `edge` becomes the triangle's edge 0.
  bool takeBorder(std::uint32_t place, unsigned edge, std::uint32_t node, Floor& floor, int at) {
    const Border& border = a_.border[place];
    if (border.id >= a_.roots && border.corners[0] - a_.rootVertices >= node) return false;
    // In a damaged file two packets may remove the same triangle: one of them fails.
    std::uint32_t mark = Arrays::kMarks | place;
    if (!std::atomic_ref(a_.remover[border.id])
             .compare_exchange_strong(mark, node, std::memory_order_relaxed))
      return false;
    std::uint32_t* const words = &floor.words[8 * static_cast<unsigned>(at)];
    for (unsigned i = 0; i < 3; ++i) {
      words[i] = border.corners[edge];
      words[Floor::kAcross + i] = foreignSide(border.across[edge]);
      edge = kNextEdge[edge];
    }
    words[Floor::kId] = border.id;
    return true;
  }
  /// The same for the triangle across an edge of the floor.
  /// @param from  8 * the triangle's number in the floor + its edge
  bool takeAcross(unsigned from, std::uint32_t node, Floor& floor, int at) {
    const Side side = floor.words[from + Floor::kAcross];
    const std::uint32_t begin = floor.words[(from & ~7u) + kNextEdge[from & 3]], end = floor.words[from];
    if ((side & kForeign) == 0) [[likely]] {
      if (!takeRecord(side >> 2, side & 3, node, floor, at)) return false;
      const std::uint32_t* const words = &floor.words[8 * static_cast<unsigned>(at)];
      return words[0] == begin && words[1] == end;
    }
    return side != kNoSide && takeThere(foreign_[side & ~kForeign], begin, end, node, floor, at);
  }

  /// Replaces a node's floor by its star: writes the link and the removers, and updates the front.
  /// @tparam kCorners  corners of the link of a closed star, or 0 for any star
  /// @param staying    bit i: triangle i has no remover
  /// @param left       bit i: the remover of triangle i is in another packet
  /// @return the records of the star's triangles, valid until the next star
  template <int kCorners>
  [[gnu::always_inline]] const std::uint32_t* addStar(std::uint32_t node, std::uint32_t slot,
                                                      const Floor& floor, std::uint64_t staying,
                                                      std::uint64_t left) {
    const auto size = static_cast<std::uint32_t>(kCorners > 0 ? kCorners : floor.corners);
    const bool isOpen = kCorners == 0 && floor.isOpen;
    const std::uint32_t triangles = size - (isOpen ? 1 : 0), apex = a_.rootVertices + node;
    const std::uint32_t id = a_.roots + slot;
    if (freeCount_ < kMaxHoleCorners) moreFree();
    std::uint32_t* const records = records_.data();
    const std::uint32_t* const free = free_.data();
    std::uint32_t freeCount = freeCount_;
    for (std::uint32_t i = 0; i < triangles; ++i, staying >>= 1) {
      const auto stays = static_cast<std::uint32_t>(staying & 1);
      records[i] = free[freeCount - 1] & (stays - 1);
      freeCount -= 1 - stays;
    }
    freeCount_ = freeCount;
    Record* const pool = pool_.data();
    std::uint32_t* const link = a_.link.get() + slot;
    std::uint32_t* const remover = a_.remover.get() + id;
    // Where the star closes: triangle 0 after the last, corner 0 after the last.
    Side before = isOpen ? kNoSide : records[triangles - 1] << 2 | 2;
    std::uint32_t corner = floor.link[0];
    const std::uint32_t afterLast = isOpen ? kNoSide : records[0] << 2;
    for (std::uint32_t i = 0; i < triangles; ++i) {
      const bool isLast = i + 1 == triangles;
      const std::uint32_t nextCorner = floor.link[isLast && !isOpen ? 0 : i + 1], record = records[i];
      const Side across = floor.outer[i];
      Record& r = pool[record];
      r.corners[0] = apex;
      r.corners[1] = corner;
      r.corners[2] = nextCorner;
      r.id = id + i;
      r.across[0] = before;
      r.across[1] = across;
      r.across[2] = isLast ? afterLast : records[i + 1] << 2;
      const auto isLeft = static_cast<std::uint32_t>(left >> i & 1);
      r.border = static_cast<std::uint32_t>(nextBorder_) | (isLeft - 1);
      nextBorder_ += isLeft;
      if ((across & kForeign) == 0) [[likely]]
        pool[across >> 2].across[across & 3] = record << 2 | 1;
      link[i] = corner;
      std::atomic_ref(remover[i]).store(Arrays::kMark | record, std::memory_order_relaxed);
      before = record << 2 | 2;
      corner = nextCorner;
    }
    pool[kStaying].id = kGone;
    if (isOpen) {
      link[triangles] = corner;
      remover[triangles] = node;
      const Side across = floor.outer[triangles];
      if ((across & kForeign) == 0) pool[across >> 2].across[across & 3] = kNoSide;
    }
    std::atomic_ref(a_.slotBegin[node]).store(slot, std::memory_order_relaxed);
    a_.star[node] = static_cast<std::uint8_t>(size | (isOpen ? Arrays::kOpen : 0));
    return records;
  }

  /// After the last node: writes the border records of the triangles that are left to other packets.
  /// @param isWhole  the nodes of all bands were coded, so that no other triangle may remain
  /// @return false if one remains, or the number of those left is not the announced one
  bool finish(bool isWhole) {
    if (nextBorder_ > borderEnd_) return false;
    std::uint32_t there = 0;
    for (const Record& r : pool_) {
      if (r.id == kGone) continue;
      if (r.border == kNotLeft) {
        if (isWhole) return false;
        continue;
      }
      a_.border[r.border] = {
          r.corners, r.id, {idAcross(r.across[0]), idAcross(r.across[1]), idAcross(r.across[2])}};
      std::atomic_ref(a_.remover[r.id]).store(Arrays::kMarks | r.border, std::memory_order_release);
      ++there;
    }
    return there == nextBorder_ - firstBorder_ && (!isWhole || nextBorder_ == borderEnd_);
  }

  void prefetchBorder(std::uint32_t place) const { __builtin_prefetch(&a_.border[place]); }
  /// Prefetches what is around a border record. Fast once the record itself is cached.
  void prefetchAround(std::uint32_t place) const {
    const Border& border = a_.border[place];
    __builtin_prefetch(&a_.remover[border.id], 1);
    for (const std::uint32_t id : border.across)
      if (id < kStays) __builtin_prefetch(&a_.remover[id], 1);
  }
  void prefetch(Own own) const { __builtin_prefetch(&pool_[own.record]); }
  /// Prefetches what is around a record. Fast once the record itself is cached.
  void prefetchAround(Own own) const {
    const Record& r = pool_[own.record];
    for (const Side side : r.across) {
      if ((side & kForeign) == 0)
        __builtin_prefetch(&pool_[side >> 2]);
      else if (side != kNoSide)
        __builtin_prefetch(&a_.remover[foreign_[side & ~kForeign]], 1);
    }
    __builtin_prefetch(&a_.remover[r.id != kGone ? r.id : 0], 1);
  }
  /// Prefetches, for the triangles across, the star of the remover, or the border record. Fast once the
  /// removers are cached.
  void prefetchBeyond(Own own) const {
    for (const Side side : pool_[own.record].across) {
      if ((side & kForeign) == 0 || side == kNoSide) [[likely]]
        continue;
      const std::uint32_t remover = removerOf(foreign_[side & ~kForeign]);
      if (Arrays::isLeft(remover)) {
        prefetchBorder(remover & ~Arrays::kMarks);
      } else if (remover < a_.nodes) {
        // The remover may belong to a packet in progress; then some other slot is prefetched.
        const std::uint32_t slot = std::atomic_ref(a_.slotBegin[remover]).load(std::memory_order_relaxed);
        __builtin_prefetch(&a_.star[remover]);
        __builtin_prefetch(&a_.link[slot]);
        __builtin_prefetch(&a_.remover[a_.roots + slot], 1);
      }
    }
  }

 private:
  static constexpr std::uint32_t kNone = MultiTriangulation::kNone;
  static constexpr std::uint32_t kGone = kNone;       ///< id of a record that is free
  static constexpr std::uint32_t kStays = kNone - 1;  ///< id across: some triangle without a remover
  static constexpr std::uint32_t kStaying = 0;        ///< the dummy record of all of those
  static constexpr std::uint32_t kNotLeft = ~0u;
  static constexpr std::size_t kSpare = 8;

  using Record = FrontSpace::Record;

  /// Adds free records for at least a star.
  [[gnu::noinline]] void moreFree() {
    const auto first = static_cast<std::uint32_t>(pool_.size());
    pool_.resize(first + 4 * kMaxHoleCorners, Record{{}, kGone, {}, kNotLeft});
    // All records may be free, and one more entry is read.
    free_.resize(std::max(free_.size(), pool_.size() + kSpare));
    for (std::uint32_t i = 4 * kMaxHoleCorners; i-- > 0;) free_[freeCount_++] = first + i;
  }

  /// The same for a border record; `edge` becomes the triangle's edge 0.
  bool takeRecord(std::uint32_t record, unsigned edge, std::uint32_t node, Floor& floor, int at) {
    Record& r = pool_[record];
    const std::uint32_t id = r.id;
    if (id == kGone) return false;
    r.id = kGone;
    free_[freeCount_++] = record;
    std::uint32_t* const words = &floor.words[8 * static_cast<unsigned>(at)];
    const unsigned next = kNextEdge[edge], last = kNextEdge[next];
    words[0] = r.corners[edge];
    words[1] = r.corners[next];
    words[2] = r.corners[last];
    words[Floor::kId] = id;
    words[Floor::kAcross] = r.across[edge];
    words[Floor::kAcross + 1] = r.across[next];
    words[Floor::kAcross + 2] = r.across[last];
    std::atomic_ref(a_.remover[id]).store(node, std::memory_order_relaxed);
    return true;
  }
  std::uint32_t idAcross(Side side) const {
    if (side == kNoSide) return kNone;
    if ((side & kForeign) != 0) return foreign_[side & ~kForeign];
    return side >> 2 == kStaying ? kStays : pool_[side >> 2].id;
  }
  Side foreignSide(std::uint32_t id) {
    if (id >= kStays) return id == kNone ? kNoSide : kStaying << 2;
    __builtin_prefetch(&a_.remover[id]);
    foreign_.push_back(id);
    return kForeign | static_cast<Side>(foreign_.size() - 1);
  }
  std::uint32_t removerOf(std::uint32_t id) const {
    return std::atomic_ref(a_.remover[id]).load(std::memory_order_acquire);
  }

  /// Removes the triangle that has the directed edge (from, to) now, which triangle `id` had earlier.
  bool takeThere(std::uint32_t id, std::uint32_t from, std::uint32_t to, std::uint32_t node, Floor& floor,
                 int at) {
    std::uint32_t remover = removerOf(id);
    for (std::uint32_t youngest = 0; (remover & Arrays::kMark) == 0; remover = removerOf(id)) {
      if (remover >= a_.nodes || remover < youngest) return false;
      youngest = remover + 1;
      const std::uint32_t begin = a_.slotBegin[remover], size = a_.starSize(remover);
      const std::uint32_t* const link = a_.link.get() + begin;
      std::uint32_t i = 0;
      while (i < size && link[i] != from) ++i;
      if (i == size || link[i + 1 < size ? i + 1 : 0] != to) return false;
      id = a_.roots + begin + i;
    }
    const std::uint32_t place = remover & ~Arrays::kMarks;
    const bool isLeft = Arrays::isLeft(remover);
    // Only in a damaged file: a record of another packet.
    if (!isLeft && (place >= pool_.size() || pool_[place].id != id)) return false;
    const auto& corners = isLeft ? a_.border[place].corners : pool_[place].corners;
    for (unsigned edge = 0; edge < 3; ++edge)
      if (corners[edge] == from)
        return corners[kNextEdge[edge]] == to &&
               (isLeft ? takeBorder(place, edge, node, floor, at) : takeRecord(place, edge, node, floor, at));
    return false;
  }

  Arrays& a_;
  std::vector<Record>& pool_;
  std::vector<std::uint32_t>& free_;
  std::uint32_t freeCount_ = 0;
  std::array<std::uint32_t, kMaxHoleCorners> records_;  ///< of the last star
  std::vector<std::uint32_t>& foreign_;
  std::uint32_t firstBorder_;
  std::uint64_t borderEnd_, nextBorder_;  ///< in a damaged file they may exceed 32 bits
};

}  // namespace arete::packed

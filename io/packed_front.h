// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The front that a chunk works on while its nodes are read or written. Triangles that the chunk made and that
// are still there have a record: corners, and what lies across each edge, kept up to date as stars replace
// floors. Records of triangles that are gone are used again, so they stay in a cache. While a record is
// there, the triangle's remover is a mark that names the record.
//
// Triangles that other chunks made have none. All that is known of them is what lay across the link's edge
// when their chunk ended (Arrays::outer, never changed afterwards). That triangle may have been removed
// since: then the star that removed it has the edge in its link (the edge is still there), and the triangle
// at that slot is the next one to look at. All nodes on this way are ancestors of whoever asks, so chunks
// that do not lean on each other never look at what the other one writes; in a damaged file they may, and
// then read some value, which is checked before it is used.

#include <array>
#include <atomic>
#include <vector>

#include "io/packed_arrays.h"
#include "io/packed_shapes.h"

namespace arete::packed {

/// What lies across an edge: 4 times a record of the front and which of its edges that is, or a triangle of
/// another chunk, or nothing.
using Side = std::uint32_t;
inline constexpr Side kForeign = 1u << 31;  ///< and the place in the front's list of foreign triangles
inline constexpr Side kNoSide = ~0u;

/// Edge i of a triangle goes from corner i to the next one.
inline constexpr std::array<std::uint8_t, 4> kNextEdge = {1, 2, 0, 0};

/// A node's floor while the node is told.
struct Floor {
  /// 8 numbers a triangle: at 0 its corners, at kId its id, at kAcross what is across its edges.
  static constexpr unsigned kId = 3, kAcross = 4;
  std::array<std::uint32_t, 8 * kMaxFloor> words;
  int size = 0;
  std::array<std::uint32_t, kMaxHoleCorners + 1> link;  ///< the last is for looking ahead
  std::array<Side, kMaxHoleCorners> outer;
  int corners = 0;
  bool isOpen = false;
  bool isAtBorder = false;  ///< there is nothing across an edge of the link

  std::uint32_t id(int triangle) const { return words[8 * static_cast<unsigned>(triangle) + kId]; }
};

/// Memory of a front, to be used again for another one: fresh memory costs time.
struct FrontSpace {
  /// A triangle that the chunk made.
  struct alignas(32) Record {
    std::array<std::uint32_t, 3> corners;
    std::uint32_t id;
    std::array<Side, 3> across;
  };
  std::vector<Record> pool;
  std::vector<std::uint32_t> free;  ///< records that are free, and some spare
  std::vector<Handle> foreign;
};

class Front {
 public:
  /// A triangle that this chunk made.
  struct Own {
    std::uint32_t record, id;
  };

  explicit Front(Arrays& arrays, FrontSpace& space)
      : a_(arrays), pool_(space.pool), free_(space.free), foreign_(space.foreign) {
    pool_.clear();
    foreign_.clear();
    free_.resize(std::max(free_.size(), kSpare));
  }

  /// Takes a triangle away: node `node` removes it, and it is number `at` of the floor. False when it is not
  /// there.
  bool take(Own own, std::uint32_t node, Floor& floor, int at) {
    return pool_[own.record].id == own.id && takeRecord(own.record, 0, node, floor, at);
  }
  bool take(Handle foreign, unsigned edge, std::uint32_t node, Floor& floor, int at) {
    std::uint32_t record = 0;
    if (isOwn(foreign, record)) return takeRecord(record, edge, node, floor, at);
    if (!foreign.isRoot() && foreign.node >= node) return false;
    const std::uint32_t id = a_.idOf(foreign);
    // In a damaged file two chunks may reach for the same triangle: one gets it, and neither one that
    // another chunk is still at work on.
    std::uint32_t nobody = kNone;
    if (!std::atomic_ref(a_.remover[id]).compare_exchange_strong(nobody, node, std::memory_order_acq_rel))
      return false;
    const auto corners = cornersOf(foreign);
    std::uint32_t* const words = &floor.words[8 * static_cast<unsigned>(at)];
    for (unsigned i = 0; i < 3; ++i) {
      words[i] = corners[edge];
      words[Floor::kAcross + i] = foreignSide(across(foreign, static_cast<int>(edge)));
      edge = kNextEdge[edge];
    }
    words[Floor::kId] = id;
    return true;
  }
  /// The same of the triangle across an edge (8 times the triangle's number and the edge) of the floor.
  bool takeAcross(unsigned from, std::uint32_t node, Floor& floor, int at) {
    const Side side = floor.words[from + Floor::kAcross];
    const std::uint32_t begin = floor.words[(from & ~7u) + kNextEdge[from & 3]], end = floor.words[from];
    if ((side & kForeign) == 0) [[likely]] {
      if (!takeRecord(side >> 2, side & 3, node, floor, at)) return false;
      const std::uint32_t* const words = &floor.words[8 * static_cast<unsigned>(at)];
      return words[0] == begin && words[1] == end;
    }
    if (side == kNoSide) return false;
    Handle h = foreign_[side & ~kForeign];
    unsigned edge = 0;
    return resolve(h, begin, end, edge) && take(h, edge, node, floor, at);
  }

  /// Puts a node's star in the place of its floor: the link, the removers and the front. Returns the records
  /// of the star's triangles, valid until one is taken.
  /// kCorners: of the link, whose star is closed; or 0 for any.
  template <int kCorners>
  [[gnu::always_inline]] const std::uint32_t* addStar(std::uint32_t node, std::uint32_t slot,
                                                      const Floor& floor) {
    const auto size = static_cast<std::uint32_t>(kCorners > 0 ? kCorners : floor.corners);
    const bool isOpen = kCorners == 0 && floor.isOpen;
    const std::uint32_t triangles = size - (isOpen ? 1 : 0), apex = a_.rootVertices + node;
    const std::uint32_t id = a_.roots + slot;
    if (freeCount_ < kMaxHoleCorners) moreFree();
    freeCount_ -= triangles;
    const std::uint32_t* const records = free_.data() + freeCount_;
    Record* const pool = pool_.data();
    std::uint32_t* const link = a_.link.get() + slot;
    std::uint32_t* const remover = a_.remover.get() + id;
    // Where the star closes: triangle 0 after the last, corner 0 after the last.
    Side before = isOpen ? kNoSide : records[triangles - 1] << 2 | 2;
    std::uint32_t corner = floor.link[0];
    for (std::uint32_t i = 0; i < triangles; ++i) {
      const std::uint32_t nextCorner = floor.link[i + 1], record = records[i];
      const Side across = floor.outer[i];
      Record& r = pool[record];
      r.corners[0] = apex;
      r.corners[1] = corner;
      r.corners[2] = nextCorner;
      r.id = id + i;
      r.across[0] = before;
      r.across[1] = across;
      r.across[2] = records[i + 1] << 2;
      if ((across & kForeign) == 0) [[likely]]
        pool[across >> 2].across[across & 3] = record << 2 | 1;
      link[i] = corner;
      std::atomic_ref(remover[i]).store(kMark | record, std::memory_order_relaxed);
      before = record << 2 | 2;
      corner = nextCorner;
    }
    Record& last = pool[records[triangles - 1]];
    if (isOpen) {
      last.across[2] = kNoSide;
      link[triangles] = corner;
      remover[triangles] = node;
      const Side across = floor.outer[triangles];
      if ((across & kForeign) == 0) pool[across >> 2].across[across & 3] = kNoSide;
    } else {
      last.across[2] = records[0] << 2;
      last.corners[2] = floor.link[0];
    }
    a_.slotBegin[node] = slot;
    a_.star[node] = static_cast<std::uint8_t>(size | (isOpen ? Arrays::kOpen : 0));
    return records;
  }

  /// After the last node: what other chunks may ask for.
  void finish() {
    for (std::uint32_t i = 0; i < pool_.size(); ++i) {
      const Record& r = pool_[i];
      if (r.id == kGone) continue;
      const Side side = r.across[1];
      a_.outer[r.id - a_.roots] = side == kNoSide          ? Handle{}
                                  : (side & kForeign) != 0 ? foreign_[side & ~kForeign]
                                                           : handleOf(pool_[side >> 2]);
      std::atomic_ref(a_.remover[r.id]).store(kNone, std::memory_order_release);
    }
  }

  void prefetch(Handle foreign) const {
    __builtin_prefetch(&a_.remover[a_.idOf(foreign)], 1);
    if (foreign.isRoot()) return;
    __builtin_prefetch(&a_.outer[foreign.slot]);
    __builtin_prefetch(&a_.link[foreign.slot]);
    __builtin_prefetch(&a_.slotBegin[foreign.node]);
    __builtin_prefetch(&a_.star[foreign.node]);
  }
  void prefetch(Own own) const { __builtin_prefetch(&pool_[own.record]); }
  /// Once the record itself is there.
  void prefetchAround(Own own) const {
    const Record& r = pool_[own.record];
    for (const Side side : r.across) {
      if ((side & kForeign) == 0)
        __builtin_prefetch(&pool_[side >> 2]);
      else if (side != kNoSide)
        prefetch(foreign_[side & ~kForeign]);
    }
    __builtin_prefetch(&a_.remover[r.id != kGone ? r.id : 0], 1);
  }
  /// Once it is known who removed what lay across: the star that has the edge now.
  void prefetchBeyond(Own own) const {
    for (const Side side : pool_[own.record].across) {
      if ((side & kForeign) == 0 || side == kNoSide) [[likely]]
        continue;
      const std::uint32_t remover = removerOf(foreign_[side & ~kForeign]);
      if (remover >= a_.nodes) continue;
      __builtin_prefetch(&a_.star[remover]);
      __builtin_prefetch(&a_.link[a_.slotBegin[remover]]);
      __builtin_prefetch(&a_.remover[a_.roots + a_.slotBegin[remover]], 1);
    }
  }

 private:
  static constexpr std::uint32_t kNone = MultiTriangulation::kNone;
  static constexpr std::uint32_t kMark = 1u << 31;  ///< of removers; nodes are fewer
  static constexpr std::uint32_t kGone = kNone;     ///< id of a record that is free
  static constexpr std::size_t kSpare = 8;

  using Record = FrontSpace::Record;

  /// Enough for a star.
  [[gnu::noinline]] void moreFree() {
    const auto first = static_cast<std::uint32_t>(pool_.size());
    pool_.resize(first + 4 * kMaxHoleCorners, Record{{}, kGone, {}});
    // Every record may be free, and one more is looked at.
    free_.resize(std::max(free_.size(), pool_.size() + kSpare));
    for (std::uint32_t i = 4 * kMaxHoleCorners; i-- > 0;) free_[freeCount_++] = first + i;
  }

  /// `edge` becomes the triangle's edge 0.
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
  Handle handleOf(const Record& r) const { return {r.corners[0] - a_.rootVertices, r.id - a_.roots}; }

  bool isOwn(Handle h, std::uint32_t& record) const {
    const std::uint32_t mark = removerOf(h);
    record = mark & ~kMark;
    return mark != kNone && (mark & kMark) != 0 && record < pool_.size() && pool_[record].id == a_.idOf(h);
  }
  Side foreignSide(Handle h) {
    // In a damaged file a chunk may see what another one has half written.
    if (h.slot >= (h.isRoot() ? a_.roots : a_.slots) || (!h.isRoot() && h.node >= a_.nodes)) return kNoSide;
    __builtin_prefetch(&a_.remover[a_.idOf(h)]);
    foreign_.push_back(h);
    return kForeign | static_cast<Side>(foreign_.size() - 1);
  }

  std::uint32_t removerOf(Handle h) const {
    return std::atomic_ref(a_.remover[a_.idOf(h)]).load(std::memory_order_relaxed);
  }
  std::array<std::uint32_t, 3> cornersOf(Handle h) const {
    if (h.isRoot()) return a_.rootTriangles[h.slot];
    const std::uint32_t begin = a_.slotBegin[h.node], end = begin + a_.starSize(h.node);
    return {a_.rootVertices + h.node, a_.link[h.slot], a_.link[h.slot + 1 < end ? h.slot + 1 : begin]};
  }
  /// What was across an edge of a triangle of another chunk.
  Handle across(Handle h, int edge) const {
    if (h.isRoot()) return a_.rootOuter[3 * std::size_t{h.slot} + static_cast<unsigned>(edge)];
    if (edge == 1) return a_.outer[h.slot];
    const std::uint32_t begin = a_.slotBegin[h.node], size = a_.starSize(h.node);
    const std::uint32_t end = begin + size - (a_.isOpen(h.node) ? 1 : 0);
    const bool isOpen = a_.isOpen(h.node);
    if (edge == 0) {
      if (h.slot > begin) return {h.node, h.slot - 1};
      return isOpen ? Handle{} : Handle{h.node, end - 1};
    }
    if (h.slot + 1 < end) return {h.node, h.slot + 1};
    return isOpen ? Handle{} : Handle{h.node, begin};
  }
  /// The triangle there now that has the directed edge (from, to), and which of its edges that is.
  bool resolve(Handle& h, std::uint32_t from, std::uint32_t to, unsigned& edge) const {
    std::uint32_t remover = removerOf(h);
    if ((remover & kMark) != 0) {
      const auto corners = cornersOf(h);
      for (edge = 0; edge < 3; ++edge)
        if (corners[edge] == from) return corners[kNextEdge[edge]] == to;
      return false;
    }
    edge = 1;
    for (std::uint32_t youngest = 0;;) {
      if (remover >= a_.nodes || remover < youngest) return false;
      youngest = remover;
      const std::uint32_t begin = a_.slotBegin[remover], size = a_.starSize(remover);
      const std::uint32_t* link = a_.link.get() + begin;
      std::uint32_t i = 0;
      while (i < size && link[i] != from) ++i;
      if (i == size || link[i + 1 < size ? i + 1 : 0] != to) return false;
      h = {remover, begin + i};
      const std::uint32_t next = removerOf(h);
      if ((next & kMark) != 0) return true;
      if (next == remover) return false;
      remover = next;
    }
  }

  Arrays& a_;
  std::vector<Record>& pool_;
  std::vector<std::uint32_t>& free_;
  std::uint32_t freeCount_ = 0;
  std::vector<Handle>& foreign_;
};

}  // namespace arete::packed

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The front that a chunk works on while its nodes are read or written. Triangles that the chunk made and that
// are still there have a record: corners, and what lies across each edge, kept up to date as stars replace
// floors. Records of triangles that are gone are used again, so they stay in a cache.
//
// Triangles that other chunks made have none. All that is known of them is what lay across the link's edge
// when their chunk ended (Arrays::outer, never changed afterwards). That triangle may have been removed
// since: then the star that removed it has the edge in its link (the edge is still there), and the triangle
// at that slot is the next one to look at. All nodes on this way are ancestors of whoever asks, so chunks
// that do not lean on each other never look at what the other one writes; in a damaged file they may, and
// then read some value, which is checked before it is used.

#include <array>
#include <atomic>
#include <cmath>
#include <vector>

#include "io/packed_arrays.h"
#include "terrain/hole.h"

namespace arete::packed {

inline constexpr int kMaxFloor = kMaxHoleCorners - 2;

/// What lies across an edge: a record of the front, or a triangle of another chunk, or nothing.
using Side = std::uint32_t;
inline constexpr Side kForeign = 1u << 31;  ///< and the place in the front's list of foreign triangles
inline constexpr Side kNoSide = ~0u;

/// Edge i of a triangle goes from corner i to the next one.
inline constexpr std::array<std::uint8_t, 3> kNextEdge = {1, 2, 0};

/// A triangle of a floor.
struct FloorTriangle {
  std::array<std::uint32_t, 3> corners;
  std::array<Side, 3> across;
  std::uint32_t id;
  double doubledArea;
};

struct Floor {
  std::array<FloorTriangle, kMaxFloor> triangles;
  int size = 0;
  std::array<std::uint32_t, kMaxHoleCorners + 1> link;  ///< addStar() repeats the first at the end
  std::array<Side, kMaxHoleCorners> outer;
  int corners = 0;
  double sumX = 0, sumY = 0;  ///< of the link's corners
  bool isOpen = false;
  double doubledArea = 0;
};

class Front {
 public:
  /// A triangle that this chunk made.
  struct Own {
    std::uint32_t record, id;
  };

  Front(Arrays& arrays, std::uint32_t nodes) : a_(arrays) {
    grow(std::min(2 * nodes, 1u << 16) + 2 * kSpare);
  }

  /// Takes triangles away: node `node` removes them. False when they are not there.
  bool take(Own own, std::uint32_t node, FloorTriangle& to) {
    if (pool_[own.record].id != own.id) return false;
    return takeRecord(own.record, node, to);
  }
  bool take(Handle foreign, std::uint32_t node, FloorTriangle& to) {
    std::uint32_t record = 0;
    if (isOwn(foreign, record)) return takeRecord(record, node, to);
    const std::uint32_t id = a_.idOf(foreign);
    // In a damaged file two chunks may reach for the same triangle: one gets it, and neither one that
    // another chunk is still at work on.
    std::uint32_t nobody = kNone;
    if (!std::atomic_ref(a_.remover[id]).compare_exchange_strong(nobody, node, std::memory_order_acq_rel))
      return false;
    if (!foreign.isRoot() && a_.outer[foreign.slot].slot == kRecordMark) return false;
    to.id = id;
    to.corners = cornersOf(foreign);
    for (int e = 0; e < 3; ++e) to.across[e] = foreignSide(across(foreign, e));
    measure(to);
    return true;
  }
  /// The triangle across an edge of one that was taken, and which of its edges that is.
  bool takeAcross(const FloorTriangle& from, int edge, std::uint32_t node, FloorTriangle& to, int& there) {
    const Side side = from.across[edge];
    const std::uint32_t begin = from.corners[kNextEdge[edge]], end = from.corners[edge];
    if ((side & kForeign) == 0) {
      const Record& r = pool_[side];
      const unsigned isOne = r.corners[1] == begin, isTwo = r.corners[2] == begin;
      there = static_cast<int>(isOne | (isTwo & ~isOne) << 1);
      if (r.corners[there] != begin || r.corners[kNextEdge[there]] != end) return false;
      return takeRecord(side, node, to);
    }
    if (side == kNoSide) return false;
    Handle h = foreign_[side & ~kForeign];
    return resolve(h, begin, end, there) && take(h, node, to);
  }

  /// Puts a node's star in the place of its floor: the link, the removers and the front. Writes the records
  /// of the star's triangles.
  void addStar(std::uint32_t node, std::uint32_t slot, Floor& floor, std::uint32_t* records) {
    const auto size = static_cast<std::uint32_t>(floor.corners);
    const std::uint32_t triangles = size - (floor.isOpen ? 1 : 0), apex = a_.rootVertices + node;
    const std::uint32_t id = a_.roots + slot;
    if (used_ + kSpare > pool_.size()) grow(2 * pool_.size());
    std::uint32_t freeCount = freeCount_, used = used_;
    std::uint32_t* const free = free_.data();
    while (freeCount < triangles) free[freeCount++] = used++;
    freeCount -= triangles;
    freeCount_ = freeCount;
    used_ = used;
    for (std::uint32_t i = 0; i < triangles; ++i) records[i] = free[freeCount + i];
    Record* const pool = pool_.data();
    std::uint32_t* const link = a_.link.get() + slot;
    std::uint32_t* const remover = a_.remover.get() + id;
    Handle* const outer = a_.outer.get() + slot;
    floor.link[size] = floor.link[0];
    Side before = floor.isOpen ? kNoSide : records[triangles - 1];
    records[triangles] = floor.isOpen ? kNoSide : records[0];
    std::uint32_t corner = floor.link[0], record = records[0];
    for (std::uint32_t i = 0; i < triangles; ++i) {
      const std::uint32_t nextCorner = floor.link[i + 1], nextRecord = records[i + 1];
      const Side across = floor.outer[i];
      pool[record] = {{apex, corner, nextCorner}, {before, across, nextRecord}, id + i, 1};
      joinBack(pool, across, nextCorner, record);
      link[i] = corner;
      outer[i] = {record, kRecordMark};
      std::atomic_ref(remover[i]).store(kNone, std::memory_order_release);
      before = record;
      record = nextRecord;
      corner = nextCorner;
    }
    if (floor.isOpen) {
      link[triangles] = corner;
      remover[triangles] = node;
      outer[triangles] = {};
      joinBack(pool, floor.outer[triangles], floor.link[0], kNoSide);
    }
    a_.slotBegin[node] = slot;
    a_.star[node] = static_cast<std::uint8_t>(size | (floor.isOpen ? Arrays::kOpen : 0));
  }

  /// After the last node: what other chunks may ask for.
  void finish() {
    for (std::uint32_t i = 0; i < used_; ++i) {
      const Record& r = pool_[i];
      if (r.isThere == 0) continue;
      const Side side = r.across[1];
      a_.outer[r.id - a_.roots] = side == kNoSide          ? Handle{}
                                  : (side & kForeign) != 0 ? foreign_[side & ~kForeign]
                                                           : Handle{pool_[side].corners[0] - a_.rootVertices,
                                                                    pool_[side].id - a_.roots};
    }
  }

  void prefetch(Own own) const { __builtin_prefetch(&pool_[own.record]); }
  /// Once the record itself is there.
  void prefetchAround(Own own) const {
    const Record& r = pool_[own.record];
    __builtin_prefetch(&a_.remover[r.id]);
    for (const std::uint32_t v : r.corners) __builtin_prefetch(&a_.place[v]);
    for (const Side side : r.across) __builtin_prefetch(&pool_[(side & kForeign) == 0 ? side : 0]);
  }

 private:
  static constexpr std::uint32_t kNone = MultiTriangulation::kNone;
  static constexpr std::uint32_t kRecordMark = kNone - 1;  ///< in Handle::slot: the node is a record
  static constexpr std::size_t kSpare = 2 * kMaxHoleCorners;

  struct Record {
    std::array<std::uint32_t, 3> corners;
    std::array<Side, 3> across;
    std::uint32_t id, isThere;
  };

  void grow(std::size_t size) {
    pool_.resize(size);
    free_.resize(size);
  }

  bool takeRecord(std::uint32_t record, std::uint32_t node, FloorTriangle& to) {
    Record& r = pool_[record];
    if (r.isThere == 0) return false;
    r.isThere = 0;
    free_[freeCount_++] = record;
    to.corners = r.corners;
    to.across = r.across;
    to.id = r.id;
    std::atomic_ref(a_.remover[r.id]).store(node, std::memory_order_relaxed);
    measure(to);
    return true;
  }
  void measure(FloorTriangle& t) const {
    const Arrays::Place* const place = a_.place.get();
    const Arrays::Place &p = place[t.corners[0]], &q = place[t.corners[1]], &r = place[t.corners[2]];
    t.doubledArea = std::fabs((q.x - p.x) * (r.y - p.y) - (r.x - p.x) * (q.y - p.y));
  }
  /// Tells the triangle across the edge that begins there at `corner` who is its neighbour now.
  static void joinBack(Record* pool, Side side, std::uint32_t corner, Side neighbour) {
    if ((side & kForeign) != 0) return;
    Record& r = pool[side];
    const unsigned isOne = r.corners[1] == corner, isTwo = r.corners[2] == corner;
    r.across[isOne | (isTwo & ~isOne) << 1] = neighbour;
  }

  bool isOwn(Handle h, std::uint32_t& record) const {
    if (h.isRoot()) return false;
    const Handle mark = a_.outer[h.slot];
    record = mark.node;
    return mark.slot == kRecordMark && record < used_ && pool_[record].id == a_.idOf(h);
  }
  Side foreignSide(Handle h) {
    // In a damaged file a chunk may see what another one has half written.
    if (h.slot >= (h.isRoot() ? a_.roots : a_.slots) || (!h.isRoot() && h.node >= a_.nodes)) return kNoSide;
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
  bool resolve(Handle& h, std::uint32_t from, std::uint32_t to, int& edge) const {
    std::uint32_t remover = removerOf(h);
    if (remover == kNone) {
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
      if (next == kNone) return true;
      if (next == remover) return false;
      remover = next;
    }
  }

  Arrays& a_;
  std::vector<Record> pool_;
  std::vector<std::uint32_t> free_;
  std::uint32_t used_ = 0, freeCount_ = 0;
  std::vector<Handle> foreign_;
};

}  // namespace arete::packed

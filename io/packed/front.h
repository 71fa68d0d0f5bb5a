// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// The front that a chunk works on while its nodes are read or written. Triangles that the chunk made and that
// are still to be removed have a record: corners, and what lies across each edge, kept up to date as stars
// replace floors. Records of triangles that are gone are used again, so they stay in a cache. While a record
// is there, the triangle's remover is a mark that names the record. Triangles that nobody removes (of the
// finest triangulation: one in three) are known when they are made; nobody asks for them, so they share one
// record, which says nothing. Known then are also those that are left to other chunks.
//
// Triangles that other chunks made and left have a border record instead (Arrays::border), made when their
// chunk ended and never changed afterwards. What it says of a triangle across may have been removed since:
// then the star that removed it has the edge in its link (the edge is still there), and the triangle at that
// slot is the next one to look at. All nodes on this way are ancestors of whoever asks, so chunks that do not
// lean on each other never look at what the other one writes, but to ask for it ahead; in a damaged file they
// may, and then read some value, which is checked before it is used. A mark that names a border record is
// written after the record.

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <vector>

#include "io/packed/arrays.h"
#include "io/packed/shapes.h"

namespace arete::packed {

/// What lies across an edge: 4 times a record of the front and which of its edges that is, or a triangle of
/// another chunk (or what was there, see above), or nothing.
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
    std::uint32_t border;  ///< its place in Arrays::border, if it is left to others
  };
  std::vector<Record> pool;
  std::vector<std::uint32_t> free;     ///< records that are free, and some spare
  std::vector<std::uint32_t> foreign;  ///< ids
};

class Front {
 public:
  /// A triangle that this chunk made.
  struct Own {
    std::uint32_t record, id;
  };

  /// So many records, and the foreign triangles across their edges, can be numbered.
  static constexpr std::uint64_t kMostRecords = (std::uint64_t{1} << 29) - 256;
  /// Whether a chunk of so many nodes has no more: a star has two triangles more than its floor, and those of
  /// a floor have no record where they are other chunks'.
  static bool canHold(std::uint64_t nodes, std::uint64_t borders) {
    return 2 * nodes + std::min(kMaxFloor * nodes, borders) <= kMostRecords;
  }

  Front(Arrays& arrays, const Chunk& chunk, FrontSpace& space)
      : a_(arrays),
        pool_(space.pool),
        free_(space.free),
        foreign_(space.foreign),
        firstBorder_(static_cast<std::uint32_t>(a_.roots + chunk.firstBorder)),
        borderEnd_(std::uint64_t{firstBorder_} + chunk.borders),
        nextBorder_(firstBorder_) {
    pool_.assign(1, Record{{}, kGone, {}, kNotLeft});
    foreign_.clear();
    free_.resize(std::max(free_.size(), kSpare));
  }

  /// Takes a triangle away: node `node` removes it, and it is number `at` of the floor. False when it is not
  /// there.
  bool take(Own own, std::uint32_t node, Floor& floor, int at) {
    return pool_[own.record].id == own.id && takeRecord(own.record, 0, node, floor, at);
  }
  /// `edge` becomes the triangle's edge 0.
  bool takeBorder(std::uint32_t place, unsigned edge, std::uint32_t node, Floor& floor, int at) {
    const Border& border = a_.border[place];
    if (border.id >= a_.roots && border.corners[0] - a_.rootVertices >= node) return false;
    // In a damaged file two chunks may reach for the same triangle: one gets it.
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
  /// The same of the triangle across an edge (8 times the triangle's number and the edge) of the floor.
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

  /// Puts a node's star in the place of its floor: the link, the removers and the front. Returns the records
  /// of the star's triangles, valid until the next star.
  /// kCorners: of the link, whose star is closed; or 0 for any. staying: bit i says that nobody removes
  /// triangle i; left: that another chunk does.
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

  /// After the last node: what other chunks may ask for. `isWhole`: the nodes of all bands were told, so that
  /// nothing else is there still. False when it is not so, some of what is left has gone, or it is not as
  /// much as announced.
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
  /// Once the border record itself is there.
  void prefetchAround(std::uint32_t place) const {
    const Border& border = a_.border[place];
    __builtin_prefetch(&a_.remover[border.id], 1);
    for (const std::uint32_t id : border.across)
      if (id < kStays) __builtin_prefetch(&a_.remover[id], 1);
  }
  void prefetch(Own own) const { __builtin_prefetch(&pool_[own.record]); }
  /// Once the record itself is there.
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
  /// Once it is known who removed what lay across, or that nobody did: the star that has the edge now, or the
  /// triangle's border record.
  void prefetchBeyond(Own own) const {
    for (const Side side : pool_[own.record].across) {
      if ((side & kForeign) == 0 || side == kNoSide) [[likely]]
        continue;
      const std::uint32_t remover = removerOf(foreign_[side & ~kForeign]);
      if (Arrays::isLeft(remover)) {
        prefetchBorder(remover & ~Arrays::kMarks);
      } else if (remover < a_.nodes) {
        // It may be of a chunk that is at work, as nobody has asked for it yet: some slot is asked for then.
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
  static constexpr std::uint32_t kStays = kNone - 1;  ///< id across: some triangle that nobody removes
  static constexpr std::uint32_t kStaying = 0;        ///< the record of all of those, which says nothing
  static constexpr std::uint32_t kNotLeft = ~0u;
  static constexpr std::size_t kSpare = 8;

  using Record = FrontSpace::Record;

  /// Enough for a star.
  [[gnu::noinline]] void moreFree() {
    const auto first = static_cast<std::uint32_t>(pool_.size());
    pool_.resize(first + 4 * kMaxHoleCorners, Record{{}, kGone, {}, kNotLeft});
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

  /// Takes the triangle that has the directed edge (from, to) now, where triangle `id` had it.
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
    // A record of another chunk that is still at work, or its last triangle: in a damaged file.
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
  std::uint64_t borderEnd_, nextBorder_;  ///< a damaged file may leave more than 32 bits can number
};

}  // namespace arete::packed

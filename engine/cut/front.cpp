// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle is in the front when its creator is in the cut and its remover is not: one test per slot of the
// cut's nodes, no graph walk. Members are processed in spans: a first pass marks the slots of each that are
// kept, a sum over the spans determines where each writes, a second pass writes the marked slots. The order
// is that of the triangle ids, whatever the thread count.
//
// Every vertex that a node of the cut inserts is in the front, so the front's vertices are the root's and one
// per member, in the order of the members.
//
// Members are sparse and their stars are scattered over memory: both passes prefetch some members ahead. The
// number of slots of a member, and how many of them it keeps, are unpredictable, so neither pass has a loop
// with that trip count.
#include "engine/cut/front.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cassert>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "engine/base/vector_clones.h"
#include "engine/memory/pages.h"
#include "engine/parallel/parallel_loops.h"

namespace arete {
namespace {

constexpr std::uint32_t kAhead = 16;

/// The positions of the ones of a byte, rising, then zeros.
constexpr auto kOnes = [] {
  std::array<std::array<std::uint32_t, 8>, 256> ones{};
  for (unsigned byte = 0; byte < 256; ++byte)
    for (std::uint32_t bit = 0, count = 0; bit < 8; ++bit)
      if (byte >> bit & 1) ones[byte][count++] = bit;
  return ones;
}();

template <class Lookup>
class FrontWriter {
 public:
  FrontWriter(const MultiTriangulation& mt, const MemberSet& set, const Lookup& in)
      : set_(set),
        in_(in),
        roots_(mt.rootTriangleCount()),
        rootVertices_(mt.rootVertexCount()),
        slots_(mt.slotTotal()),
        slotBegin_(mt.arrays().slotBegin.data()),
        link_(mt.arrays().link.data()),
        remover_(mt.arrays().remover.data() + roots_),
        error_(mt.arrays().error.data() + roots_),
        kept_(std::make_unique_for_overwrite<std::uint16_t[]>(set.size())) {}

  struct Marked {
    std::uint32_t kept = 0;  ///< slots
    std::uint32_t open = 0;  ///< members with an open star
  };
  /// Marks the slots that the members of a span keep.
  ARETE_VECTOR_CLONES
  Marked mark(std::uint32_t span) const {
    std::array<std::uint32_t, MemberSet::kMostInSpan + 2 * kAhead> members;
    const std::uint32_t count = list(span, members.data());
    const std::uint32_t *const slotBegin = slotBegin_, *const removers = remover_;
    std::uint16_t* const kept = kept_.get() + set_.before(span);
    std::uint32_t total = 0, open = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      __builtin_prefetch(slotBegin + members[i + 2 * kAhead]);
      __builtin_prefetch(removers + slotBegin[members[i + kAhead]]);
      const std::uint32_t end = slotBegin[members[i] + 1];
      const std::uint64_t bits = keptBy(slotBegin[members[i]], end);
      kept[i] = static_cast<std::uint16_t>(bits);
      total += static_cast<std::uint32_t>(std::popcount(bits));
      open += static_cast<std::uint32_t>(removers[end - 1] == members[i]);
    }
    return {total, open};
  }

  /// Writes the marked slots, and the vertices of the members.
  /// @return The largest code of the errors.
  ARETE_VECTOR_CLONES
  std::uint16_t write(std::uint32_t span, std::uint32_t* vertices, std::array<std::uint32_t, 3>* triangles,
                      std::uint32_t* ids) const {
    std::array<std::uint32_t, MemberSet::kMostInSpan + 2 * kAhead> members;
    const std::uint32_t count = list(span, members.data()), before = set_.before(span);
    const std::uint32_t* const slotBegin = slotBegin_;
    const std::uint16_t* const kept = kept_.get() + before;
    for (std::uint32_t i = 0; i < count; ++i) vertices[before + i] = rootVertices_ + members[i];

    std::uint16_t worst = 0;
    Some some;
    std::uint32_t waiting = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t ahead = slotBegin[members[i + kAhead]];
      __builtin_prefetch(link_ + ahead);
      __builtin_prefetch(error_ + ahead);
      const std::uint32_t begin = slotBegin[members[i]], end = slotBegin[members[i] + 1];
      waiting = add(some, waiting, end - begin <= kMostMarked ? kept[i] : keptBy(begin, end), begin, end,
                    rootVertices_ + before + i);
      if (waiting < Some::kEnough && i + 1 < count) continue;
      worst = std::max(worst, write(some, waiting, triangles, ids));
      triangles += waiting;
      ids += waiting;
      waiting = 0;
    }
    return worst;
  }

 private:
  static constexpr std::uint32_t kMostMarked = 16, kMostSlots = 64;
  /// Slots that nearly every member has: tested without a branch, whether they exist or not.
  static constexpr std::uint32_t kFew = 6;

  /// Slots to be written, in order, each with the next slot around its star and the star's apex among the
  /// vertices of the front. A full list has room for one more member, and for the surplus that add() writes.
  struct Some {
    static constexpr std::uint32_t kEnough = 256, kMost = kEnough + kMostSlots + 8;
    std::array<std::uint32_t, kMost> slot, next, apex;
  };

  /// Appends the slots begin + i of the bits i, eight at a time: all eight are written, only those with bits
  /// are counted.
  /// @return The new count.
  [[gnu::always_inline]] static std::uint32_t add(Some& some, std::uint32_t count, std::uint64_t bits,
                                                  std::uint32_t begin, std::uint32_t end,
                                                  std::uint32_t apex) {
    for (std::uint32_t first = begin;; first += 8) {
      const std::array<std::uint32_t, 8> ones = kOnes[bits & 0xFF];
      std::uint32_t *const slot = &some.slot[count], *const next = &some.next[count],
                           *const of = &some.apex[count];
#pragma GCC unroll 1
      for (std::uint32_t k = 0; k < 8; ++k) slot[k] = first + ones[k];
#pragma GCC unroll 1
      for (std::uint32_t k = 0; k < 8; ++k) {
        const std::uint32_t s = first + 1 + ones[k];
        next[k] = s == end ? begin : s;
      }
#pragma GCC unroll 1
      for (std::uint32_t k = 0; k < 8; ++k) of[k] = apex;
      count += static_cast<std::uint32_t>(std::popcount(bits & 0xFF));
      bits >>= 8;
      if (bits == 0) return count;
    }
  }

  /// Bit i: the triangle of slot begin + i is kept.
  [[gnu::always_inline]] std::uint64_t keptBy(std::uint32_t begin, std::uint32_t end) const {
    const Lookup in = in_;
    const std::uint32_t* const removers = remover_;
    const std::uint32_t slots = end - begin;
    assert(slots <= kMostSlots);
    const auto isGone = [&](std::uint32_t s) { return std::uint64_t(in.contains(removers[begin + s])); };
    std::uint64_t gone = 0;  // a slot that is no triangle is removed by its own node
    if (slots_ - begin < kFew) [[unlikely]] {
      for (std::uint32_t s = slots; s-- > 0;) gone = 2 * gone + isGone(s);
    } else {
      for (std::uint32_t s = slots; s > kFew;) gone = 2 * gone + isGone(--s);
      for (std::uint32_t s = kFew; s > 0;) gone = 2 * gone + isGone(--s);
    }
    return ~gone & ~std::uint64_t(0) >> (kMostSlots - slots);
  }

  [[gnu::always_inline]] std::uint16_t write(const Some& some, std::uint32_t count,
                                             std::array<std::uint32_t, 3>* triangles,
                                             std::uint32_t* ids) const {
    const std::uint32_t* const link = link_;
    const std::uint16_t* const errors = error_;
    const std::uint32_t roots = roots_, rootVertices = rootVertices_;
    const Lookup in = in_;
    // The index of an MT vertex among those of the front.
    const auto indexOf = [&](std::uint32_t v) {
      return v < rootVertices ? v : rootVertices + in.rank(v - rootVertices);
    };
    std::uint16_t worst = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      triangles[i] = {some.apex[i], indexOf(link[some.slot[i]]), indexOf(link[some.next[i]])};
      ids[i] = roots + some.slot[i];
      worst = std::max(worst, errors[some.slot[i]]);
    }
    return worst;
  }

  /// The members of the span, the last one repeated for prefetching ahead.
  std::uint32_t list(std::uint32_t span, std::uint32_t* members) const {
    const std::uint32_t count = set_.list(span, members);
    std::fill_n(members + count, 2 * kAhead, members[count - 1]);
    return count;
  }

  const MemberSet& set_;
  const Lookup in_;
  const std::uint32_t roots_, rootVertices_, slots_;
  const std::uint32_t *const slotBegin_, *const link_, *const remover_;
  const std::uint16_t* const error_;
  const std::unique_ptr<std::uint16_t[]>
      kept_;  // per member: a bit per kept slot, if it has at most kMostMarked
};

/// @return Nothing if the set must be closed and is not. (A member adds two triangles, one on a border, if
/// members or the root created all that it replaces, and more otherwise.)
template <class Lookup>
std::optional<Cut> writeFront(const MultiTriangulation& mt, const MemberSet& set, const Lookup& in,
                              bool mustBeClosed) {
  const MtArrays& a = mt.arrays();
  const std::uint32_t roots = mt.rootTriangleCount(), rootVertices = mt.rootVertexCount();
  const FrontWriter writer(mt, set, in);
  Cut cut;
  cut.nodes = set.size();

  // begin[p + 1]: where span p writes; the root comes first. Members add at most two triangles each: memory
  // for so many is allocated while they are counted.
  std::vector<std::uint32_t> begin(std::size_t(set.spans()) + 2, 0);
  const std::size_t most = roots + 2 * std::size_t(set.size());
  std::atomic<std::uint32_t> open = 0;
  const auto makeRoom = [](auto& empty, std::size_t size) {
    reserveInPages(empty, size);
    empty.resize(size);
  };
  parallelInvoke(
      [&] {
        for (std::uint32_t t = 0; t < roots; ++t) begin[1] += in.contains(a.remover[t]) ? 0 : 1;
        parallelFor(std::uint32_t(0), set.spans(), [&](std::uint32_t span) {
          const auto marked = writer.mark(span);
          begin[span + 2] = marked.kept;
          open.fetch_add(marked.open, std::memory_order_relaxed);
        });
      },
      [&] { makeRoom(cut.triangles, most); },
      [&] {
        makeRoom(cut.ids, most);
        makeRoom(cut.vertices, std::size_t(rootVertices) + set.size());
      });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  if (mustBeClosed && begin.back() != most - open) return std::nullopt;
  cut.triangles.resize(begin.back());
  cut.ids.resize(begin.back());

  std::iota(cut.vertices.begin(), cut.vertices.begin() + rootVertices, 0u);
  std::vector<std::uint16_t> worst(std::size_t(set.spans()) + 1, 0);
  std::uint32_t at = 0;
  for (std::uint32_t t = 0; t < roots; ++t) {
    if (in.contains(a.remover[t])) continue;
    cut.triangles[at] = a.rootTriangles[t];
    cut.ids[at++] = t;
    worst[0] = std::max(worst[0], a.error[t]);
  }
  parallelFor(std::uint32_t(0), set.spans(), [&](std::uint32_t span) {
    const std::uint32_t to = begin[span + 1];
    worst[span + 1] = writer.write(span, cut.vertices.data() + rootVertices, cut.triangles.data() + to,
                                   cut.ids.data() + to);
  });
  cut.achievedError = a.scale.decode(*std::max_element(worst.begin(), worst.end()));
  return cut;
}

std::optional<Cut> writeFront(const MultiTriangulation& mt, const MemberSet& set, bool mustBeClosed) {
  return set.isDense() ? writeFront(mt, set, set.denseLookup(), mustBeClosed)
                       : writeFront(mt, set, set.lookup(), mustBeClosed);
}

}  // namespace

std::uint64_t frontSize(const MultiTriangulation& mt, const MemberSet& set) {
  std::uint64_t triangles = mt.rootTriangleCount();
  set.visit([&](std::uint32_t n) { triangles += mt.isOpen(NodeId(n)) ? 1 : 2; });
  return triangles;
}

Cut frontOf(const MultiTriangulation& mt, const MemberSet& set) {
  return *writeFront(mt, set, false);
}

Cut frontOfClosure(const MultiTriangulation& mt, const MemberSet& set) {
  std::optional<Cut> cut = writeFront(mt, set, true);
  if (cut) return std::move(*cut);
  NodeSet closed = set.toNodeSet(mt.nodeCount());
  closeUpwards(mt, closed);
  return frontOf(mt, MemberSet(closed));
}

}  // namespace arete

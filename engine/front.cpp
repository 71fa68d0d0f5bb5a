// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle is in the front when its creator is in the cut and its remover is not: one test per slot of the
// cut's nodes, no graph walk. Members are handled in pieces: a first pass marks which slots of each are kept,
// a sum over the pieces gives each its place, a second pass writes what is marked. The order is that of the
// triangle ids, whatever the thread count.
//
// Every vertex that a node of the cut inserts is in the front, so the front's vertices are the root's and one
// per member, in the order of the members.
//
// The members of a place are few among many, and their stars lie wherever they lie: both passes ask for the
// memory of a member some members ahead.
#include "engine/front.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <memory>
#include <numeric>

#include "engine/vector_clones.h"

namespace arete {
namespace {

constexpr std::uint32_t kAhead = 8;

class FrontWriter {
 public:
  FrontWriter(const MultiTriangulation& mt, const MemberSet& set)
      : set_(set),
        in_(set.lookup()),
        roots_(mt.rootTriangleCount()),
        rootVertices_(mt.rootVertexCount()),
        slotBegin_(mt.arrays().slotBegin.data()),
        link_(mt.arrays().link.data()),
        remover_(mt.arrays().remover.data() + roots_),
        error_(mt.arrays().error.data() + roots_),
        kept_(std::make_unique_for_overwrite<std::uint64_t[]>(set.size())) {}

  /// Marks the slots that members of the piece keep, and names their vertices. Returns the number of slots.
  ARETE_VECTOR_CLONES
  std::uint32_t mark(std::uint32_t piece, std::uint32_t* vertices) const {
    std::array<std::uint32_t, MemberSet::kMostInPiece + 2 * kAhead> members;
    const std::uint32_t count = list(piece, members.data()), before = set_.before(piece);
    const MemberSet::Lookup in = in_;
    const std::uint32_t *const slotBegin = slotBegin_, *const removers = remover_;
    std::uint64_t* const kept = kept_.get() + before;
    vertices += before;
    std::uint32_t total = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      __builtin_prefetch(slotBegin + members[i + 2 * kAhead]);
      __builtin_prefetch(removers + slotBegin[members[i + kAhead]]);
      const std::uint32_t n = members[i], first = slotBegin[n], slots = slotBegin[n + 1] - first;
      assert(slots <= 64);
      std::uint64_t gone = 0;  // a slot that is no triangle is removed by its own node
      for (std::uint32_t s = 0; s < slots; ++s) gone |= std::uint64_t(in.contains(removers[first + s])) << s;
      kept[i] = ~gone & ~std::uint64_t(0) >> (64 - slots);
      vertices[i] = rootVertices_ + n;
      total += static_cast<std::uint32_t>(std::popcount(kept[i]));
    }
    return total;
  }

  /// Writes what mark() marked. Returns the largest code of its errors.
  ARETE_VECTOR_CLONES
  std::uint16_t write(std::uint32_t piece, std::array<std::uint32_t, 3>* triangle, std::uint32_t* id) const {
    std::array<std::uint32_t, MemberSet::kMostInPiece + 2 * kAhead> members;
    const std::uint32_t count = list(piece, members.data()), before = set_.before(piece);
    const std::uint32_t *const slotBegin = slotBegin_, *const link = link_;
    const std::uint16_t* const errors = error_;
    const std::uint64_t* const kept = kept_.get() + before;
    std::uint16_t worst = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t ahead = slotBegin[members[i + kAhead]];
      __builtin_prefetch(link + ahead);
      __builtin_prefetch(errors + ahead);
      const std::uint32_t n = members[i], first = slotBegin[n], last = slotBegin[n + 1] - 1;
      for (std::uint64_t left = kept[i]; left != 0; left &= left - 1) {
        const std::uint32_t s = first + static_cast<std::uint32_t>(std::countr_zero(left));
        *triangle++ = {rootVertices_ + before + i, place(link[s]), place(link[s < last ? s + 1 : first])};
        *id++ = roots_ + s;
        worst = std::max(worst, errors[s]);
      }
    }
    return worst;
  }

 private:
  /// The members of the piece, and the last of them some times more for those who look ahead.
  std::uint32_t list(std::uint32_t piece, std::uint32_t* members) const {
    const std::uint32_t count = set_.list(piece, members);
    std::fill_n(members + count, 2 * kAhead, members[count - 1]);
    return count;
  }
  /// Of an MT vertex among those of the front.
  std::uint32_t place(std::uint32_t v) const {
    return v < rootVertices_ ? v : rootVertices_ + in_.rank(v - rootVertices_);
  }

  const MemberSet& set_;
  const MemberSet::Lookup in_;
  const std::uint32_t roots_, rootVertices_;
  const std::uint32_t *const slotBegin_, *const link_, *const remover_;
  const std::uint16_t* const error_;
  const std::unique_ptr<std::uint64_t[]> kept_;  // a bit per slot, by member
};

}  // namespace

Cut frontOf(const MultiTriangulation& mt, const MemberSet& set) {
  const MtArrays& a = mt.arrays();
  const std::uint32_t roots = mt.rootTriangleCount(), rootVertices = mt.rootVertexCount();
  const MemberSet::Lookup in = set.lookup();
  const FrontWriter writer(mt, set);
  Cut cut;
  cut.nodes = set.size();
  cut.vertices.resize(std::size_t(rootVertices) + set.size());
  std::iota(cut.vertices.begin(), cut.vertices.begin() + rootVertices, 0u);

  // begin[p + 1]: where piece p writes; the root comes first.
  std::vector<std::uint32_t> begin(std::size_t(set.pieces()) + 2, 0);
  for (std::uint32_t t = 0; t < roots; ++t) begin[1] += in.contains(a.remover[t]) ? 0 : 1;
  tbb::parallel_for(std::uint32_t(0), set.pieces(), [&](std::uint32_t piece) {
    begin[piece + 2] = writer.mark(piece, cut.vertices.data() + rootVertices);
  });
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  cut.triangles.resize(begin.back());
  cut.ids.resize(begin.back());

  std::vector<std::uint16_t> worst(std::size_t(set.pieces()) + 1, 0);
  std::uint32_t at = 0;
  for (std::uint32_t t = 0; t < roots; ++t) {
    if (in.contains(a.remover[t])) continue;
    cut.triangles[at] = a.rootTriangles[t];
    cut.ids[at++] = t;
    worst[0] = std::max(worst[0], a.error[t]);
  }
  tbb::parallel_for(std::uint32_t(0), set.pieces(), [&](std::uint32_t piece) {
    const std::uint32_t to = begin[piece + 1];
    worst[piece + 1] = writer.write(piece, cut.triangles.data() + to, cut.ids.data() + to);
  });
  cut.achievedError = a.scale.decode(*std::max_element(worst.begin(), worst.end()));
  return cut;
}

Cut frontOfPrefix(const MultiTriangulation& mt, std::uint32_t nodes) {
  return frontOf(mt, MemberSet::prefix(nodes));
}

Cut front(const MultiTriangulation& mt, const NodeSet& closed) {
  return frontOf(mt, MemberSet(closed));
}

}  // namespace arete

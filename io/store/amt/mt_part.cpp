// SPDX-License-Identifier: GPL-3.0-or-later
//
// A subset is copied in two passes over the words of the set. The first counts the slots of each word, from
// which the first slot of each node follows. The second copies; vertices, removers and triangles get new
// numbers by the rank of the node that they belong to. A remover outside the set becomes
// MultiTriangulation::kNone. A vertex or a triangle of a node outside the set is an error, because the
// parents of a node create its floor and the vertices of its link are corners of the floor.
//
// Every index is compared with the sizes of the arrays before it is used.
#include "io/store/amt/mt_part.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <memory>
#include <vector>

#include "engine/memory/uninitialized_vector.h"
#include "engine/mt/hole_limit.h"
#include "engine/mt/node_blocks.h"
#include "engine/parallel/parallel_loops.h"
#include "io/store/format/schema.h"

namespace arete {
namespace {

constexpr std::size_t kGrain = std::size_t{1} << 14;

/// The slots of a node.
struct Slots {
  std::uint32_t begin = 0, size = 0;  // 0: the arrays are damaged
};

Slots slotsOf(const MtArrays& a, std::uint32_t n) {
  const std::uint32_t begin = a.slotBegin[n], end = a.slotBegin[n + 1];
  if (end > a.link.size() || begin > end || end - begin < 3 || end - begin > std::uint32_t{kMaxHoleCorners})
    return {};
  // Floors begin two triangles a node before slots.
  if (begin < 3 * std::uint64_t{n} || end - 2 * (std::uint64_t{n} + 1) > a.floor.size()) return {};
  return {begin, end - begin};
}

/// The node that owns a slot; MultiTriangulation::kNone if the arrays are damaged.
std::uint32_t ownerOf(const MtArrays& a, std::uint32_t slot) {
  if (slot >= a.link.size()) return MultiTriangulation::kNone;
  const std::uint32_t hint = a.creatorHint[slot / MultiTriangulation::kSlotsPerHint];
  const std::uint64_t nodes = a.saturatedError.size();
  for (std::uint64_t n = hint; n < std::min(nodes, std::uint64_t{hint} + MultiTriangulation::kSlotsPerHint);
       ++n)
    if (a.slotBegin[n] <= slot && slot < a.slotBegin[n + 1]) return static_cast<std::uint32_t>(n);
  return MultiTriangulation::kNone;
}

/// MtArrays::missing, of a number of triangles.
std::vector<std::uint64_t> noneMissing(std::size_t triangles) {
  return std::vector<std::uint64_t>((triangles + 63) / 64, 0);
}
void markMissing(std::vector<std::uint64_t>& missing, std::size_t triangle) {
  std::atomic_ref(missing[triangle / 64])
      .fetch_or(std::uint64_t{1} << triangle % 64, std::memory_order_relaxed);
}

struct PrefixArrays {
  MultiTriangulation whole;
  UninitializedVector<std::uint32_t> remover;
  std::vector<std::uint64_t> missing;
  NodeBlocks blocks;
};

/// A column whose elements are copied as they are.
struct CopiedColumn {
  AmtMtColumn column;
  std::span<const std::byte> from;
  std::size_t size;  // of an element
  UninitializedVector<std::byte> to = {};

  void resize(std::size_t elements) { to.resize(elements * size); }
  void copy(std::size_t begin, std::size_t at, std::size_t elements) {
    std::memcpy(to.data() + at * size, from.data() + begin * size, elements * size);
  }
};

/// Columns that have an element for the same things.
struct CopiedColumns {
  std::vector<CopiedColumn> columns;

  /// The columns of an MT that say nothing of other elements.
  static CopiedColumns of(const MtArrays& a, AmtPer per, std::size_t elements) {
    CopiedColumns copied;
    for (const AmtMtColumn& column : amtMtColumns(a))
      if (column.coding != AmtCoding::walked && column.per == per) {
        copied.columns.push_back({column, column.mt.bytes(a), column.elementBytes()});
        copied.columns.back().resize(elements);
      }
    return copied;
  }
  void copy(std::size_t from, std::size_t at, std::size_t count) {
    for (CopiedColumn& column : columns) column.copy(from, at, count);
  }
  void putInto(MtArrays& a) const {
    for (const CopiedColumn& copied : columns) copied.column.mt.put(a, copied.to);
  }
};

struct SubsetArrays {
  MultiTriangulation whole;  // whose root it shares
  UninitializedVector<std::uint32_t> slotBegin, link, remover, floor, creatorHint;
  CopiedColumns ofTriangles, ofNodes, ofVertices;
  std::vector<std::uint64_t> missing;
  NodeBlocks blocks;

  MultiTriangulation model(std::shared_ptr<const void> owner) {
    MtArrays a = whole.arrays();
    a.slotBegin = slotBegin;
    a.link = link;
    a.remover = remover;
    a.floor = floor;
    a.creatorHint = creatorHint;
    for (const CopiedColumns* copied : {&ofTriangles, &ofNodes, &ofVertices}) copied->putInto(a);
    blocks = makeNodeBlocks(a.saturatedError, a.sphere);
    a.blockError = blocks.error;
    a.blockSphere = blocks.sphere;
    a.missing = missing;
    return {a, std::move(owner)};
  }
};

/// Copies a subset.
class SubsetCopy {
 public:
  SubsetCopy(const MultiTriangulation& whole, const RankedNodes& nodes)
      : whole_(whole),
        a_(whole.arrays()),
        roots_(whole.rootTriangleCount()),
        nodes_(nodes),
        to_(std::make_shared<SubsetArrays>()) {}

  MtSubset run() {
    countSlots();
    if (isDamaged_) return {MtSubset::Problem::damaged, {}};
    allocate();
    copyRoot();
    forWords([&](std::size_t word) { beginSlots(word); });
    to_->slotBegin[nodes_.size()] = slots_;
    forWords([&](std::size_t word) { nodes_.visitWord(word, [&](std::uint32_t n) { copy(n); }); });
    if (isDamaged_) return {MtSubset::Problem::damaged, {}};
    if (isParentMissing_) return {MtSubset::Problem::parentMissing, {}};
    return {MtSubset::Problem::none, to_->model(to_)};
  }

 private:
  template <class Work>
  void forWords(const Work& work) const {
    constexpr std::size_t kWords = 64;
    parallelFor(IndexRange<std::size_t>(0, nodes_.wordCount(), kWords), [&](const auto& range) {
      for (std::size_t word = range.begin(); word < range.end(); ++word) work(word);
    });
  }

  void countSlots() {
    slotsBefore_.resize(nodes_.wordCount());
    forWords([&](std::size_t word) {
      std::uint32_t count = 0;
      nodes_.visitWord(word, [&](std::uint32_t n) {
        const std::uint32_t size = slotsOf(a_, n).size;
        if (size == 0) isDamaged_ = true;
        count += size;
      });
      slotsBefore_[word] = count;
    });
    std::uint64_t before = 0;
    for (std::uint32_t& slots : slotsBefore_) {
      const std::uint32_t mine = slots;
      slots = static_cast<std::uint32_t>(before);
      before += mine;
    }
    // In damaged arrays the slots of nodes may overlap and be more than there are.
    if (before > a_.link.size()) isDamaged_ = true;
    slots_ = static_cast<std::uint32_t>(before);
  }

  void allocate() {
    const std::size_t nodes = nodes_.size(), ids = std::size_t{roots_} + slots_;
    SubsetArrays& to = *to_;
    to.whole = whole_;
    to.slotBegin.resize(nodes + 1);
    to.link.resize(slots_);
    to.remover.resize(ids);
    to.missing = noneMissing(ids);
    to.floor.resize(slots_ - 2 * nodes);
    to.creatorHint.resize((std::size_t{slots_} + MultiTriangulation::kSlotsPerHint - 1) /
                          MultiTriangulation::kSlotsPerHint);
    // Columns that hold no ids are copied as they are.
    to.ofTriangles = CopiedColumns::of(a_, AmtPer::triangle, ids);
    to.ofNodes = CopiedColumns::of(a_, AmtPer::node, nodes);
    to.ofVertices = CopiedColumns::of(a_, AmtPer::vertex, a_.rootVertices + nodes);
  }

  void copyRoot() {
    // The root is in every subset, with the same numbers.
    for (std::uint32_t t = 0; t < roots_; ++t)
      copyRemover(t, t, MultiTriangulation::kNone, MultiTriangulation::kNone);
    to_->ofTriangles.copy(0, 0, roots_);
    to_->ofVertices.copy(0, 0, a_.rootVertices);
  }

  void beginSlots(std::size_t word) {
    std::uint32_t rank = nodes_.rankOfWord(word), begin = slotsBefore_[word];
    nodes_.visitWord(word, [&](std::uint32_t n) {
      to_->slotBegin[rank++] = begin;
      begin += slotsOf(a_, n).size;
    });
  }

  void copy(std::uint32_t n) {
    SubsetArrays& to = *to_;
    const std::uint32_t rank = nodes_.rankOf(n), begin = to.slotBegin[rank];
    const Slots slots = slotsOf(a_, n);
    for (std::uint32_t i = 0; i < slots.size; ++i) {
      to.link[begin + i] = vertexOf(a_.link[slots.begin + i]);
      copyRemover(roots_ + slots.begin + i, roots_ + begin + i, n, rank);
    }
    to.ofTriangles.copy(std::size_t{roots_} + slots.begin, std::size_t{roots_} + begin, slots.size);
    const std::uint32_t floor = slots.begin - 2 * n;
    for (std::uint32_t i = 0; i < slots.size - 2; ++i)
      to.floor[begin - 2 * rank + i] = triangleOf(a_.floor[floor + i]);
    to.ofNodes.copy(n, rank, 1);
    to.ofVertices.copy(std::size_t{a_.rootVertices} + n, std::size_t{a_.rootVertices} + rank, 1);
    // A hint names the node that owns every kSlotsPerHint-th slot.
    const std::uint64_t end = std::uint64_t{begin} + slots.size;
    for (std::uint64_t hint = (std::uint64_t{begin} + MultiTriangulation::kSlotsPerHint - 1) /
                              MultiTriangulation::kSlotsPerHint;
         hint * MultiTriangulation::kSlotsPerHint < end; ++hint)
      to.creatorHint[hint] = rank;
  }

  /// The remover of a triangle of node `creator`, whose new number is `rank`.
  void copyRemover(std::uint32_t from, std::uint32_t t, std::uint32_t creator, std::uint32_t rank) {
    const std::uint32_t r = a_.remover[from];
    std::uint32_t remover = MultiTriangulation::kNone;
    if (r != MultiTriangulation::kNone && r == creator)
      remover = rank;
    else if (r < a_.saturatedError.size() && nodes_.contains(r))
      remover = nodes_.rankOf(r);
    else if (r != MultiTriangulation::kNone)
      markMissing(to_->missing, t);
    to_->remover[t] = remover;
  }

  std::uint32_t vertexOf(std::uint32_t v) {
    if (v < a_.rootVertices) return v;
    const std::uint32_t n = v - a_.rootVertices;
    return isMember(n) ? a_.rootVertices + nodes_.rankOf(n) : 0;
  }

  std::uint32_t triangleOf(std::uint32_t t) {
    if (t < roots_) return t;
    const std::uint32_t slot = t - roots_, n = ownerOf(a_, slot);
    if (!isMember(n)) return 0;
    return roots_ + to_->slotBegin[nodes_.rankOf(n)] + (slot - a_.slotBegin[n]);
  }

  bool isMember(std::uint32_t n) {
    if (n < a_.saturatedError.size() && nodes_.contains(n)) return true;
    (n < a_.saturatedError.size() ? isParentMissing_ : isDamaged_) = true;
    return false;
  }

  const MultiTriangulation& whole_;
  const MtArrays& a_;
  std::uint32_t roots_;
  const RankedNodes& nodes_;
  std::shared_ptr<SubsetArrays> to_;
  std::vector<std::uint32_t> slotsBefore_;  // of each word
  std::uint32_t slots_ = 0;
  std::atomic<bool> isDamaged_ = false, isParentMissing_ = false;
};

}  // namespace

std::optional<MultiTriangulation> prefixOfMt(const MultiTriangulation& whole, std::uint32_t nodes) {
  if (nodes == whole.nodeCount()) return whole;
  MtArrays a = whole.arrays();
  const std::uint64_t slots = a.slotBegin[nodes], ids = a.rootTriangles.size() + slots;
  if (slots > a.link.size() || slots < 3 * std::uint64_t{nodes} ||
      slots - 2 * std::uint64_t{nodes} > a.floor.size())
    return std::nullopt;
  const auto arrays = std::make_shared<PrefixArrays>();
  arrays->whole = whole;
  arrays->remover.resize(ids);
  arrays->missing = noneMissing(ids);
  parallelFor(IndexRange<std::size_t>(0, ids, kGrain), [&](const auto& range) {
    for (std::size_t t = range.begin(); t < range.end(); ++t) {
      const bool isHere = a.remover[t] < nodes;
      arrays->remover[t] = isHere ? a.remover[t] : MultiTriangulation::kNone;
      if (!isHere && a.remover[t] != MultiTriangulation::kNone) markMissing(arrays->missing, t);
    }
  });
  const auto copyBlocks = [&](std::uint64_t first, std::uint64_t count) {
    const auto from = static_cast<std::ptrdiff_t>(first), size = static_cast<std::ptrdiff_t>(count);
    auto& blocks = arrays->blocks;
    blocks.error.insert(blocks.error.end(), a.blockError.begin() + from, a.blockError.begin() + from + size);
    blocks.sphere.insert(blocks.sphere.end(), a.blockSphere.begin() + from,
                         a.blockSphere.begin() + from + size);
  };
  copyBlocks(0, nodes / MultiTriangulation::kNodesPerBlock);
  copyBlocks(nodeBlockCount(whole.nodeCount()), nodes / MultiTriangulation::kNodesPerPage);
  AmtFacts facts;
  facts.counts = {a.rootVertices, a.rootTriangles.size(), nodes, slots};
  for (const AmtMtColumn& column : amtMtColumns(a))
    if (column.per != AmtPer::block)
      column.mt.put(a, column.mt.bytes(a).first(amtCountOf(column.per, facts) * column.elementBytes()));
  a.remover = arrays->remover;
  a.missing = arrays->missing;
  a.blockError = arrays->blocks.error;
  a.blockSphere = arrays->blocks.sphere;
  return MultiTriangulation(a, arrays);
}

MtSubset subsetOfMt(const MultiTriangulation& whole, const RankedNodes& nodes) {
  return SubsetCopy(whole, nodes).run();
}

bool addParents(const MultiTriangulation& whole, RankedNodes& nodes) {
  const MtArrays& a = whole.arrays();
  const std::uint32_t roots = whole.rootTriangleCount();
  // Parents have smaller numbers, so one pass from the last node to the first suffices.
  for (std::uint32_t n = whole.nodeCount(); n-- > 0;) {
    if (n % RankedNodes::kNodesPerWord == RankedNodes::kNodesPerWord - 1 &&
        nodes.word(n / RankedNodes::kNodesPerWord) == 0) {
      n -= RankedNodes::kNodesPerWord - 1;
      continue;
    }
    if (!nodes.contains(n)) continue;
    const Slots slots = slotsOf(a, n);
    if (slots.size == 0) return false;
    const std::uint32_t floor = slots.begin - 2 * n;
    for (std::uint32_t i = floor; i < floor + slots.size - 2; ++i) {
      if (a.floor[i] < roots) continue;
      const std::uint32_t parent = ownerOf(a, a.floor[i] - roots);
      if (parent >= n) return false;
      nodes.add(parent);
    }
  }
  return true;
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Node n is a member if and only if its saturated error exceeds the error that the criterion allows over its
// sphere. A parent's saturated error and sphere contain its child's (law 6), so the set is closed
// [LindstromPascucci2002].
//
// A uniform error is compared by code: all nodes of higher bands are members, none of lower bands is, and
// only those of its own band are tested.
//
// With a budget the members are taken by falling ratio of the two errors, parents first, so that every prefix
// of that order is closed too. For a uniform error it is the order of the codes, and a count of triangles per
// code finds the code at which the budget ends.
#include "engine/cut/saturated_cut.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/base/vector_clones.h"
#include "engine/mt/node_blocks.h"
#include "engine/parallel/parallel_sort.h"

namespace arete {
namespace {

using Code = OutwardScale::Code;
constexpr std::uint32_t kPerWord = MemberSet::kNodesPerWord;
constexpr std::uint32_t kGroupsPerRun = 4;

std::uint32_t added(const MultiTriangulation& mt, std::uint32_t n) {
  return mt.isOpen(NodeId(n)) ? 1 : 2;
}

/// The nodes before `end` for which isIn(n), of which those before `certain` are known to be.
template <class IsIn>
MemberSet membersFor(std::uint32_t certain, std::uint32_t end, const IsIn& isIn) {
  return MemberSet(certain, end, kGroupsPerRun,
                   [&](std::uint32_t first, std::uint32_t last, MemberSet::Sink& sink) {
                     for (std::uint32_t word = first; word < last; ++word) {
                       std::uint64_t bits = 0;
                       const std::uint32_t from = word * kPerWord, to = std::min(end, from + kPerWord);
                       for (std::uint32_t n = from; n < to; ++n) bits |= std::uint64_t(isIn(n)) << (n - from);
                       sink.put(word, bits);
                     }
                   });
}

/// The nodes of a larger code, and these of the code itself, rising.
MemberSet uniformMembers(const MultiTriangulation& mt, Code code, const std::vector<std::uint32_t>& ofCode) {
  const auto& saturated = mt.arrays().saturatedError;
  const std::uint32_t band = MultiTriangulation::bandOf(code);
  return membersFor(mt.bandBegin(band), mt.bandEnd(band), [&](std::uint32_t n) {
    return saturated[n] > code || (saturated[n] == code && std::ranges::binary_search(ofCode, n));
  });
}

/// The nodes of a code that a budget has room for, rising. Each comes behind its parents of this code, and
/// among as many generations of them in the order of places, so that the result does not depend on how nodes
/// are numbered.
std::vector<std::uint32_t> firstOfCode(const MultiTriangulation& mt, Code code, std::uint32_t budget) {
  const auto& saturated = mt.arrays().saturatedError;
  const std::uint32_t band = MultiTriangulation::bandOf(code);
  struct Tie {
    std::uint32_t generation;
    Vec3 place;
    std::uint32_t node;
    auto order() const { return std::tie(generation, place.x, place.y, place.z, node); }
  };
  std::vector<Tie> ties;
  for (std::uint32_t n = mt.bandBegin(band); n < mt.bandEnd(band); ++n) {
    if (saturated[n] != code) continue;
    std::uint32_t generation = 0;
    for (const std::uint32_t t : mt.floor(NodeId(n))) {
      const NodeId parent = mt.creator(TriangleId(t));
      if (!parent.isValid() || saturated[parent.index()] != code) continue;
      // A file whose errors break law 6 may have the parent elsewhere.
      const auto at = std::ranges::lower_bound(ties, parent.index(), {}, &Tie::node);
      if (at != ties.end() && at->node == parent.index())
        generation = std::max(generation, at->generation + 1);
    }
    ties.push_back({generation, mt.position(mt.apex(NodeId(n))), n});
  }
  std::ranges::sort(ties, {}, &Tie::order);
  std::vector<std::uint32_t> first;
  for (const Tie& tie : ties) {
    if (added(mt, tie.node) > budget) break;
    budget -= added(mt, tie.node);
    first.push_back(tie.node);
  }
  std::ranges::sort(first);
  return first;
}

SaturatedMembers uniformCut(const MultiTriangulation& mt, double maxError,
                            std::optional<std::uint32_t> maxTriangles) {
  const auto& saturated = mt.arrays().saturatedError;
  const Code code = mt.scale().floorCode(maxError);
  if (!maxTriangles) return {uniformMembers(mt, code, {}), true};
  const std::uint32_t end = mt.bandEnd(MultiTriangulation::bandOf(code));
  std::vector<std::uint32_t> addedBy(std::size_t(OutwardScale::kMaxCode) + 1, 0);
  for (std::uint32_t n = 0; n < end; ++n) addedBy[saturated[n]] += added(mt, n);
  std::uint32_t left = *maxTriangles - mt.rootTriangleCount();
  Code last = OutwardScale::kMaxCode;  // of which only some may fit
  for (; last > code && addedBy[last] <= left; --last) left -= addedBy[last];
  if (last == code) return {uniformMembers(mt, code, {}), true};
  return {uniformMembers(mt, last, firstOfCode(mt, last, left)), false};
}

/// Searches from cluster groups to clusters to nodes, and descends only where there may be members. Accesses
/// are random, so memory is prefetched some steps ahead.
class SphereSearch {
 public:
  SphereSearch(const MultiTriangulation& mt, const BoundedCriterion& criterion)
      : a_(mt.arrays()),
        criterion_(criterion),
        nodes_(mt.nodeCount()),
        clusters_(static_cast<std::uint32_t>(nodeBlockCount(nodes_))) {}

  MemberSet members() const {
    return MemberSet(
        0, nodes_, kGroupsPerRun,
        [&](std::uint32_t first, std::uint32_t last, MemberSet::Sink& sink) { search(first, last, sink); });
  }

 private:
  static constexpr std::uint32_t kPerCluster = MultiTriangulation::kNodesPerBlock,
                                 kClustersPerGroup = MultiTriangulation::kNodesPerPage / kPerCluster,
                                 kGroupsPerRun = 64, kClustersAhead = 2;
  static_assert(kPerCluster == kPerWord && kClustersPerGroup == MemberSet::kWordsPerGroup);

  /// A list of groups or clusters, at most as many as a run has.
  struct List {
    std::array<std::uint32_t, kGroupsPerRun * kClustersPerGroup> at;
    std::uint32_t count = 0;
    void add(std::uint32_t first, std::uint64_t bits) {
      for (; bits != 0; bits &= bits - 1)
        at[count++] = first + static_cast<std::uint32_t>(std::countr_zero(bits));
    }
  };

  std::uint64_t exceeding(std::span<const Sphere> spheres, std::span<const Code> codes, std::uint32_t begin,
                          std::uint32_t count) const {
    std::array<float, 64> errors;
    decode(codes.data() + begin, count, errors.data());
    return criterion_.exceeding(spheres.subspan(begin, count), std::span(errors).first(count));
  }

  ARETE_VECTOR_CLONES
  void decode(const Code* codes, std::uint32_t count, float* errors) const {
    const OutwardScale scale = a_.scale;
    for (std::uint32_t i = 0; i < count; ++i) errors[i] = scale.decode(codes[i]);
  }

  void search(std::uint32_t firstCluster, std::uint32_t lastCluster, MemberSet::Sink& sink) const {
    const std::uint32_t from = firstCluster / kClustersPerGroup,
                        to = (lastCluster + kClustersPerGroup - 1) / kClustersPerGroup;
    List groups, clusters;
    groups.add(from, exceeding(a_.blockSphere, a_.blockError, clusters_ + from, to - from));
    for (std::uint32_t i = 0; i < groups.count; ++i)
      prefetch(a_.blockSphere, a_.blockError, groups.at[i] * kClustersPerGroup, kClustersPerGroup);
    for (std::uint32_t i = 0; i < groups.count; ++i) {
      const std::uint32_t first = groups.at[i] * kClustersPerGroup;
      clusters.add(first, exceeding(a_.blockSphere, a_.blockError, first,
                                    std::min(kClustersPerGroup, clusters_ - first)));
    }
    for (std::uint32_t i = 0; i < clusters.count; ++i) {
      if (i + kClustersAhead < clusters.count)
        prefetch(a_.sphere, a_.saturatedError, clusters.at[i + kClustersAhead] * kPerCluster, kPerCluster);
      const std::uint32_t begin = clusters.at[i] * kPerCluster;
      sink.put(clusters.at[i],
               exceeding(a_.sphere, a_.saturatedError, begin, std::min(kPerCluster, nodes_ - begin)));
    }
  }

  // Inlined by force: GCC drops calls of functions that only prefetch.
  [[gnu::always_inline]] static void prefetch(std::span<const Sphere> spheres, std::span<const Code> codes,
                                              std::uint32_t begin, std::uint32_t count) {
    constexpr std::uint32_t kLine = 64;
    count = std::min(count, static_cast<std::uint32_t>(spheres.size()) - begin);
    for (std::uint32_t i = 0; i < count; i += kLine / sizeof(Sphere))
      __builtin_prefetch(spheres.data() + begin + i);
    for (std::uint32_t i = 0; i < count; i += kLine / sizeof(Code))
      __builtin_prefetch(codes.data() + begin + i);
  }

  const MtArrays& a_;
  const BoundedCriterion& criterion_;
  const std::uint32_t nodes_, clusters_;
};

}  // namespace

SaturatedMembers saturatedMembers(const MultiTriangulation& mt, const BoundedCriterion& criterion,
                                  std::optional<std::uint32_t> maxTriangles) {
  if (const auto uniform = criterion.uniformError()) return uniformCut(mt, *uniform, maxTriangles);
  const MtArrays& a = mt.arrays();
  const auto error = [&](std::uint32_t n) { return double(a.scale.decode(a.saturatedError[n])); };
  MemberSet members = SphereSearch(mt, criterion).members();
  if (!maxTriangles) return {std::move(members), true};

  // By falling error in units of the error allowed; equal ones by index.
  std::vector<std::pair<double, std::uint32_t>> order;
  order.reserve(members.size());
  members.visit([&](std::uint32_t n) {
    const double allowed = criterion.allowedError(a.sphere[n]);
    order.emplace_back(allowed > 0 ? -error(n) / allowed : -std::numeric_limits<double>::infinity(), n);
  });
  parallelSort(order.begin(), order.end());
  std::uint64_t triangles = mt.rootTriangleCount();
  std::size_t kept = 0;
  for (; kept < order.size(); ++kept) {
    triangles += added(mt, order[kept].second);
    if (triangles > *maxTriangles) break;
  }
  if (kept == order.size()) return {std::move(members), true};
  std::vector<std::uint32_t> in;
  for (std::size_t i = 0; i < kept; ++i) in.push_back(order[i].second);
  std::ranges::sort(in);
  return {MemberSet(in, mt.nodeCount()), false};
}

}  // namespace arete

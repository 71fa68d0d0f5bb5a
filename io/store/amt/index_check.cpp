// SPDX-License-Identifier: GPL-3.0-or-later
//
// The arrays are checked in the order in which they depend on each other: slotBegin first, because all
// per-node ranges follow from it. Every check is a predicate over a range of nodes, triangles or vertices,
// evaluated in parallel; the smallest culprit is reported, as a sequential run would.
//
// Removers and floors are inverse to each other: a floor id must be removed by the node that lists it, no
// node lists an id twice, and there are as many removed triangles as floor ids. removers() checks that a
// remover is younger than the creator, so the triangles of a floor are older than its node without a further
// check.
//
// The time goes into memory accesses: the triangles of a node's floor lie in stars all over the arrays.
// Floors are stored one after the other, so the reads of the next ones are prefetched, with the creators from
// a table (slot_to_node.h). A quick branch-free test passes nearly all sound nodes; the full test decides on
// the others and words the problem.
#include "io/store/amt/index_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "engine/base/counted.h"
#include "engine/mt/hole_limit.h"
#include "engine/mt/node_blocks.h"
#include "engine/parallel/first_bad.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"
#include "io/store/format/schema.h"
#include "io/store/format/slot_to_node.h"

namespace arete {
namespace {

constexpr std::uint32_t kBlock = 1 << 14;

class MtIndexCheck {
 public:
  MtIndexCheck(const MultiTriangulation& mt, std::uint64_t gridSamples, const RunContext& context)
      : context_(context),
        mt_(mt),
        a_(mt.arrays()),
        gridSamples_(gridSamples),
        nodes_(mt_.nodeCount()),
        roots_(mt_.rootTriangleCount()),
        slots_(static_cast<std::uint32_t>(a_.link.size())) {}

  Status run() {
    // A check relies on those before it, so the first failure ends the run.
    using Step = Status (MtIndexCheck::*)() const;
    constexpr Step steps[] = {&MtIndexCheck::slotBegin,  &MtIndexCheck::rootTriangles, &MtIndexCheck::links,
                              &MtIndexCheck::hints,      &MtIndexCheck::removers,      &MtIndexCheck::floors,
                              &MtIndexCheck::nodeValues, &MtIndexCheck::parents,       &MtIndexCheck::blocks,
                              &MtIndexCheck::vertices};
    for (std::size_t i = 0; i < std::size(steps); ++i) {
      context_.report("check indices", static_cast<double>(i) / std::size(steps));
      Status status = (this->*steps[i])();
      if (context_.cancelled()) return failure(ErrorCode::interrupted, "the check was interrupted");
      if (!status) return status;
    }
    context_.report("check indices", 1);
    return {};
  }

 private:
  template <class IsBad>
  std::optional<std::uint32_t> firstBad(std::size_t size, const IsBad& isBad) const {
    return arete::firstBad(size, context_, isBad);
  }

  Status refuse(const AmtTag& tag, const std::string& what) const {
    return failure(ErrorCode::corrupt,
                   fmt::format("chunk {}: {}", std::string_view(tag.data(), tag.size()), what));
  }

  /// The first slot of node n for which isBad(slot). Precondition: there is one.
  template <class IsBad>
  std::uint32_t slotOf(std::uint32_t n, const IsBad& isBad) const {
    std::uint32_t s = a_.slotBegin[n];
    while (!isBad(s)) ++s;
    return s;
  }

  Status slotBegin() const {
    if (a_.slotBegin[0] != 0) return refuse(amt_tag::kSlotBegin, "the first slot is not 0");
    const auto bad = firstBad(nodes_, [&](std::uint32_t n) {
      const std::uint32_t begin = a_.slotBegin[n], end = a_.slotBegin[n + 1];
      return end < begin || end - begin < 3 || end - begin > std::uint32_t{kMaxHoleCorners};
    });
    if (bad)
      return refuse(amt_tag::kSlotBegin,
                    fmt::format("node {} has the slots {} to {}; a star has 3 to {}", *bad,
                                a_.slotBegin[*bad], a_.slotBegin[*bad + 1], kMaxHoleCorners));
    if (a_.slotBegin[nodes_] != slots_)
      return refuse(amt_tag::kSlotBegin,
                    fmt::format("the last node ends at slot {} of {}", a_.slotBegin[nodes_], slots_));
    return {};
  }

  Status rootTriangles() const {
    const auto bad = firstBad(roots_, [&](std::uint32_t t) {
      return std::ranges::any_of(a_.rootTriangles[t], [&](std::uint32_t v) { return v >= a_.rootVertices; });
    });
    if (!bad) return {};
    const auto& c = a_.rootTriangles[*bad];
    return refuse(amt_tag::kRootTriangles,
                  fmt::format("triangle {} has the corners {}, {}, {} of {} vertices of the root", *bad, c[0],
                              c[1], c[2], a_.rootVertices));
  }

  /// A star's corners are older than its apex: vertices of the root, or apexes of earlier nodes.
  Status links() const {
    const auto isBad = [&](std::uint32_t n, std::uint32_t s) { return a_.link[s] >= a_.rootVertices + n; };
    const auto bad = firstBadNode(isBad);
    if (!bad) return {};
    const std::uint32_t s = slotOf(*bad, [&](std::uint32_t slot) { return isBad(*bad, slot); });
    return refuse(amt_tag::kLink,
                  fmt::format("slot {} names vertex {}, which is not older than node {}'s vertex {}", s,
                              a_.link[s], *bad, a_.rootVertices + *bad));
  }

  Status removers() const {
    // A root triangle may be removed by any node; a triangle of a star only by a younger one.
    if (const auto bad = firstBad(roots_, [&](std::uint32_t t) {
          return a_.remover[t] != MultiTriangulation::kNone && a_.remover[t] >= nodes_;
        }))
      return refuse(amt_tag::kRemover,
                    fmt::format("triangle {} is removed by node {} of {}", *bad, a_.remover[*bad], nodes_));
    // The last slot of a star may name its own node, which marks the star as open.
    const auto isBad = [&](std::uint32_t n, std::uint32_t s) {
      const std::uint32_t r = a_.remover[roots_ + s];
      if (r == MultiTriangulation::kNone) return false;
      return r >= nodes_ || r < n || (r == n && s + 1 != a_.slotBegin[n + 1]);
    };
    if (const auto bad = firstBadNode(isBad)) {
      const std::uint32_t s = slotOf(*bad, [&](std::uint32_t slot) { return isBad(*bad, slot); });
      return refuse(amt_tag::kRemover,
                    fmt::format("triangle {}, of node {}, is removed by node {} of {}, which is not younger",
                                roots_ + s, *bad, a_.remover[roots_ + s], nodes_));
    }
    return {};
  }

  Status floors() const {
    const auto isBad = [&](std::uint32_t n, std::uint32_t i) {
      const std::uint32_t t = a_.floor[i];
      if (t >= a_.remover.size() || a_.remover[t] != n) return true;
      if (t >= roots_ + a_.slotBegin[n] && t < roots_ + a_.slotBegin[n + 1]) return true;
      for (std::uint32_t j = floorBegin(n); j < i; ++j)
        if (a_.floor[j] == t) return true;
      return false;
    };
    if (const auto bad = firstBad(nodes_, [&](std::uint32_t n) {
          for (std::uint32_t i = floorBegin(n); i < floorBegin(n + 1); ++i) {
            if (i + kAhead < a_.floor.size())
              __builtin_prefetch(a_.remover.data() + std::min(a_.floor[i + kAhead], roots_ + slots_));
            if (isBad(n, i)) return true;
          }
          return false;
        })) {
      std::uint32_t i = floorBegin(*bad);
      while (!isBad(*bad, i)) ++i;
      return refuse(
          amt_tag::kFloor,
          fmt::format("node {} lists triangle {}, which it does not remove, or twice", *bad, a_.floor[i]));
    }
    // Every floor id is some triangle's, once; so one more removed triangle than floor ids is in no floor.
    std::atomic<std::uint64_t> removed = 0;
    const auto count = [&](std::uint64_t here) { removed.fetch_add(here, std::memory_order_relaxed); };
    parallelFor(IndexRange<std::uint32_t>(0, roots_, kBlock), [&](const auto& range) {
      std::uint64_t here = 0;
      for (std::uint32_t t = range.begin(); t != range.end(); ++t)
        here += a_.remover[t] != MultiTriangulation::kNone ? 1 : 0;
      count(here);
    });
    parallelFor(IndexRange<std::uint32_t>(0, nodes_, kBlock), [&](const auto& range) {
      std::uint64_t here = 0;
      for (std::uint32_t n = range.begin(); n != range.end(); ++n)
        for (std::uint32_t s = a_.slotBegin[n]; s < a_.slotBegin[n + 1]; ++s) {
          const std::uint32_t r = a_.remover[roots_ + s];
          here += r != MultiTriangulation::kNone && r != n ? 1 : 0;
        }
      count(here);
    });
    if (removed == a_.floor.size()) return {};
    return refuse(amt_tag::kRemover, fmt::format("{} removed and {} in the floors of nodes",
                                                 counted(removed.load(), "triangle is", "triangles are"),
                                                 counted(a_.floor.size(), "is", "are")));
  }

  /// Checks what makes the front of every cut conforming: the vertices of a link are corners of the floor, so
  /// that a closed set of nodes contains all vertices of its stars; saturated errors and spheres contain
  /// those of the children, so that saturated cuts are closed.
  Status parents() const {
    const SlotToNode owners(a_);
    const auto bad = firstBad(nodes_, [&](std::uint32_t n) {
      return !isSurelySound(owners, n) && findParentProblem(n).has_value();
    });
    if (!bad) return {};
    const auto problem = findParentProblem(*bad);
    return refuse(problem->first, problem->second);
  }

  /// A sufficient test that findParentProblem() finds nothing. Branch-free, because the data are
  /// unpredictable.
  bool isSurelySound(const SlotToNode& owners, std::uint32_t n) const {
    std::array<std::uint32_t, 3 * (kMaxHoleCorners - 2)> corners;
    std::size_t count = 0;
    const Sphere& s = a_.sphere[n];
    const std::uint32_t error = a_.saturatedError[n];
    int isDoubtful = 0;
    for (std::uint32_t i = floorBegin(n), end = floorBegin(n + 1); i != end; ++i, count += 3) {
      prefetchFloor(owners, i);
      const std::uint32_t t = a_.floor[i];
      if (t < roots_) {
        std::ranges::copy(a_.rootTriangles[t], &corners[count]);
        continue;
      }
      const std::uint32_t slot = t - roots_, parent = owners.of(slot);
      corners[count] = a_.rootVertices + parent;
      corners[count + 1] = a_.link[slot];
      corners[count + 2] = a_.link[owners.after(slot, parent)];
      const Sphere& p = a_.sphere[parent];
      const double dx = double(s.x) - p.x, dy = double(s.y) - p.y, dz = double(s.z) - p.z;
      isDoubtful |= int(a_.saturatedError[parent] < error) |
                    int(std::sqrt(dx * dx + dy * dy + dz * dz) + s.radius > p.radius);
    }
    for (std::uint32_t slot = a_.slotBegin[n]; slot < a_.slotBegin[n + 1]; ++slot) {
      const std::uint32_t v = a_.link[slot];
      int isCorner = 0;
      for (std::size_t k = 0; k != count; ++k) isCorner |= int(corners[k] == v);
      isDoubtful |= isCorner ^ 1;
    }
    return isDoubtful == 0;
  }

  /// Prefetches what isSurelySound() reads for entries of floors that follow the i-th.
  [[gnu::always_inline]] void prefetchFloor(const SlotToNode& owners, std::uint32_t i) const {
    if (i + kFarAhead >= a_.floor.size()) return;
    const std::uint32_t far = a_.floor[i + kFarAhead] - roots_, near = a_.floor[i + kAhead] - roots_;
    if (far < slots_) {
      owners.prefetch(far);
      __builtin_prefetch(&a_.link[far]);
    }
    if (near < slots_) {
      const std::uint32_t parent = owners.of(near);
      __builtin_prefetch(&a_.sphere[parent]);
      __builtin_prefetch(&a_.saturatedError[parent]);
      __builtin_prefetch(&a_.slotBegin[parent]);
    }
  }

  /// Tests one node in full and words the problem. isSurelySound() makes it rare.
  std::optional<std::pair<AmtTag, std::string>> findParentProblem(std::uint32_t n) const {
    std::array<std::uint32_t, 3 * (kMaxHoleCorners - 2)> corners;
    auto end = corners.begin();
    const Sphere& s = a_.sphere[n];
    for (const std::uint32_t t : mt_.floor(NodeId(n))) {
      const NodeId parent = mt_.creator(TriangleId(t));
      for (const std::uint32_t corner : mt_.corners(TriangleId(t), parent)) *end++ = corner;
      if (!parent.isValid()) continue;
      if (a_.saturatedError[parent.index()] < a_.saturatedError[n])
        return std::pair{amt_tag::kSaturatedError,
                         fmt::format("node {} has a smaller error than its child {}", parent.index(), n)};
      const Sphere& p = a_.sphere[parent.index()];
      const double dx = double(s.x) - p.x, dy = double(s.y) - p.y, dz = double(s.z) - p.z;
      if (std::sqrt(dx * dx + dy * dy + dz * dz) + s.radius > p.radius)
        return std::pair{
            amt_tag::kSphere,
            fmt::format("the sphere of node {} does not hold that of its child {}", parent.index(), n)};
    }
    for (std::uint32_t slot = a_.slotBegin[n]; slot < a_.slotBegin[n + 1]; ++slot)
      if (std::find(corners.begin(), end, a_.link[slot]) == end)
        return std::pair{amt_tag::kLink,
                         fmt::format("slot {} names vertex {}, which is no corner of the floor of node {}",
                                     slot, a_.link[slot], n)};
    return std::nullopt;
  }

  Status hints() const {
    // A hint is where the search for the owner of a slot begins: the node that owns exactly this slot.
    constexpr std::uint64_t kStep = MultiTriangulation::kSlotsPerHint;
    const auto bad = firstBad(a_.creatorHint.size(), [&](std::uint32_t i) {
      const std::uint32_t n = a_.creatorHint[i];
      return n >= nodes_ || a_.slotBegin[n] > kStep * i || a_.slotBegin[n + 1] <= kStep * i;
    });
    if (!bad) return {};
    return refuse(amt_tag::kCreatorHint,
                  fmt::format("entry {} names node {} as the owner of slot {}, which it is not", *bad,
                              a_.creatorHint[*bad], kStep * *bad));
  }

  Status nodeValues() const {
    // Nodes are stored by bands, the largest errors first.
    if (const auto bad = firstBad(nodes_, [&](std::uint32_t n) {
          return n > 0 && MultiTriangulation::bandOf(a_.saturatedError[n]) >
                              MultiTriangulation::bandOf(a_.saturatedError[n - 1]);
        }))
      return refuse(amt_tag::kSaturatedError,
                    fmt::format("node {} is in a higher band of errors than the node before it", *bad));
    if (const auto bad = firstBad(nodes_, [&](std::uint32_t n) {
          const Sphere& s = a_.sphere[n];
          return !std::isfinite(s.x) || !std::isfinite(s.y) || !std::isfinite(s.z) ||
                 !std::isfinite(s.radius) || s.radius < 0;
        }))
      return refuse(amt_tag::kSphere, fmt::format("node {} has an invalid sphere", *bad));
    return {};
  }

  Status blocks() const {
    if (const auto bad = firstBad(a_.blockSphere.size(), [&](std::uint32_t i) {
          const Sphere& s = a_.blockSphere[i];
          return !std::isfinite(s.x) || !std::isfinite(s.y) || !std::isfinite(s.z) ||
                 !std::isfinite(s.radius) || s.radius < 0;
        }))
      return refuse(amt_tag::kBlockSphere, fmt::format("block {} has an invalid sphere", *bad));
    const auto findBad = [&](const auto& holds) -> std::optional<std::pair<std::uint64_t, std::uint32_t>> {
      // A node is in two entries, of its cluster and of its cluster group; the message names the one that
      // fails.
      const auto misses = [&](std::uint64_t entry, std::uint32_t n) { return !holds(a_, entry, n); };
      const auto bad = firstBad(nodes_, [&](std::uint32_t n) {
        const auto entries = blockEntries(nodes_, n);
        return misses(entries[0], n) || misses(entries[1], n);
      });
      if (!bad) return std::nullopt;
      const auto entries = blockEntries(nodes_, *bad);
      return std::pair{misses(entries[0], *bad) ? entries[0] : entries[1], *bad};
    };
    if (const auto bad = findBad(holdsError))
      return refuse(amt_tag::kBlockError,
                    fmt::format("block {} has a smaller error than its node {}", bad->first, bad->second));
    if (const auto bad = findBad(holdsSphere))
      return refuse(
          amt_tag::kBlockSphere,
          fmt::format("the sphere of block {} does not hold that of its node {}", bad->first, bad->second));
    return {};
  }

  Status vertices() const {
    const VertexArrays& v = a_.vertices;
    if (v.isLattice())
      if (const auto bad = firstBad(v.size(), [&](std::uint32_t i) { return v.samples[i] >= gridSamples_; }))
        return refuse(amt_tag::kSamples,
                      fmt::format("vertex {} is sample {} of {}", *bad, v.samples[*bad], gridSamples_));
    for (const AmtMtColumn& column : amtMtColumns(a_)) {
      if (column.tag == amt_tag::kHeights || column.tag == amt_tag::kSphere || !column.isFloating()) continue;
      if (const auto bad = firstNotFinite(column))
        return refuse(column.tag,
                      fmt::format("{} {} has {} not finite", toString(column.per), *bad,
                                  column.components > 1 ? "coordinates that are" : "a number that is"));
    }
    if (!v.hasPlan()) return {};
    // A raw height may be finite and its height not.
    if (const auto bad =
            firstBad(v.size(), [&](std::uint32_t i) { return !std::isfinite(v.height(VertexId(i))); }))
      return refuse(amt_tag::kHeights, fmt::format("vertex {} has a height that is not finite", *bad));
    return {};
  }

  /// The first element of a column of floating-point numbers that has one that is not finite. Columns of
  /// blocks are checked with them.
  std::optional<std::uint32_t> firstNotFinite(const AmtMtColumn& column) const {
    if (column.per == AmtPer::block) return std::nullopt;
    const std::span<const std::byte> bytes = column.mt.bytes(a_);
    const auto find = [&]<class T>(T) {
      const std::span<const T> all(reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T));
      return firstBad(
          bytes.size() / column.elementBytes(), [&, n = std::size_t{column.components}](std::uint32_t i) {
            return !std::ranges::all_of(all.subspan(i * n, n), [](T x) { return std::isfinite(x); });
          });
    };
    return column.scalar == AmtScalar::f32 ? find(float{}) : find(double{});
  }

  /// The first node with a bad slot.
  template <class IsBad>
  std::optional<std::uint32_t> firstBadNode(const IsBad& isBad) const {
    return firstBad(nodes_, [&](std::uint32_t n) {
      for (std::uint32_t s = a_.slotBegin[n]; s < a_.slotBegin[n + 1]; ++s)
        if (isBad(n, s)) return true;
      return false;
    });
  }
  std::uint32_t floorBegin(std::uint32_t n) const { return a_.slotBegin[n] - 2 * n; }

  static constexpr std::uint32_t kAhead = 64, kFarAhead = 128;  // entries of floors

  const RunContext& context_;
  const MultiTriangulation& mt_;
  const MtArrays& a_;
  std::uint64_t gridSamples_;
  std::uint32_t nodes_, roots_, slots_;
};

}  // namespace

Status checkMtIndices(const MultiTriangulation& mt, std::uint64_t gridSamples, const RunContext& context) {
  return withThreads(context, [&] { return MtIndexCheck(mt, gridSamples, context).run(); });
}

}  // namespace arete

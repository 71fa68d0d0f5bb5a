// SPDX-License-Identifier: GPL-3.0-or-later
//
// Renumbers what was recorded bottom-up into the arrays of a multitriangulation, which are top-down.
//
// Nodes are ordered by falling band of saturated error, and within a band the later removal comes first, so
// that parents precede children (a parent is removed later and is at least as saturated). The order of the
// batches says which removal is later, not the order in which threads announced them. The removals of one
// batch are listed in memory order, which follows the ground, and so are the nodes of one batch and band. A
// counting sort over the bands takes O(N). Vertices: the root's, then one per node. Triangles: the root's,
// then the slots of the nodes, in order.
//
// Each pass writes every element of its arrays once, for one node at a time, so all passes run in parallel
// and the result does not depend on the threads. Passes read the records of nodes in the new order, which is
// random access: they prefetch the records of a node some nodes ahead. A pass frees each of the recorder's
// arrays as soon as it has copied it, and the next array takes that memory: the peak is about one array above
// the records, not twice the records.

#include <algorithm>
#include <array>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/memory/uninitialized_vector.h"
#include "engine/mt/node_blocks.h"
#include "engine/mt/recorder.h"
#include "engine/parallel/parallel_loops.h"

namespace arete {
namespace {

constexpr std::size_t kGrain = 1 << 13, kBatchesPerTask = 64;
/// How many nodes ahead records are prefetched: the far ones first the record of the removal, then, when that
/// is in a cache, the near ones what the record refers to.
constexpr std::uint32_t kAhead = 16, kNearAhead = 6;
/// Slots of a node whose targets are prefetched: most nodes have as many. A fixed number, although it may
/// reach into the next node's slots: a variable trip count mispredicts.
constexpr std::uint32_t kPrefetchedSlots = 6;
constexpr std::uint32_t kSlotsAhead = 32;  ///< how many slots ahead the codes of a triangle are prefetched

template <class Body>
void forRange(std::size_t size, const Body& body) {
  parallelFor(IndexRange<std::size_t>(0, size, kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) body(static_cast<std::uint32_t>(i));
  });
}

/// The removers of all triangles; until a triangle's codes are copied, its element holds its recorder id
/// instead. The two share one array so that the recorder's ceilings are freed before the arrays of codes are
/// allocated. For each triangle: setRecorderId(), recorderId(), then setRemover() as often as necessary.
class RemoversInTheMaking {
 public:
  void resize(std::size_t triangles) { values_.resize(triangles); }

  void setRecorderId(std::uint32_t triangle, std::uint32_t recorderId) { values_[triangle] = recorderId; }
  std::uint32_t recorderId(std::uint32_t triangle) const { return values_[triangle]; }

  void setRemover(std::uint32_t triangle, std::uint32_t node) { values_[triangle] = node; }
  /// Precondition: every triangle has its remover.
  std::span<const std::uint32_t> removers() const { return values_; }

 private:
  UninitializedVector<std::uint32_t> values_;
};

/// What a finished MT refers to.
struct OwnedArrays {
  std::vector<std::array<std::uint32_t, 3>> rootTriangles;
  UninitializedVector<std::uint32_t> slotBegin, link, floor, creatorHint;
  RemoversInTheMaking remover;
  UninitializedVector<std::uint16_t> error, below, above, saturatedError;
  UninitializedVector<Sphere> sphere;
  NodeBlocks blocks;
};

}  // namespace

/// The passes of finish(), and the arrays that live between them.
class MtRecorder::Finishing {
 public:
  Finishing(MtRecorder& recorder, std::span<const VertexId> rootVertices,
            std::span<const SurvivingTriangle> surviving)
      : recorder_(recorder),
        rootVertices_(rootVertices),
        surviving_(surviving),
        nodes_(recorder.removals_),
        slots_(recorder.slotBegin_[recorder.removals_]),
        roots_(static_cast<std::uint32_t>(surviving.size())),
        floorTriangles_(slots_ - 2 * nodes_),
        out_(std::make_shared<OwnedArrays>()) {}

  MultiTriangulation run(std::uint32_t callerVertexCount, UninitializedVector<std::uint32_t>& vertexOrder,
                         StageClock* clock) {
    {
      const StageClock::Scope stage(clock, "finish: order");
      orderNodes();
      numberVertices(callerVertexCount, vertexOrder);
    }
    {
      const StageClock::Scope stage(clock, "finish: stars");
      copySaturation();
      copyRootTriangles();
      copyLinks();
      copyCeilings();
      copyCodes();
    }
    const StageClock::Scope stage(clock, "finish: floors");
    connectFloors();
    makeCreatorHints();
    out_->blocks = makeNodeBlocks(out_->saturatedError, out_->sphere);
    recorder_.slotBegin_.clear();
    recorder_.batches_.clear();
    recorder_.removals_ = 0;
    return MultiTriangulation(arrays(), out_);
  }

 private:
  // --- access ---------------------------------------------------------------------------------------------

  std::uint32_t recordedBegin(std::uint32_t n) const { return recorder_.slotBegin_[removalOf_[n]]; }
  std::uint32_t slotCount(std::uint32_t n) const { return out_->slotBegin[n + 1] - out_->slotBegin[n]; }
  /// The index of a triangle among those of all floors; floorTriangles_ or more when the triangle belongs to
  /// the finest triangulation or is missing.
  std::uint32_t floorIndex(std::uint32_t recorderId) const { return recorderId - recorder_.finestTriangles_; }

  /// Prefetches the recorded slots of a node kAhead nodes ahead, and where those of twice as many ahead
  /// begin.
  [[gnu::always_inline]] void prefetchSlots(std::uint32_t n, const ChunkedArray<std::uint32_t>& array) const {
    if (n + 2 * kAhead < nodes_) __builtin_prefetch(&recorder_.slotBegin_[removalOf_[n + 2 * kAhead]]);
    if (n + kAhead < nodes_) __builtin_prefetch(&array[recordedBegin(n + kAhead)]);
  }
  /// The first of kPrefetchedSlots recorded slots from a node's first one on; kNone when there are fewer.
  [[gnu::always_inline]] std::uint32_t firstPrefetchedSlot(std::uint32_t n) const {
    const std::uint32_t begin = n < nodes_ ? recordedBegin(n) : slots_;
    return begin + kPrefetchedSlots > slots_ ? kNone : begin;
  }

  // --- passes ---------------------------------------------------------------------------------------------

  /// Sets removalOf_: by falling band, within one the later removals first.
  void orderNodes() {
    constexpr std::uint32_t kBands = MultiTriangulation::kBands;
    std::vector<Batch>& batches = recorder_.batches_;
    std::ranges::stable_sort(batches, {}, &Batch::order);
    std::ranges::reverse(batches);
    const auto forTask = [&](std::size_t task, const auto& visit) {
      const std::size_t end = std::min((task + 1) * kBatchesPerTask, batches.size());
      for (std::size_t b = task * kBatchesPerTask; b != end; ++b)
        for (std::uint32_t i = batches[b].size; i-- > 0;) {
          const std::uint32_t r = batches[b].first + i;
          visit(r, kBands - 1 - MultiTriangulation::bandOf(recorder_.saturated_[r]));
        }
    };
    const std::size_t tasks = (batches.size() + kBatchesPerTask - 1) / kBatchesPerTask;
    // First the number of each task's removals in each band, then where they go.
    std::vector<std::array<std::uint32_t, kBands>> begin(tasks);
    parallelFor(std::size_t(0), tasks, [&](std::size_t task) {
      begin[task].fill(0);
      forTask(task, [&](std::uint32_t, std::uint32_t band) { ++begin[task][band]; });
    });
    std::uint32_t next = 0;
    for (std::uint32_t band = 0; band < kBands; ++band)
      for (auto& of : begin) next += std::exchange(of[band], next);
    removalOf_.resize(nodes_);
    parallelFor(std::size_t(0), tasks, [&](std::size_t task) {
      forTask(task, [&](std::uint32_t r, std::uint32_t band) { removalOf_[begin[task][band]++] = r; });
    });
  }

  /// Sets vertexOrder, its inverse newVertex_, and where the slots of each node begin.
  void numberVertices(std::uint32_t callerVertexCount, UninitializedVector<std::uint32_t>& vertexOrder) {
    const auto rootVertexCount = static_cast<std::uint32_t>(rootVertices_.size());
    vertexOrder.resize(std::size_t(rootVertexCount) + nodes_);
    newVertex_.assign(callerVertexCount, kNone);
    for (std::uint32_t i = 0; i < rootVertexCount; ++i) {
      vertexOrder[i] = rootVertices_[i].index();
      newVertex_[rootVertices_[i].index()] = i;
    }
    UninitializedVector<std::uint32_t>& slotBegin = out_->slotBegin;
    slotBegin.resize(std::size_t(nodes_) + 1);
    slotBegin[0] = 0;
    forRange(nodes_, [&](std::uint32_t n) {
      const std::uint32_t r = removalOf_[n], v = recorder_.vertex_[r];
      vertexOrder[rootVertexCount + n] = v;
      newVertex_[v] = rootVertexCount + n;
      slotBegin[n + 1] = recorder_.slotBegin_[r + 1] - recorder_.slotBegin_[r];
    });
    recorder_.vertex_.clear();
    std::partial_sum(slotBegin.begin(), slotBegin.end(), slotBegin.begin());
  }

  /// Saturated errors and spheres.
  void copySaturation() {
    out_->saturatedError.resize(nodes_);
    out_->sphere.resize(nodes_);
    forRange(nodes_, [&](std::uint32_t n) {
      if (n + kAhead < nodes_) {
        __builtin_prefetch(&recorder_.saturated_[removalOf_[n + kAhead]]);
        __builtin_prefetch(&recorder_.sphere_[removalOf_[n + kAhead]]);
      }
      out_->saturatedError[n] = recorder_.saturated_[removalOf_[n]];
      out_->sphere[n] = recorder_.sphere_[removalOf_[n]];
    });
    recorder_.saturated_.clear();
    recorder_.sphere_.clear();
  }

  void copyRootTriangles() {
    out_->rootTriangles.resize(roots_);
    for (std::uint32_t i = 0; i < roots_; ++i) {
      const auto& c = surviving_[i].corners;
      out_->rootTriangles[i] = {newVertex_[c[0].index()], newVertex_[c[1].index()], newVertex_[c[2].index()]};
    }
  }

  /// Links, in the new numbers of vertices.
  void copyLinks() {
    out_->link.resize(slots_);
    forRange(nodes_, [&](std::uint32_t n) {
      prefetchSlots(n, recorder_.link_);
      if (const std::uint32_t first = firstPrefetchedSlot(n + kNearAhead); first != kNone)
        for (std::uint32_t k = 0; k < kPrefetchedSlots; ++k)
          __builtin_prefetch(&newVertex_[recorder_.link_[first + k]]);
      const std::uint32_t from = recordedBegin(n), to = out_->slotBegin[n];
      for (std::uint32_t i = 0; i < slotCount(n); ++i)
        out_->link[to + i] = newVertex_[recorder_.link_[from + i]];
    });
    recorder_.link_.clear();
    UninitializedVector<std::uint32_t>().swap(newVertex_);
  }

  /// The recorder ids of all triangles, and newIdOf_, their inverse for floor triangles. (Where the triangles
  /// of the finest triangulation go is not needed.)
  void copyCeilings() {
    newIdOf_.resize(floorTriangles_);
    out_->remover.resize(std::size_t(roots_) + slots_);
    const auto assign = [&](std::uint32_t id, std::uint32_t recorderId) {
      out_->remover.setRecorderId(id, recorderId);
      if (const std::uint32_t f = floorIndex(recorderId); f < floorTriangles_) newIdOf_[f] = id;
    };
    for (std::uint32_t i = 0; i < roots_; ++i) assign(i, surviving_[i].id.index());
    forRange(nodes_, [&](std::uint32_t n) {
      prefetchSlots(n, recorder_.ceiling_);
      if (const std::uint32_t first = firstPrefetchedSlot(n + kNearAhead); first != kNone)
        for (std::uint32_t k = 0; k < kPrefetchedSlots; ++k) {
          const std::uint32_t f = floorIndex(recorder_.ceiling_[first + k]);
          __builtin_prefetch(&newIdOf_[f < floorTriangles_ ? f : 0], 1);
        }
      const std::uint32_t from = recordedBegin(n), to = out_->slotBegin[n];
      for (std::uint32_t i = 0; i < slotCount(n); ++i) assign(roots_ + to + i, recorder_.ceiling_[from + i]);
    });
    recorder_.ceiling_.clear();
  }

  /// Errors and bounds of all triangles. Replaces their recorder ids by removers: none as yet, but the last
  /// slot of an open star, which is no triangle, is removed by its own node.
  void copyCodes() {
    const std::size_t ids = std::size_t(roots_) + slots_;
    out_->error.resize(ids);
    out_->below.resize(ids);
    out_->above.resize(ids);
    const auto copy = [&](std::uint32_t id, std::uint32_t removerIfMissing) {
      const std::uint32_t recorderId = out_->remover.recorderId(id), f = floorIndex(recorderId);
      const FloorCodes codes = f < floorTriangles_ ? recorder_.floor_[f] : FloorCodes{};
      out_->remover.setRemover(id, recorderId == kNone ? removerIfMissing : kNone);
      out_->error[id] = codes.error;
      out_->below[id] = codes.below;
      out_->above[id] = codes.above;
    };
    for (std::uint32_t i = 0; i < roots_; ++i) copy(i, kNone);
    parallelFor(IndexRange<std::uint32_t>(0, nodes_, kGrain), [&](const auto& range) {
      // Beyond the range's last slot another thread may have replaced the recorder ids already.
      const std::uint32_t end = out_->slotBegin[range.end()];
      for (std::uint32_t n = range.begin(); n != range.end(); ++n)
        for (std::uint32_t slot = out_->slotBegin[n]; slot != out_->slotBegin[n + 1]; ++slot) {
          const std::uint32_t ahead = roots_ + std::min(slot + kSlotsAhead, end - 1);
          if (const std::uint32_t f = floorIndex(out_->remover.recorderId(ahead)); f < floorTriangles_)
            __builtin_prefetch(&recorder_.floor_[f]);
          copy(roots_ + slot, n);
        }
    });
    recorder_.floor_.clear();
  }

  /// The floor of every node, and the node as the remover of its floor's triangles.
  void connectFloors() {
    out_->floor.resize(floorTriangles_);
    forRange(nodes_, [&](std::uint32_t n) {
      const std::uint32_t r = removalOf_[n],
                          first = floorIndex(recorder_.firstFloorTriangle(RemovalId(r)).index()),
                          to = out_->slotBegin[n] - 2 * n;
      for (std::uint32_t i = 0; i + 2 < recorder_.slotBegin_[r + 1] - recorder_.slotBegin_[r]; ++i) {
        const std::uint32_t id = newIdOf_[first + i];
        out_->floor[to + i] = id;
        out_->remover.setRemover(id, n);
      }
    });
  }

  /// The owner of every 64th slot.
  void makeCreatorHints() {
    constexpr std::uint32_t k = MultiTriangulation::kSlotsPerHint;
    out_->creatorHint.resize((std::size_t(slots_) + k - 1) / k);
    forRange(nodes_, [&](std::uint32_t n) {
      for (std::uint32_t h = (out_->slotBegin[n] + k - 1) / k; h * k < out_->slotBegin[n + 1]; ++h)
        out_->creatorHint[h] = n;
    });
  }

  MtArrays arrays() const {
    MtArrays a;
    a.rootVertices = static_cast<std::uint32_t>(rootVertices_.size());
    a.rootTriangles = out_->rootTriangles;
    a.slotBegin = out_->slotBegin;
    a.link = out_->link;
    a.remover = out_->remover.removers();
    a.error = out_->error;
    a.columns.set(kBelow, out_->below);
    a.columns.set(kAbove, out_->above);
    a.floor = out_->floor;
    a.saturatedError = out_->saturatedError;
    a.sphere = out_->sphere;
    a.blockError = out_->blocks.error;
    a.blockSphere = out_->blocks.sphere;
    a.creatorHint = out_->creatorHint;
    a.scale = recorder_.scale_;
    a.metric = recorder_.metric_;
    return a;
  }

  MtRecorder& recorder_;
  const std::span<const VertexId> rootVertices_;
  const std::span<const SurvivingTriangle> surviving_;
  const std::uint32_t nodes_, slots_, roots_, floorTriangles_;

  UninitializedVector<std::uint32_t> removalOf_;  // per node
  UninitializedVector<std::uint32_t> newVertex_;  // per vertex of the caller; until links are copied
  UninitializedVector<std::uint32_t> newIdOf_;    // per floor triangle, in recorder order
  std::shared_ptr<OwnedArrays> out_;
};

MultiTriangulation MtRecorder::finish(std::span<const VertexId> rootVertices,
                                      std::span<const SurvivingTriangle> surviving,
                                      std::uint32_t callerVertexCount,
                                      UninitializedVector<std::uint32_t>& vertexOrder, StageClock* clock) {
  return Finishing(*this, rootVertices, surviving).run(callerVertexCount, vertexOrder, clock);
}

}  // namespace arete

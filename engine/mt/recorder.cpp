// SPDX-License-Identifier: GPL-3.0-or-later
//
// While recording, a node is a removal and a triangle is a birth; both are numbered bottom-up. Saturated
// errors and spheres are complete the moment a removal is recorded, because its children (the removals that
// bore its star) are of earlier batches: the saturated error is the largest of its floor's errors and its
// children's, the sphere grows to enclose the children's.
//
// finish() renumbers. Nodes: by falling band of saturated error, and within a band the later removal first,
// so that parents come before children (a parent is removed later and is at least as saturated). Later is
// what the batches' order says: threads announce them as it happens. The removals of a batch are listed in
// the order of memory, which follows the ground; so do the nodes of one batch and band. A counting sort over
// the bands does it in O(N). Vertices: the root's, then one per node. Triangles: the root's, then the slots
// of the nodes in order. Passes copy the spheres, the links and the ceilings, the last noting where each
// birth went; then each node fills its floor and signs as the remover of its floor's triangles. Every element
// is written once, by one node, so all passes are parallel.
#include "engine/mt/recorder.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "engine/memory/uninitialized_vector.h"
#include "engine/mt/enclosing_ball.h"
#include "engine/mt/node_blocks.h"

namespace arete {
namespace {

struct OwnedMt {
  std::vector<std::array<std::uint32_t, 3>> rootTriangles;
  UninitializedVector<std::uint32_t> slotBegin, link, remover, floor, creatorHint;
  UninitializedVector<std::uint16_t> error, below, above, saturatedError;
  UninitializedVector<Sphere> sphere;
  NodeBlocks blocks;
};

constexpr std::size_t kGrain = 1 << 13, kBatchesAtOnce = 64;
constexpr std::uint32_t kAhead = 16,
                        kNearAhead = 6;    // nodes whose stars are asked for before they are needed
constexpr std::uint32_t kSlotsAhead = 32;  // whose codes are

template <class Body>
void forRange(std::size_t size, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, size, kGrain), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) body(static_cast<std::uint32_t>(i));
  });
}

}  // namespace

MtRecorder::MtRecorder(std::uint32_t finestTriangles, std::uint32_t mostRemovals, OutwardScale scale,
                       MetricFrame metric)
    : finestTriangles_(finestTriangles), scale_(scale), metric_(metric) {
  // As link sizes are told in bytes. Only addresses are reserved: memory is taken as removals come.
  constexpr std::size_t kMostSlots = std::numeric_limits<std::uint8_t>::max();
  const std::size_t removals = mostRemovals;
  slotBegin_.reserve(removals + 1);
  vertex_.reserve(removals);
  saturated_.reserve(removals);
  sphere_.reserve(removals);
  link_.reserve(removals * kMostSlots);
  ceiling_.reserve(removals * kMostSlots);
  floor_.reserve(removals * kMostSlots);
  slotBegin_.resize(1);
  slotBegin_[0] = 0;
}

std::uint32_t MtRecorder::beginBatch(BatchOrder order, std::span<const std::uint8_t> linkSizes) {
  const std::lock_guard lock(growing_);
  const std::uint32_t first = removals_;
  const std::size_t count = linkSizes.size();
  slotBegin_.resize(removals_ + count + 1);
  for (std::size_t i = 0; i < count; ++i) slotBegin_[first + i + 1] = slotBegin_[first + i] + linkSizes[i];
  batches_.push_back({order, first, static_cast<std::uint32_t>(count)});
  removals_ += static_cast<std::uint32_t>(count);
  vertex_.resize(removals_);
  saturated_.resize(removals_);
  sphere_.resize(removals_);
  const std::size_t slots = slotBegin_[removals_], births = slots - 2 * std::size_t(removals_);
  link_.resize(slots);
  ceiling_.resize(slots);
  floor_.resize(births);
  return first;
}

void MtRecorder::record(std::uint32_t removal, const VertexRemoval& what) {
  const std::uint32_t begin = slotBegin_[removal];
  const std::size_t slots = what.link.size();
  assert(slots == slotBegin_[removal + 1] - begin && slots >= 3);
  assert(what.ceiling.size() == slots - (what.isOpen ? 1 : 0) && what.floor.size() == slots - 2);

  vertex_[removal] = what.vertex;
  for (std::size_t i = 0; i < slots; ++i) {
    link_[begin + i] = what.link[i];
    ceiling_[begin + i] = i < what.ceiling.size() ? what.ceiling[i] : kNone;
  }

  const std::size_t firstFloor = begin - 2 * std::size_t(removal);
  for (std::size_t i = 0; i < slots - 2; ++i) floor_[firstFloor + i] = what.floor[i];
}

void MtRecorder::saturate(std::uint32_t removal, const VertexRemoval& what) {
  std::uint16_t saturated = 0;
  for (const FloorCodes& codes : what.floor) saturated = std::max(saturated, codes.error);
  EnclosingBall ball = EnclosingBall::around(what.metricPositions);
  for (const std::uint32_t child : what.ceilingCreator) {
    if (child == kNone) continue;
    saturated = std::max(saturated, saturated_[child]);
    ball.encloseChild(sphere_[child]);
  }
  saturated_[removal] = saturated;
  sphere_[removal] = ball.rounded();
}

UninitializedVector<std::uint32_t> MtRecorder::byFallingBand() {
  constexpr std::uint32_t kBands = MultiTriangulation::kBands;
  std::ranges::stable_sort(batches_, {}, &Batch::order);
  std::ranges::reverse(batches_);
  const auto forPart = [&](std::size_t part, const auto& visit) {
    const std::size_t end = std::min((part + 1) * kBatchesAtOnce, batches_.size());
    for (std::size_t b = part * kBatchesAtOnce; b != end; ++b)
      for (std::uint32_t i = batches_[b].size; i-- > 0;) {
        const std::uint32_t r = batches_[b].first + i;
        visit(r, kBands - 1 - MultiTriangulation::bandOf(saturated_[r]));
      }
  };
  const std::size_t parts = (batches_.size() + kBatchesAtOnce - 1) / kBatchesAtOnce;
  std::vector<std::array<std::uint32_t, kBands>> begin(parts);  // of what goes into a band from a part
  tbb::parallel_for(std::size_t(0), parts, [&](std::size_t part) {
    begin[part].fill(0);
    forPart(part, [&](std::uint32_t, std::uint32_t band) { ++begin[part][band]; });
  });
  std::uint32_t next = 0;
  for (std::uint32_t band = 0; band < kBands; ++band)
    for (auto& of : begin) next += std::exchange(of[band], next);
  UninitializedVector<std::uint32_t> removalOf(removals_);
  tbb::parallel_for(std::size_t(0), parts, [&](std::size_t part) {
    forPart(part, [&](std::uint32_t r, std::uint32_t band) { removalOf[begin[part][band]++] = r; });
  });
  return removalOf;
}

MultiTriangulation MtRecorder::finish(std::span<const std::uint32_t> rootVertices,
                                      std::span<const SurvivingTriangle> surviving,
                                      std::uint32_t callerVertexCount,
                                      UninitializedVector<std::uint32_t>& vertexOrder, StageClock* clock) {
  std::optional<StageClock::Scope> stage(std::in_place, clock, "finish: order");
  const std::uint32_t nodes = removals_;
  const std::uint32_t slots = slotBegin_[removals_];
  const std::uint32_t roots = static_cast<std::uint32_t>(surviving.size());
  const std::uint32_t rootVertexCount = static_cast<std::uint32_t>(rootVertices.size());
  const std::uint32_t born = slots - 2 * nodes;

  const UninitializedVector<std::uint32_t> removalOf = byFallingBand();

  vertexOrder.resize(std::size_t(rootVertexCount) + nodes);
  UninitializedVector<std::uint32_t> newVertex(callerVertexCount, kNone);
  for (std::uint32_t i = 0; i < rootVertexCount; ++i) {
    vertexOrder[i] = rootVertices[i];
    newVertex[rootVertices[i]] = i;
  }
  auto owned = std::make_shared<OwnedMt>();
  owned->slotBegin.resize(std::size_t(nodes) + 1);
  owned->slotBegin[0] = 0;
  forRange(nodes, [&](std::uint32_t n) {
    const std::uint32_t r = removalOf[n], v = vertex_[r];
    vertexOrder[rootVertexCount + n] = v;
    newVertex[v] = rootVertexCount + n;
    owned->slotBegin[n + 1] = slotBegin_[r + 1] - slotBegin_[r];
  });
  vertex_.clear();
  std::partial_sum(owned->slotBegin.begin(), owned->slotBegin.end(), owned->slotBegin.begin());

  const std::size_t ids = std::size_t(roots) + slots;

  // What the recorder holds goes as soon as it has been copied, and what it leaves takes the next array: here
  // both would be in memory at once.
  stage.emplace(clock, "finish: stars");
  owned->saturatedError.resize(nodes);
  owned->sphere.resize(nodes);
  forRange(nodes, [&](std::uint32_t n) {
    if (n + kAhead < nodes) {
      __builtin_prefetch(&saturated_[removalOf[n + kAhead]]);
      __builtin_prefetch(&sphere_[removalOf[n + kAhead]]);
    }
    owned->saturatedError[n] = saturated_[removalOf[n]];
    owned->sphere[n] = sphere_[removalOf[n]];
  });
  saturated_.clear();
  sphere_.clear();

  const auto prefetchSlots = [&](std::uint32_t n, const ChunkedArray<std::uint32_t>& array)
      __attribute__((always_inline)) {
    if (n + 2 * kAhead < nodes) __builtin_prefetch(&slotBegin_[removalOf[n + 2 * kAhead]]);
    if (n + kAhead < nodes) __builtin_prefetch(&array[slotBegin_[removalOf[n + kAhead]]]);
  };
  // As many slots of a node as most have, perhaps the next one's: a number that nobody can foresee takes
  // longer than to ask for one too many.
  const auto forFirstSlots = [&](std::uint32_t n, const auto& visit) __attribute__((always_inline)) {
    constexpr std::uint32_t kMost = 6;
    const std::uint32_t begin = n < nodes ? slotBegin_[removalOf[n]] : slots;
    if (begin + kMost > slots) return;
    for (std::uint32_t k = 0; k < kMost; ++k) visit(begin + k);
  };
  owned->link.resize(slots);
  owned->rootTriangles.resize(roots);
  for (std::uint32_t i = 0; i < roots; ++i) {
    const auto& c = surviving[i].corners;
    owned->rootTriangles[i] = {newVertex[c[0]], newVertex[c[1]], newVertex[c[2]]};
  }
  forRange(nodes, [&](std::uint32_t n) {
    prefetchSlots(n, link_);
    forFirstSlots(
        n + kNearAhead, [&](std::uint32_t slot)
                            __attribute__((always_inline)) { __builtin_prefetch(&newVertex[link_[slot]]); });
    const std::uint32_t from = slotBegin_[removalOf[n]], to = owned->slotBegin[n];
    for (std::uint32_t i = 0; i < owned->slotBegin[n + 1] - to; ++i)
      owned->link[to + i] = newVertex[link_[from + i]];
  });
  link_.clear();
  UninitializedVector<std::uint32_t>().swap(newVertex);

  // Of births that removals bore; nobody asks where the finest triangles went.
  UninitializedVector<std::uint32_t> idOfBirth(born);
  owned->remover.resize(ids);
  // Until a triangle's codes are there, its birth stands where its remover will: so what the recorder holds
  // of ceilings goes before they come.
  const auto place = [&](std::uint32_t id, std::uint32_t birth) {
    owned->remover[id] = birth;
    if (birth - finestTriangles_ < born) idOfBirth[birth - finestTriangles_] = id;
  };
  for (std::uint32_t i = 0; i < roots; ++i) place(i, surviving[i].birth);
  forRange(nodes, [&](std::uint32_t n) {
    prefetchSlots(n, ceiling_);
    forFirstSlots(
        n + kNearAhead, [&](std::uint32_t slot) __attribute__((always_inline)) {
          const std::uint32_t birth = ceiling_[slot] - finestTriangles_, known = birth < born ? birth : 0;
          __builtin_prefetch(&idOfBirth[known], 1);
        });
    const std::uint32_t from = slotBegin_[removalOf[n]], to = owned->slotBegin[n];
    for (std::uint32_t i = 0; i < owned->slotBegin[n + 1] - to; ++i)
      place(roots + to + i, ceiling_[from + i]);
  });
  ceiling_.clear();

  owned->error.resize(ids);
  owned->below.resize(ids);
  owned->above.resize(ids);
  // Where a node's star is open, the triangle that it has not stands at its last slot: the node "removes" it.
  const auto tellCodes = [&](std::uint32_t id, std::uint32_t ifNone) {
    const std::uint32_t birth = owned->remover[id];
    const FloorCodes codes =
        birth - finestTriangles_ < born ? floor_[birth - finestTriangles_] : FloorCodes{};
    owned->remover[id] = birth == kNone ? ifNone : kNone;
    owned->error[id] = codes.error;
    owned->below[id] = codes.below;
    owned->above[id] = codes.above;
  };
  for (std::uint32_t i = 0; i < roots; ++i) tellCodes(i, kNone);
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, nodes, kGrain), [&](const auto& range) {
    const std::uint32_t end = owned->slotBegin[range.end()];
    for (std::uint32_t n = range.begin(); n != range.end(); ++n)
      for (std::uint32_t slot = owned->slotBegin[n]; slot != owned->slotBegin[n + 1]; ++slot) {
        const std::uint32_t ahead =
            owned->remover[roots + std::min(slot + kSlotsAhead, end - 1)] - finestTriangles_;
        if (ahead < born) __builtin_prefetch(&floor_[ahead]);
        tellCodes(roots + slot, n);
      }
  });
  floor_.clear();

  stage.emplace(clock, "finish: floors");
  owned->floor.resize(born);
  forRange(nodes, [&](std::uint32_t n) {
    const std::uint32_t r = removalOf[n], birth = firstBirth(r) - finestTriangles_,
                        to = owned->slotBegin[n] - 2 * n;
    for (std::uint32_t i = 0; i + 2 < slotBegin_[r + 1] - slotBegin_[r]; ++i) {
      const std::uint32_t id = idOfBirth[birth + i];
      owned->floor[to + i] = id;
      owned->remover[id] = n;
    }
  });

  const std::size_t hints =
      (std::size_t(slots) + MultiTriangulation::kSlotsPerHint - 1) / MultiTriangulation::kSlotsPerHint;
  owned->creatorHint.resize(hints);
  forRange(nodes, [&](std::uint32_t n) {
    constexpr std::uint32_t k = MultiTriangulation::kSlotsPerHint;
    for (std::uint32_t h = (owned->slotBegin[n] + k - 1) / k; h * k < owned->slotBegin[n + 1]; ++h)
      owned->creatorHint[h] = n;
  });

  MtArrays a;
  a.rootVertices = rootVertexCount;
  a.rootTriangles = owned->rootTriangles;
  a.slotBegin = owned->slotBegin;
  a.link = owned->link;
  a.remover = owned->remover;
  a.error = owned->error;
  a.below = owned->below;
  a.above = owned->above;
  a.floor = owned->floor;
  a.saturatedError = owned->saturatedError;
  a.sphere = owned->sphere;
  owned->blocks = makeNodeBlocks(a.saturatedError, a.sphere);
  a.blockError = owned->blocks.error;
  a.blockSphere = owned->blocks.sphere;
  a.creatorHint = owned->creatorHint;
  a.scale = scale_;
  a.metric = metric_;
  slotBegin_.clear();
  batches_.clear();
  removals_ = 0;
  return MultiTriangulation(a, owned);
}

MultiTriangulation withVertices(const MultiTriangulation& mt, const VertexArrays& vertices,
                                std::shared_ptr<const void> owner) {
  MtArrays a = mt.arrays();
  a.vertices = vertices;
  struct Both {
    MultiTriangulation mt;
    std::shared_ptr<const void> vertices;
  };
  return MultiTriangulation(a, std::make_shared<const Both>(Both{mt, std::move(owner)}));
}

}  // namespace arete

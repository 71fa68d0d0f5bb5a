// SPDX-License-Identifier: GPL-3.0-or-later
//
// How far a chunk's nodes reach decides with how many others it has to wait for each other. A node's reach is
// the width of its star; its class is the number of widths (each four times the one before) that it or any
// node that descends from it exceeds, so no node has a parent of a lower class. The highest class is chunk 0.
// The others lie in tiles four times as wide as those of the class below. Of one class, a node's rectangle is
// its own tile and the rectangles of its parents, rounded outwards to at most 2 x 2 tiles (of the least level
// at which so few do, and no level below its parents'): as reaches are a fraction of a tile, and most parents
// are wider than their children, most rectangles are one tile. Nodes of one class and rectangle are a chunk.
//
// Chunks of one class come in Morton order of the last corner of their rectangles, which is not before that
// of a part of it; so a chunk comes soon after those that it leans on.
//
// All that nodes take from their parents, or parents from their children, is from places all over the arrays:
// it is asked for ahead (slot_owners.h). The rest goes chunk by chunk, in parallel.
#include "io/packed/plan.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <tuple>

#include "engine/base/morton.h"
#include "engine/memory/uninitialized_vector.h"

namespace arete::packed {
namespace {

/// Samples along the side of a tile of class 0. Small enough for the nodes of a tile to stay in a processor's
/// second cache or close to it, large enough that most nodes are in the inside of one.
constexpr double kTileSamples = 128;
/// A tile is so many times as wide as what a node of its class may reach.
constexpr double kReachesPerTile = 8;
/// Of a tile in tiles of the class below, and its logarithm.
constexpr int kClassStep = 4, kLevelsPerClass = 2;
constexpr int kMostClasses = 12;

void include(Box2& box, Vec2 p) {
  box.xMin = std::min(box.xMin, p.x);
  box.yMin = std::min(box.yMin, p.y);
  box.xMax = std::max(box.xMax, p.x);
  box.yMax = std::max(box.yMax, p.y);
}

struct Tiles {
  std::int32_t row = 0, column = 0, rowEnd = 0, columnEnd = 0;
  std::int32_t level = 0;
  std::uint8_t reach = 0;  ///< class

  bool operator==(const Tiles&) const = default;

  void include(const Tiles& t) {
    level = std::max(level, t.level);
    row = std::min(row, t.row);
    column = std::min(column, t.column);
    rowEnd = std::max(rowEnd, t.rowEnd);
    columnEnd = std::max(columnEnd, t.columnEnd);
  }
  /// Rounds outwards, to the least level that is not below the present one and has at most 2 x 2 tiles.
  void round() {
    for (;; ++level) {
      const std::int32_t unit = std::int32_t{1} << level;
      row &= -unit;
      column &= -unit;
      rowEnd = (rowEnd + unit - 1) & -unit;
      columnEnd = (columnEnd + unit - 1) & -unit;
      if (rowEnd - row <= 2 * unit && columnEnd - column <= 2 * unit) return;
    }
  }
  /// Smaller where chunks come earlier.
  auto key() const {
    return std::tuple(
        -int{reach},
        mortonCode(static_cast<std::uint32_t>(columnEnd - 1), static_cast<std::uint32_t>(rowEnd - 1)), level,
        (rowEnd - row) * (columnEnd - column), row, column);
  }
};

/// All that is needed to place nodes.
struct Tiling {
  double x = 0, y = 0, size = 1;  ///< where tile (0, 0) begins; a side
  int classes = 0;                ///< below that of chunk 0
};

/// Classes of about as many nodes each; nodes without error are one of their own.
void findBandClasses(const std::array<std::uint32_t, MultiTriangulation::kBands>& perBand,
                     std::uint32_t nodes, Directory& directory) {
  std::uint64_t above = 0;
  for (std::uint32_t band = MultiTriangulation::kBands; band-- > 0;) {
    directory.bandClass[band] = static_cast<std::uint8_t>(
        std::min<std::uint64_t>(kClasses - 2, above * (kClasses - 1) / std::max(nodes, 1u)));
    above += perBand[band];
  }
  directory.bandClass[0] = kClasses - 1;
}

Tiling tilingOf(const TerrainModel& model) {
  Tiling tiling;
  double width = model.columns, height = model.rows;
  if (model.isRaster) {
    tiling.size = kTileSamples;
  } else {
    const auto plan = model.mt.vertices().plan;
    if (plan.empty()) return tiling;
    Box2 box{plan[0].x, plan[0].y, plan[0].x, plan[0].y};
    for (const Vec2& p : plan) include(box, p);
    tiling.x = box.xMin;
    tiling.y = box.yMin;
    width = box.xMax - box.xMin;
    height = box.yMax - box.yMin;
    const double fit = std::sqrt(width * height / static_cast<double>(plan.size())) * kTileSamples;
    // Long thin clouds: never more than a million tiles along a side.
    const double size = std::fmax(fit, std::fmax(width, height) / 1e6);
    if (!std::isfinite(size) || !(size > 0)) return tiling;
    tiling.size = size;
  }
  for (double size = tiling.size; size < std::max(width, height) && tiling.classes < kMostClasses;
       size *= kClassStep)
    ++tiling.classes;
  return tiling;
}

/// What a node has of its own star and floor, and what it takes over from its children.
struct Descent {
  std::uint16_t error = 0;  ///< saturated, as the recorder has it: the largest of its floor's and theirs
  std::uint8_t reach = 0;   ///< class
};

/// A node's own.
Descent ownOf(const MultiTriangulation& mt, NodeId n, const Tiling& tiling) {
  const MtArrays& a = mt.arrays();
  Descent own;
  for (const std::uint32_t t : mt.floor(n)) own.error = std::max(own.error, a.error[t]);
  const Vec2 apex = a.vertices.planPosition(mt.apex(n));
  Box2 box{apex.x, apex.y, apex.x, apex.y};
  for (const std::uint32_t v : mt.link(n)) include(box, a.vertices.planPosition(VertexId(v)));
  const double width = std::max(box.xMax - box.xMin, box.yMax - box.yMin);
  double most = tiling.size / kReachesPerTile;
  for (; own.reach < tiling.classes && width > most; most *= kClassStep) ++own.reach;
  return own;
}

/// What nodes take from their parents, or give to them, one floor after the other: asks ahead for it.
class Parents {
 public:
  Parents(const MultiTriangulation& mt, const SlotToNode& owners)
      : floor_(mt.arrays().floor),
        owners_(owners),
        roots_(mt.rootTriangleCount()),
        slots_(static_cast<std::uint32_t>(mt.arrays().link.size())) {}

  /// Calls visit(parent) of the i-th entry of all floors, unless that is a triangle of the root. `ofParents`:
  /// what visit() reads by parent; it will be asked for of the entries on the way, a step of 1 or -1.
  template <class T, class Visit>
  [[gnu::always_inline]] void at(std::uint32_t i, int step, const T* ofParents, const Visit& visit) const {
    const std::uint32_t far = slotAt(i + kFarAhead * step), near = slotAt(i + kAhead * step);
    if (far < slots_) owners_.prefetch(far);
    if (near < slots_) __builtin_prefetch(ofParents + owners_.of(near));
    if (const std::uint32_t slot = slotAt(i); slot < slots_) visit(owners_.of(slot));
  }

 private:
  /// Not below slots_ for a triangle of the root, and beyond either end.
  std::uint32_t slotAt(std::int64_t i) const {
    if (i < 0 || i >= static_cast<std::int64_t>(floor_.size())) return ~0u;
    return floor_[static_cast<std::size_t>(i)] - roots_;
  }

  static constexpr std::int64_t kAhead = 32, kFarAhead = 64;  // entries of floors
  std::span<const std::uint32_t> floor_;
  const SlotToNode& owners_;
  std::uint32_t roots_, slots_;
};

std::uint32_t floorBegin(const MtArrays& a, std::uint32_t n) {
  return a.slotBegin[n] - 2 * n;
}

/// Of all nodes.
UninitializedVector<Descent> descentsOf(const MultiTriangulation& mt, const Parents& parents,
                                        const Tiling& tiling) {
  UninitializedVector<Descent> descents(mt.nodeCount());
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, mt.nodeCount(), 4096), [&](const auto& range) {
    for (std::uint32_t n = range.begin(); n != range.end(); ++n) descents[n] = ownOf(mt, NodeId(n), tiling);
  });
  for (std::uint32_t n = mt.nodeCount(); n-- > 0;)
    for (std::uint32_t i = floorBegin(mt.arrays(), n + 1); i-- > floorBegin(mt.arrays(), n);)
      parents.at(i, -1, descents.data(), [&](std::uint32_t parent) {
        Descent& d = descents[parent];
        d.error = std::max(d.error, descents[n].error);
        d.reach = std::max(d.reach, descents[n].reach);
      });
  return descents;
}

/// Finds the rectangle of every node, and numbers rectangles as they come.
class Tiler {
 public:
  Tiler(const MultiTriangulation& mt, const Parents& parents, const Tiling& tiling)
      : a_(mt.arrays()), parents_(parents), tiling_(tiling), rectangleOf_(mt.nodeCount()) {
    rectangles_.push_back({.reach = static_cast<std::uint8_t>(tiling.classes)});
    numbers_[rectangles_[0].key()] = 0;
  }

  void run(std::span<const Descent> descents) {
    for (std::uint32_t n = 0; n < descents.size(); ++n)
      rectangleOf_[n] = descents[n].reach == tiling_.classes ? 0 : rectangleOf(n, descents[n].reach);
  }
  /// Per rectangle, which one in the order of keys it is.
  std::vector<std::uint32_t> order() const {
    std::vector<std::uint32_t> order(rectangles_.size());
    std::uint32_t next = 0;
    for (const auto& [key, number] : numbers_) order[number] = next++;
    return order;
  }
  /// Per node. Leaves nothing.
  UninitializedVector<std::uint32_t> take() { return std::move(rectangleOf_); }

 private:
  std::uint32_t rectangleOf(std::uint32_t n, std::uint8_t reach) {
    const Vec2 p = a_.vertices.planPosition(VertexId(a_.rootVertices + n));
    const auto row = static_cast<std::int32_t>((p.y - tiling_.y) / tiling_.size);
    const auto column = static_cast<std::int32_t>((p.x - tiling_.x) / tiling_.size);
    Tiles tiles{row, column, row + 1, column + 1, kLevelsPerClass * reach, reach};
    std::uint32_t likely = last_;
    for (std::uint32_t i = floorBegin(a_, n); i != floorBegin(a_, n + 1); ++i)
      parents_.at(i, 1, rectangleOf_.data(), [&](std::uint32_t parent) {
        const Tiles& parentTiles = rectangles_[rectangleOf_[parent]];
        if (parentTiles.reach != reach) return;
        tiles.include(parentTiles);
        likely = rectangleOf_[parent];
      });
    tiles.round();
    if (rectangles_[likely] != tiles) likely = numberOf(tiles);
    return last_ = likely;
  }
  std::uint32_t numberOf(const Tiles& tiles) {
    const auto [at, isNew] =
        numbers_.try_emplace(tiles.key(), static_cast<std::uint32_t>(rectangles_.size()));
    if (isNew) rectangles_.push_back(tiles);
    return at->second;
  }

  const MtArrays& a_;
  const Parents& parents_;
  const Tiling& tiling_;
  UninitializedVector<std::uint32_t> rectangleOf_;
  std::vector<Tiles> rectangles_;
  std::map<decltype(Tiles().key()), std::uint32_t> numbers_;
  std::uint32_t last_ = 0;
};

/// Nodes by chunk, those of each rising.
struct NodesByChunk {
  UninitializedVector<std::uint32_t> nodes;
  std::vector<std::uint32_t> begin;  ///< per chunk, and the end

  NodesByChunk(std::span<const std::uint32_t> chunkOf, std::size_t chunks)
      : nodes(chunkOf.size()), begin(chunks + 1, 0) {
    for (const std::uint32_t c : chunkOf) ++begin[c + 1];
    for (std::size_t c = 0; c < chunks; ++c) begin[c + 1] += begin[c];
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (std::uint32_t n = 0; n < chunkOf.size(); ++n) nodes[next[chunkOf[n]]++] = n;
  }
  std::span<const std::uint32_t> of(std::size_t chunk) const {
    return std::span(nodes).subspan(begin[chunk], begin[chunk + 1] - begin[chunk]);
  }
};

void leanOn(Chunk& chunk, std::uint32_t other) {
  const auto at = std::ranges::lower_bound(chunk.leansOn, other);
  if (at == chunk.leansOn.end() || *at != other) chunk.leansOn.insert(at, other);
}

/// All that the plan says of a chunk and its nodes. Counts borders of the chunks that it leans on.
void describe(const MultiTriangulation& mt, std::uint32_t c, std::span<const std::uint32_t> nodes,
              Plan& plan) {
  const MtArrays& a = mt.arrays();
  const std::uint32_t roots = mt.rootTriangleCount();
  Chunk& chunk = plan.directory.chunks[c];
  if (c > 0) chunk.leansOn.push_back(0);
  Box2 box{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  std::array<Run, MultiTriangulation::kBands> runs;
  for (const std::uint32_t n : nodes) {
    plan.ownParents[n] = 0;
    for (const std::uint32_t t : mt.floor(NodeId(n))) {
      if (t < roots) continue;
      const std::uint32_t parent = plan.chunkOf[plan.owners.of(t - roots)];
      if (parent == c) {
        ++plan.ownParents[n];
      } else {
        leanOn(chunk, parent);
        std::atomic_ref(plan.directory.chunks[parent].borders).fetch_add(1, std::memory_order_relaxed);
      }
    }
    Run& run = runs[plan.band[n]];
    ++run.nodes;
    run.slots += mt.slotCount(NodeId(n));
    if (plan.ownParents[n] == 0) {
      ++run.listed;
      plan.listed[c].push_back(n);
    }
    include(box, a.vertices.planPosition(mt.apex(NodeId(n))));
    for (const std::uint32_t v : mt.link(NodeId(n))) include(box, a.vertices.planPosition(VertexId(v)));
  }
  chunk.xMin = box.xMin;
  chunk.yMin = box.yMin;
  chunk.xMax = box.xMax;
  chunk.yMax = box.yMax;
  for (std::uint32_t band = MultiTriangulation::kBands; band-- > 0;) {
    if (runs[band].nodes == 0) continue;
    runs[band].band = band;
    chunk.runs.push_back(runs[band]);
  }
}

}  // namespace

Plan planChunks(const TerrainModel& model) {
  const MultiTriangulation& mt = model.mt;
  const std::uint32_t nodes = mt.nodeCount();
  Plan plan(mt.arrays());
  std::vector<std::uint32_t> order;
  {
    const Tiling tiling = tilingOf(model);
    const Parents parents(mt, plan.owners);
    const auto descents = descentsOf(mt, parents, tiling);
    plan.band.resize(nodes);
    std::array<std::uint32_t, MultiTriangulation::kBands> perBand{};
    for (std::uint32_t n = 0; n < nodes; ++n) {
      plan.band[n] = static_cast<std::uint8_t>(MultiTriangulation::bandOf(descents[n].error));
      ++perBand[plan.band[n]];
    }
    findBandClasses(perBand, nodes, plan.directory);
    Tiler tiler(mt, parents, tiling);
    tiler.run(descents);
    order = tiler.order();
    plan.chunkOf = tiler.take();
  }
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, nodes, 1 << 14), [&](const auto& range) {
    for (std::uint32_t n = range.begin(); n != range.end(); ++n) plan.chunkOf[n] = order[plan.chunkOf[n]];
  });
  plan.directory.chunks.resize(order.size());
  plan.ownParents.resize(nodes);
  plan.listed.resize(order.size());
  const NodesByChunk nodesBy(plan.chunkOf, order.size());
  tbb::parallel_for(std::size_t{0}, order.size(),
                    [&](std::size_t c) { describe(mt, static_cast<std::uint32_t>(c), nodesBy.of(c), plan); });
  plan.directory.number();
  return plan;
}

}  // namespace arete::packed

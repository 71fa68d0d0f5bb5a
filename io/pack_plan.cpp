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
#include "io/pack_plan.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "engine/morton.h"

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

struct Tiles {
  std::int32_t row = 0, column = 0, rowEnd = 0, columnEnd = 0;
  std::int32_t level = 0;
  std::uint8_t reach = 0;  ///< class

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

/// As the recorder has them: the largest of the floor's errors and the children's saturated errors.
void findSaturatedErrors(const MultiTriangulation& mt, Plan& plan) {
  plan.saturatedError.assign(mt.nodeCount(), 0);
  for (std::uint32_t n = mt.nodeCount(); n-- > 0;) {
    std::uint16_t& own = plan.saturatedError[n];
    for (const std::uint32_t t : mt.floor(NodeId(n))) own = std::max(own, mt.arrays().error[t]);
    for (const std::uint32_t t : mt.floor(NodeId(n)))
      if (t >= mt.rootTriangleCount()) {
        std::uint16_t& parent = plan.saturatedError[plan.creator[t - mt.rootTriangleCount()]];
        parent = std::max(parent, own);
      }
  }
}

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
    double xMax = plan[0].x, yMax = plan[0].y;
    tiling.x = xMax;
    tiling.y = yMax;
    for (const Vec2& p : plan) {
      tiling.x = std::min(tiling.x, p.x);
      tiling.y = std::min(tiling.y, p.y);
      xMax = std::max(xMax, p.x);
      yMax = std::max(yMax, p.y);
    }
    width = xMax - tiling.x;
    height = yMax - tiling.y;
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

/// Per node, its class.
std::vector<std::uint8_t> reachesOf(const MultiTriangulation& mt, const std::vector<std::uint32_t>& creator,
                                    const Tiling& tiling) {
  const auto& vertices = mt.arrays().vertices;
  std::vector<std::uint8_t> reaches(mt.nodeCount(), 0);
  for (std::uint32_t n = mt.nodeCount(); n-- > 0;) {
    const Vec2 apex = vertices.planPosition(mt.apex(NodeId(n)));
    double xMin = apex.x, yMin = apex.y, xMax = apex.x, yMax = apex.y;
    for (const std::uint32_t v : mt.link(NodeId(n))) {
      const Vec2 p = vertices.planPosition(VertexId(v));
      xMin = std::min(xMin, p.x);
      yMin = std::min(yMin, p.y);
      xMax = std::max(xMax, p.x);
      yMax = std::max(yMax, p.y);
    }
    const double width = std::max(xMax - xMin, yMax - yMin);
    double most = tiling.size / kReachesPerTile;
    std::uint8_t own = 0;
    for (; own < tiling.classes && width > most; most *= kClassStep) ++own;
    reaches[n] = std::max(reaches[n], own);
    for (const std::uint32_t t : mt.floor(NodeId(n)))
      if (t >= mt.rootTriangleCount()) {
        std::uint8_t& parent = reaches[creator[t - mt.rootTriangleCount()]];
        parent = std::max(parent, reaches[n]);
      }
  }
  return reaches;
}

void leanOn(Chunk& chunk, std::uint32_t other) {
  const auto at = std::ranges::lower_bound(chunk.leansOn, other);
  if (at == chunk.leansOn.end() || *at != other) chunk.leansOn.insert(at, other);
}

}  // namespace

Plan planChunks(const TerrainModel& model) {
  const MultiTriangulation& mt = model.mt;
  const MtArrays& a = mt.arrays();
  const std::uint32_t nodes = mt.nodeCount(), roots = mt.rootTriangleCount();
  Plan plan;
  plan.creator.resize(a.link.size());
  for (std::uint32_t n = 0; n < nodes; ++n)
    std::fill(plan.creator.begin() + a.slotBegin[n], plan.creator.begin() + a.slotBegin[n + 1], n);
  findSaturatedErrors(mt, plan);

  std::array<std::uint32_t, MultiTriangulation::kBands> perBand{};
  for (const std::uint16_t code : plan.saturatedError) ++perBand[MultiTriangulation::bandOf(code)];
  findBandClasses(perBand, nodes, plan.directory);

  const Tiling tiling = tilingOf(model);
  const std::vector<std::uint8_t> reaches = reachesOf(mt, plan.creator, tiling);
  std::vector<Tiles> tiles(nodes);
  std::map<decltype(Tiles().key()), std::uint32_t> chunks;
  const Tiles first{.reach = static_cast<std::uint8_t>(tiling.classes)};
  chunks[first.key()] = 0;
  for (std::uint32_t n = 0; n < nodes; ++n) {
    if (reaches[n] == tiling.classes) {
      tiles[n] = first;
      continue;
    }
    const Vec2 p = a.vertices.planPosition(mt.apex(NodeId(n)));
    const auto row = static_cast<std::int32_t>((p.y - tiling.y) / tiling.size);
    const auto column = static_cast<std::int32_t>((p.x - tiling.x) / tiling.size);
    tiles[n] = {row, column, row + 1, column + 1, kLevelsPerClass * reaches[n], reaches[n]};
    for (const std::uint32_t t : mt.floor(NodeId(n)))
      if (t >= roots && reaches[plan.creator[t - roots]] == reaches[n])
        tiles[n].include(tiles[plan.creator[t - roots]]);
    tiles[n].round();
    chunks[tiles[n].key()] = 0;
  }
  for (auto& [key, index] : chunks) {
    index = static_cast<std::uint32_t>(plan.directory.chunks.size());
    Chunk& chunk = plan.directory.chunks.emplace_back();
    if (index > 0) chunk.leansOn.push_back(0);
    chunk.xMin = chunk.yMin = HUGE_VAL;
    chunk.xMax = chunk.yMax = -HUGE_VAL;
  }

  plan.chunkOf.resize(nodes);
  for (std::uint32_t n = 0; n < nodes; ++n) plan.chunkOf[n] = chunks[tiles[n].key()];
  plan.ownParents.assign(nodes, 0);
  plan.listed.resize(plan.directory.chunks.size());
  std::vector<std::array<Run, MultiTriangulation::kBands>> runs(plan.directory.chunks.size());
  for (std::uint32_t n = 0; n < nodes; ++n) {
    const std::uint32_t c = plan.chunkOf[n];
    for (const std::uint32_t t : mt.floor(NodeId(n))) {
      if (t < roots) continue;
      const std::uint32_t parent = plan.chunkOf[plan.creator[t - roots]];
      if (parent == c) {
        ++plan.ownParents[n];
      } else {
        leanOn(plan.directory.chunks[c], parent);
        ++plan.directory.chunks[parent].borders;
      }
    }
    Run& run = runs[c][MultiTriangulation::bandOf(plan.saturatedError[n])];
    ++run.nodes;
    run.slots += mt.slotCount(NodeId(n));
    if (plan.ownParents[n] == 0) {
      ++run.listed;
      plan.listed[c].push_back(n);
    }
    Chunk& chunk = plan.directory.chunks[c];
    const auto include = [&](Vec2 p) {
      chunk.xMin = std::min(chunk.xMin, p.x);
      chunk.yMin = std::min(chunk.yMin, p.y);
      chunk.xMax = std::max(chunk.xMax, p.x);
      chunk.yMax = std::max(chunk.yMax, p.y);
    };
    include(a.vertices.planPosition(mt.apex(NodeId(n))));
    for (const std::uint32_t v : mt.link(NodeId(n))) include(a.vertices.planPosition(VertexId(v)));
  }
  for (std::size_t c = 0; c < runs.size(); ++c)
    for (std::uint32_t band = MultiTriangulation::kBands; band-- > 0;) {
      if (runs[c][band].nodes == 0) continue;
      runs[c][band].band = band;
      plan.directory.chunks[c].runs.push_back(runs[c][band]);
    }
  plan.directory.number();
  return plan;
}

}  // namespace arete::packed

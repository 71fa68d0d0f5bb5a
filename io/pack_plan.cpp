// SPDX-License-Identifier: GPL-3.0-or-later
//
// Nodes of the highest bands, at most one in 16, are chunk 0: coarse nodes reach far, and every question
// needs them. The other ones reach a few samples beyond their own tile. A node's rectangle holds those of its
// parents, so parents are in chunks that are read before; few rectangles are of more than 2 x 2 tiles.
#include "io/pack_plan.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace arete::packed {
namespace {

constexpr std::uint32_t kNone = MultiTriangulation::kNone;
constexpr std::uint32_t kCoarsePart = 16;
/// Samples along a tile's side. Small enough for the nodes of a tile to stay in a processor's second cache or
/// close to it, large enough that most nodes are in the inside of one.
constexpr double kTileSamples = 128;

struct Tiles {
  std::int32_t row = 0, column = 0, rowEnd = 0, columnEnd = 0;
  std::int32_t level = 0;
  bool isCoarse = false;

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
  Chunk::Kind kind() const {
    if (isCoarse) return Chunk::Kind::coarse;
    const std::int32_t rows = (rowEnd - row) >> level, columns = (columnEnd - column) >> level;
    return rows * columns == 1   ? Chunk::Kind::one
           : rows * columns == 2 ? Chunk::Kind::two
                                 : Chunk::Kind::four;
  }
  auto key() const {
    const Chunk::Kind k = kind();
    return isCoarse ? std::tuple(-1, k, 0, 0, 0, 0) : std::tuple(level, k, row, column, rowEnd, columnEnd);
  }
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

void placeTiles(const TerrainModel& model, Directory& directory) {
  if (model.isRaster) {
    directory.tileSize = kTileSamples;
    return;
  }
  double xMax = 0, yMax = 0;
  const auto plan = model.mt.vertices().plan;
  if (plan.empty()) return;
  directory.tileX = xMax = plan[0].x;
  directory.tileY = yMax = plan[0].y;
  for (const Vec2& p : plan) {
    directory.tileX = std::min(directory.tileX, p.x);
    directory.tileY = std::min(directory.tileY, p.y);
    xMax = std::max(xMax, p.x);
    yMax = std::max(yMax, p.y);
  }
  const double width = xMax - directory.tileX, height = yMax - directory.tileY;
  const double fit = std::sqrt(width * height / static_cast<double>(plan.size())) * kTileSamples;
  // Long thin clouds: never more than a million tiles along a side.
  const double size = std::fmax(fit, std::fmax(width, height) / 1e6);
  directory.tileSize = std::isfinite(size) && size > 0 ? size : 1;
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
  std::uint32_t lowestCoarse = MultiTriangulation::kBands;
  for (std::uint32_t coarse = 0; lowestCoarse > 0; --lowestCoarse) {
    coarse += perBand[lowestCoarse - 1];
    if (coarse > nodes / kCoarsePart) break;
  }
  placeTiles(model, plan.directory);

  std::vector<Tiles> tiles(nodes);
  std::map<decltype(Tiles().key()), std::uint32_t> chunks;
  chunks[Tiles{.isCoarse = true}.key()] = 0;
  for (std::uint32_t n = 0; n < nodes; ++n) {
    if (MultiTriangulation::bandOf(plan.saturatedError[n]) >= lowestCoarse) {
      tiles[n].isCoarse = true;
      continue;
    }
    const Vec2 p = a.vertices.planPosition(mt.apex(NodeId(n)));
    const auto row = static_cast<std::int32_t>((p.y - plan.directory.tileY) / plan.directory.tileSize);
    const auto column = static_cast<std::int32_t>((p.x - plan.directory.tileX) / plan.directory.tileSize);
    tiles[n] = {row, column, row + 1, column + 1, 0, false};
    for (const std::uint32_t t : mt.floor(NodeId(n)))
      if (t >= roots && !tiles[plan.creator[t - roots]].isCoarse)
        tiles[n].include(tiles[plan.creator[t - roots]]);
    tiles[n].round();
    chunks[tiles[n].key()] = 0;
  }
  for (auto& [key, index] : chunks) {
    index = static_cast<std::uint32_t>(plan.directory.chunks.size());
    Chunk& chunk = plan.directory.chunks.emplace_back();
    chunk.kind = std::get<1>(key);
    if (chunk.kind != Chunk::Kind::coarse) chunk.level = static_cast<std::uint8_t>(std::get<0>(key));
    chunk.row = static_cast<std::uint32_t>(std::get<2>(key));
    chunk.column = static_cast<std::uint32_t>(std::get<3>(key));
    chunk.rowEnd = static_cast<std::uint32_t>(std::get<4>(key));
    chunk.columnEnd = static_cast<std::uint32_t>(std::get<5>(key));
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
    for (const std::uint32_t t : mt.floor(NodeId(n)))
      if (t >= roots && plan.chunkOf[plan.creator[t - roots]] == c) ++plan.ownParents[n];
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

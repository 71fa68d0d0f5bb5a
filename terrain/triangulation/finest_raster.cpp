// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles are laid out tile by tile, the tiles along a Hilbert curve, so that those near each other in
// memory are near each other on the ground at every scale: the nodes of a build inherit the order, and the
// blocks of a cut are as tight as it makes them (docs/decisions/0008).
//
// The mesh needs no search for neighbours: what a cell holds follows from which of its corners are valid, and
// across an edge lies the cell above, below, left or right. One pass counts the triangles of each tile, the
// next numbers the cells, the last writes triangles and twins; all are parallel over tiles. An outgoing
// half-edge without a twin begins a fan of its vertex; a vertex with two of them is pinched.
#include "terrain/triangulation/finest_raster.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <utility>

#include "engine/parallel/loop_threads.h"
#include "terrain/model/raster_cells.h"

namespace arete {
namespace {

constexpr std::uint32_t kTile = 32;
constexpr std::uint32_t kNone = LiveMesh::kNone;

/// Counted in tiles.
struct Tile {
  std::uint32_t column, row;
};

/// A place of the curve of Hilbert (1891) through a square with so many tiles, a power of two, along a side.
Tile onCurve(std::uint64_t place, std::uint32_t side) {
  Tile tile{0, 0};
  for (std::uint32_t half = 1; half < side; half *= 2, place /= 4) {
    const std::uint32_t right = place >> 1 & 1, down = (place ^ right) & 1;
    if (down == 0) {
      if (right == 1) tile = {half - 1 - tile.column, half - 1 - tile.row};
      std::swap(tile.column, tile.row);
    }
    tile.column += half * right;
    tile.row += half * down;
  }
  return tile;
}

/// The cells of a raster, tile by tile.
class Cells : public RasterCells {
 public:
  /// Squares side by side, a curve through each.
  explicit Cells(const RasterHeightfield& field) : RasterCells(field) {
    const std::uint32_t across = (field.columns - 1 + kTile - 1) / kTile,
                        down = (field.rows - 1 + kTile - 1) / kTile,
                        side = std::bit_ceil(std::min(across, down));
    tiles_.reserve(std::size_t(across) * down);
    for (std::uint32_t top = 0; top < down; top += side)
      for (std::uint32_t left = 0; left < across; left += side)
        for (std::uint64_t place = 0; place < std::uint64_t(side) * side; ++place) {
          const Tile tile = onCurve(place, side);
          if (left + tile.column < across && top + tile.row < down)
            tiles_.push_back({left + tile.column, top + tile.row});
        }
  }

  std::size_t tileCount() const { return tiles_.size(); }

  /// visit(column, row) for the cells of a tile, row by row.
  template <class Visit>
  void forTile(std::size_t tile, const Visit& visit) const {
    const std::uint32_t left = tiles_[tile].column * kTile, top = tiles_[tile].row * kTile;
    for (std::uint32_t row = top; row < std::min(top + kTile, field_.rows - 1); ++row)
      for (std::uint32_t column = left; column < std::min(left + kTile, field_.columns - 1); ++column)
        visit(column, row);
  }

  // The half-edges of the triangles that forTriangles() gives, by what they are to the cell, whose first
  // triangle is `first`; kNone where it has no such edge.
  static std::uint32_t topEdge(unsigned valid, std::uint32_t first) {
    return (valid & 3) == 3 && triangleCount(valid) > 0 ? LiveMesh::halfedge(first, 0) : kNone;
  }
  static std::uint32_t rightEdge(unsigned valid, std::uint32_t first) {
    if ((valid & 10) != 10 || triangleCount(valid) == 0) return kNone;
    return LiveMesh::halfedge(first, (valid & upperLeft) != 0 ? 1 : 0);
  }
  static std::uint32_t bottomEdge(unsigned valid, std::uint32_t first) {
    if ((valid & 12) != 12 || triangleCount(valid) == 0) return kNone;
    return LiveMesh::halfedge(first + (valid == all ? 1 : 0), 1);
  }
  static std::uint32_t leftEdge(unsigned valid, std::uint32_t first) {
    if ((valid & 5) != 5 || triangleCount(valid) == 0) return kNone;
    return LiveMesh::halfedge(first + (valid == all ? 1 : 0), 2);
  }

 private:
  std::vector<Tile> tiles_;
};

bool hasCells(const RasterHeightfield& field) {
  return field.columns >= 2 && field.rows >= 2;
}

/// What a mesh is laid out from: per cell, by its upper left sample, its valid corners and its first
/// triangle. The last sample of a row, and of a column, has no cell. Left of a row is the end of the one
/// before, and before the first row a row of nothing, so no neighbour need be asked whether it is there.
class MeshLayout {
 public:
  MeshLayout(const RasterHeightfield& field, const Cells& cells)
      : cells_(cells),
        columns_(field.columns),
        validCorners_(field.size() + field.columns, 0),
        firstTriangles_(field.size() + field.columns) {
    const std::size_t tiles = cells.tileCount();
    std::uint8_t* const valid = validCorners_.data() + columns_;
    std::uint32_t* const first = firstTriangles_.data() + columns_;
    std::vector<std::uint32_t> tileFirst(tiles + 1, 0);
    tbb::parallel_for(std::size_t(0), tiles, [&](std::size_t tile) {
      std::uint32_t count = 0;
      cells.forTile(tile, [&](std::uint32_t column, std::uint32_t row) {
        const unsigned corners = cells.valid(column, row);
        valid[field.index(column, row)] = static_cast<std::uint8_t>(corners);
        count += Cells::triangleCount(corners);
      });
      tileFirst[tile + 1] = count;
    });
    for (std::size_t tile = 0; tile < tiles; ++tile) tileFirst[tile + 1] += tileFirst[tile];
    tbb::parallel_for(std::size_t(0), tiles, [&](std::size_t tile) {
      std::uint32_t next = tileFirst[tile];
      cells.forTile(tile, [&](std::uint32_t column, std::uint32_t row) {
        const std::uint32_t cell = field.index(column, row);
        first[cell] = next;
        next += Cells::triangleCount(valid[cell]);
      });
    });
    triangleCount_ = tileFirst[tiles];
  }

  std::uint32_t triangleCount() const { return triangleCount_; }

  /// Writes the triangles of a cell, twins and all. leave(v, h): half-edge h leaves v; of a cell's, at least
  /// the last of each vertex, and each without a twin.
  template <class Leave>
  void lay(std::uint32_t column, std::uint32_t row, LiveMesh& mesh, const Leave& leave) const {
    const std::size_t cell = std::size_t(row) * columns_ + column + columns_;
    const std::uint8_t* const valid = validCorners_.data() + cell;
    const std::uint32_t* const first = firstTriangles_.data() + cell;
    const std::ptrdiff_t down = columns_;
    if ((valid[0] & valid[-down] & valid[1] & valid[down] & valid[-1]) == Cells::all) {
      layWhole(static_cast<std::uint32_t>(cell) - columns_, first, mesh, leave);
      return;
    }
    const std::uint32_t begin = first[0], end = begin + Cells::triangleCount(valid[0]);
    if (begin == end) return;
    std::uint32_t t = begin;
    cells_.forTriangles(column, row, valid[0], [&](const LiveMesh::Corners& corners) {
      mesh.triangles[t] = {corners, {kNone, kNone, kNone}, t, kNone};
      ++t;
    });
    if (valid[0] == Cells::all) {
      mesh.setTwin(LiveMesh::halfedge(begin, 2), LiveMesh::halfedge(begin + 1, 0));
      mesh.setTwin(LiveMesh::halfedge(begin + 1, 0), LiveMesh::halfedge(begin, 2));
    }
    const auto join = [&](std::uint32_t own, std::uint32_t beyond) {
      if (own != kNone) mesh.setTwin(own, beyond);
    };
    join(Cells::topEdge(valid[0], begin), Cells::bottomEdge(valid[-down], first[-down]));
    join(Cells::rightEdge(valid[0], begin), Cells::leftEdge(valid[1], first[1]));
    join(Cells::bottomEdge(valid[0], begin), Cells::topEdge(valid[down], first[down]));
    join(Cells::leftEdge(valid[0], begin), Cells::rightEdge(valid[-1], first[-1]));
    for (t = begin; t < end; ++t)
      for (std::uint32_t side = 0; side < 3; ++side)
        leave(mesh.triangles[t].corners[side], LiveMesh::halfedge(t, side));
  }

 private:
  /// Of nearly all cells: with all corners, and so have their neighbours.
  template <class Leave>
  void layWhole(std::uint32_t ul, const std::uint32_t* first, LiveMesh& mesh, const Leave& leave) const {
    const std::uint32_t t = first[0], ur = ul + 1, ll = ul + columns_, lr = ll + 1;
    const std::ptrdiff_t down = columns_;
    mesh.triangles[t] = {{ul, ur, lr},
                         {LiveMesh::halfedge(first[-down] + 1, 1), LiveMesh::halfedge(first[1] + 1, 2),
                          LiveMesh::halfedge(t + 1, 0)},
                         t,
                         kNone};
    mesh.triangles[t + 1] = {
        {ul, lr, ll},
        {LiveMesh::halfedge(t, 2), LiveMesh::halfedge(first[down], 0), LiveMesh::halfedge(first[-1], 1)},
        t + 1,
        kNone};
    leave(ur, LiveMesh::halfedge(t, 1));
    for (const auto& [v, side] : {std::pair(ul, 0u), {lr, 1u}, {ll, 2u}})
      leave(v, LiveMesh::halfedge(t + 1, side));
  }

  const Cells& cells_;
  std::uint32_t columns_;
  std::vector<std::uint8_t> validCorners_;
  UninitializedVector<std::uint32_t> firstTriangles_;
  std::uint32_t triangleCount_ = 0;
};

}  // namespace

std::vector<std::array<std::uint32_t, 3>> finestTriangulation(const RasterHeightfield& heightfield) {
  std::vector<std::array<std::uint32_t, 3>> triangles;
  if (!hasCells(heightfield)) return triangles;
  triangles.reserve(std::size_t(heightfield.columns - 1) * (heightfield.rows - 1) * 2);
  const Cells cells(heightfield);
  for (std::size_t tile = 0; tile < cells.tileCount(); ++tile)
    cells.forTile(tile, [&](std::uint32_t column, std::uint32_t row) {
      cells.forTriangles(column, row, cells.valid(column, row),
                         [&](const LiveMesh::Corners& corners) { triangles.push_back(corners); });
    });
  return triangles;
}

LiveMesh finestMesh(const RasterHeightfield& heightfield, std::vector<std::uint32_t>& pinched) {
  LiveMesh mesh;
  if (!hasCells(heightfield)) return mesh;
  const Cells cells(heightfield);
  const MeshLayout layout(heightfield, cells);
  mesh.triangles = PagedArray<LiveMesh::Triangle>(layout.triangleCount());
  mesh.vertexHalfedge.resize(heightfield.size());
  forRanges(LoopThreads::all, heightfield.size(), 1 << 16, [&](std::size_t begin, std::size_t end) {
    std::fill(&mesh.vertexHalfedge[begin], &mesh.vertexHalfedge[begin] + (end - begin), kNone);
  });
  std::vector<std::vector<std::uint32_t>> borders(cells.tileCount());  // half-edges without a twin
  // A vertex goes by the last half-edge that leaves it; those between tiles are claimed by several.
  const auto claim = [&](std::uint32_t v, std::uint32_t h) {
    const std::atomic_ref last(mesh.vertexHalfedge[v]);
    std::uint32_t seen = last.load(std::memory_order_relaxed);
    while ((seen == kNone || seen < h) && !last.compare_exchange_weak(seen, h, std::memory_order_relaxed)) {
    }
  };
  tbb::parallel_for(std::size_t(0), cells.tileCount(), [&](std::size_t tile) {
    cells.forTile(tile, [&](std::uint32_t column, std::uint32_t row) {
      const bool isInside = (column + 1) % kTile > 1 && (row + 1) % kTile > 1;
      layout.lay(column, row, mesh, [&](std::uint32_t v, std::uint32_t h) {
        if (isInside)
          mesh.vertexHalfedge[v] = h;
        else
          claim(v, h);
        if (mesh.twinOf(h) == kNone) borders[tile].push_back(h);
      });
    });
  });

  for (const std::vector<std::uint32_t>& border : borders)
    for (const std::uint32_t h : border) mesh.vertexHalfedge[mesh.origin(h)] = h;
  for (const std::vector<std::uint32_t>& border : borders)
    for (const std::uint32_t h : border)
      if (mesh.vertexHalfedge[mesh.origin(h)] != h) pinched.push_back(mesh.origin(h));
  return mesh;
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangles are laid out in squares of 32 x 32 cells, the squares along a Hilbert curve [Hilbert1891], so
// that triangles near each other in memory are near each other on the ground at every scale. The nodes of a
// build inherit the order, which makes the blocks of a cut compact (docs/decisions/0008).
//
// The mesh needs no search for neighbours: the triangles of a cell follow from which of its corners are
// valid, and across an edge lies the cell above, below, left or right. One pass counts the triangles of each
// square, the next numbers the cells, the last writes triangles and twins; all are parallel over squares. An
// outgoing half-edge without a twin begins a fan of its vertex; a vertex with two of them is pinched.
#include "terrain/triangulation/finest_raster.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <utility>

#include "engine/parallel/loop_threads.h"
#include "engine/parallel/parallel_loops.h"
#include "terrain/model/raster_cells.h"

namespace arete {
namespace {

constexpr std::uint32_t kSquare = 32;  // cells along a side

HalfedgeId halfedgeOf(std::uint32_t slot, std::uint32_t side) {
  return LiveMesh::halfedge(SlotId(slot), side);
}

/// A square of cells, by its column and row among the squares.
struct Square {
  std::uint32_t column, row;
};

/// The i-th square on the Hilbert curve [Hilbert1891] through `side` x `side` squares. Precondition: `side`
/// is a power of two.
Square onCurve(std::uint64_t i, std::uint32_t side) {
  Square square{0, 0};
  for (std::uint32_t half = 1; half < side; half *= 2, i /= 4) {
    const std::uint32_t right = i >> 1 & 1, down = (i ^ right) & 1;
    if (down == 0) {
      if (right == 1) square = {half - 1 - square.column, half - 1 - square.row};
      std::swap(square.column, square.row);
    }
    square.column += half * right;
    square.row += half * down;
  }
  return square;
}

/// The cells of a raster, square by square.
class Cells : public RasterCells {
 public:
  /// Divides the raster into large squares side by side, with a curve through each.
  explicit Cells(const RasterHeightfield& field) : RasterCells(field) {
    const std::uint32_t across = (field.columns - 1 + kSquare - 1) / kSquare,
                        down = (field.rows - 1 + kSquare - 1) / kSquare,
                        side = std::bit_ceil(std::min(across, down));
    squares_.reserve(std::size_t(across) * down);
    for (std::uint32_t top = 0; top < down; top += side)
      for (std::uint32_t left = 0; left < across; left += side)
        for (std::uint64_t i = 0; i < std::uint64_t(side) * side; ++i) {
          const Square square = onCurve(i, side);
          if (left + square.column < across && top + square.row < down)
            squares_.push_back({left + square.column, top + square.row});
        }
  }

  std::size_t squareCount() const { return squares_.size(); }

  /// visit(column, row) for the cells of a square, row by row.
  template <class Visit>
  void forSquare(std::size_t square, const Visit& visit) const {
    const std::uint32_t left = squares_[square].column * kSquare, top = squares_[square].row * kSquare;
    for (std::uint32_t row = top; row < std::min(top + kSquare, field_.rows - 1); ++row)
      for (std::uint32_t column = left; column < std::min(left + kSquare, field_.columns - 1); ++column)
        visit(column, row);
  }

  // The half-edges on the four sides of a cell whose first triangle has the slot `first`, in the order in
  // which forTriangles() visits its triangles; invalid if no triangle of the cell has that side.
  static HalfedgeId topEdge(unsigned valid, std::uint32_t first) {
    return (valid & 3) == 3 && triangleCount(valid) > 0 ? halfedgeOf(first, 0) : HalfedgeId();
  }
  static HalfedgeId rightEdge(unsigned valid, std::uint32_t first) {
    if ((valid & 10) != 10 || triangleCount(valid) == 0) return {};
    return halfedgeOf(first, (valid & upperLeft) != 0 ? 1 : 0);
  }
  static HalfedgeId bottomEdge(unsigned valid, std::uint32_t first) {
    if ((valid & 12) != 12 || triangleCount(valid) == 0) return {};
    return halfedgeOf(first + (valid == all ? 1 : 0), 1);
  }
  static HalfedgeId leftEdge(unsigned valid, std::uint32_t first) {
    if ((valid & 5) != 5 || triangleCount(valid) == 0) return {};
    return halfedgeOf(first + (valid == all ? 1 : 0), 2);
  }

 private:
  std::vector<Square> squares_;
};

bool hasCells(const RasterHeightfield& field) {
  return field.columns >= 2 && field.rows >= 2;
}

/// The plan of the mesh: per cell, by the index of its upper left sample, its valid corners and the slot of
/// its first triangle. The last sample of a row, and of a column, has no cell and no valid corners; one more
/// row without cells comes before the first. So every cell has four entries around its own, and no border
/// needs a test.
class MeshLayout {
 public:
  MeshLayout(const RasterHeightfield& field, const Cells& cells)
      : cells_(cells),
        columns_(field.columns),
        validCorners_(field.size() + field.columns, 0),
        firstTriangles_(field.size() + field.columns) {
    const std::size_t squares = cells.squareCount();
    std::uint8_t* const valid = validCorners_.data() + columns_;
    std::uint32_t* const first = firstTriangles_.data() + columns_;
    std::vector<std::uint32_t> squareFirst(squares + 1, 0);
    parallelFor(std::size_t(0), squares, [&](std::size_t square) {
      std::uint32_t count = 0;
      cells.forSquare(square, [&](std::uint32_t column, std::uint32_t row) {
        const unsigned corners = cells.valid(column, row);
        valid[field.index(column, row)] = static_cast<std::uint8_t>(corners);
        count += Cells::triangleCount(corners);
      });
      squareFirst[square + 1] = count;
    });
    for (std::size_t square = 0; square < squares; ++square) squareFirst[square + 1] += squareFirst[square];
    parallelFor(std::size_t(0), squares, [&](std::size_t square) {
      std::uint32_t next = squareFirst[square];
      cells.forSquare(square, [&](std::uint32_t column, std::uint32_t row) {
        const std::uint32_t cell = field.index(column, row);
        first[cell] = next;
        next += Cells::triangleCount(valid[cell]);
      });
    });
    triangleCount_ = squareFirst[squares];
  }

  std::uint32_t triangleCount() const { return triangleCount_; }

  /// Writes the triangles of a cell with their twins. Calls leave(v, h) for half-edges h that leave vertex v:
  /// at least the last one of each vertex of the cell, and each that has no twin.
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
    cells_.forTriangles(column, row, valid[0], [&](const RasterCells::Corners& corners) {
      write(mesh, t, corners, {});
      ++t;
    });
    if (valid[0] == Cells::all) {
      mesh.setTwin(halfedgeOf(begin, 2), halfedgeOf(begin + 1, 0));
      mesh.setTwin(halfedgeOf(begin + 1, 0), halfedgeOf(begin, 2));
    }
    const auto join = [&](HalfedgeId own, HalfedgeId beyond) {
      if (own.isValid()) mesh.setTwin(own, beyond);
    };
    join(Cells::topEdge(valid[0], begin), Cells::bottomEdge(valid[-down], first[-down]));
    join(Cells::rightEdge(valid[0], begin), Cells::leftEdge(valid[1], first[1]));
    join(Cells::bottomEdge(valid[0], begin), Cells::topEdge(valid[down], first[down]));
    join(Cells::leftEdge(valid[0], begin), Cells::rightEdge(valid[-1], first[-1]));
    for (t = begin; t < end; ++t)
      for (std::uint32_t side = 0; side < 3; ++side)
        leave(mesh.origin(halfedgeOf(t, side)), halfedgeOf(t, side));
  }

 private:
  /// Nearly all cells: all corners are valid, those of the four neighbours too.
  template <class Leave>
  void layWhole(std::uint32_t ul, const std::uint32_t* first, LiveMesh& mesh, const Leave& leave) const {
    const std::uint32_t t = first[0], ur = ul + 1, ll = ul + columns_, lr = ll + 1;
    const std::ptrdiff_t down = columns_;
    write(mesh, t, {ul, ur, lr},
          {halfedgeOf(first[-down] + 1, 1), halfedgeOf(first[1] + 1, 2), halfedgeOf(t + 1, 0)});
    write(mesh, t + 1, {ul, lr, ll},
          {halfedgeOf(t, 2), halfedgeOf(first[down], 0), halfedgeOf(first[-1], 1)});
    leave(VertexId(ur), halfedgeOf(t, 1));
    for (const auto& [v, side] : {std::pair(ul, 0u), {lr, 1u}, {ll, 2u}})
      leave(VertexId(v), halfedgeOf(t + 1, side));
  }
  static void write(LiveMesh& mesh, std::uint32_t t, const RasterCells::Corners& corners,
                    const std::array<HalfedgeId, 3>& twins) {
    mesh.triangles[SlotId(t)] = {{VertexId(corners[0]), VertexId(corners[1]), VertexId(corners[2])},
                                 twins,
                                 RecorderId(t),
                                 RemovalId()};
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
  for (std::size_t square = 0; square < cells.squareCount(); ++square)
    cells.forSquare(square, [&](std::uint32_t column, std::uint32_t row) {
      cells.forTriangles(column, row, cells.valid(column, row),
                         [&](const RasterCells::Corners& corners) { triangles.push_back(corners); });
    });
  return triangles;
}

LiveMesh finestMesh(const RasterHeightfield& heightfield, std::vector<VertexId>& pinched) {
  LiveMesh mesh;
  if (!hasCells(heightfield)) return mesh;
  const Cells cells(heightfield);
  const MeshLayout layout(heightfield, cells);
  mesh.triangles = decltype(mesh.triangles)(layout.triangleCount());
  mesh.vertexHalfedge = decltype(mesh.vertexHalfedge)(heightfield.size());
  forRanges(LoopThreads::all, heightfield.size(), 1 << 16, [&](std::size_t begin, std::size_t end) {
    std::fill(mesh.vertexHalfedge.begin() + begin, mesh.vertexHalfedge.begin() + end, HalfedgeId());
  });
  std::vector<std::vector<HalfedgeId>> borders(cells.squareCount());  // half-edges without a twin
  // A vertex refers to the last half-edge that leaves it; threads compete for a vertex between squares.
  const auto claim = [&](VertexId v, HalfedgeId h) {
    const std::atomic_ref last(mesh.vertexHalfedge[v]);
    HalfedgeId seen = last.load(std::memory_order_relaxed);
    while ((!seen.isValid() || seen < h) && !last.compare_exchange_weak(seen, h, std::memory_order_relaxed)) {
    }
  };
  parallelFor(std::size_t(0), cells.squareCount(), [&](std::size_t square) {
    cells.forSquare(square, [&](std::uint32_t column, std::uint32_t row) {
      const bool isInside = (column + 1) % kSquare > 1 && (row + 1) % kSquare > 1;
      layout.lay(column, row, mesh, [&](VertexId v, HalfedgeId h) {
        if (isInside)
          mesh.vertexHalfedge[v] = h;
        else
          claim(v, h);
        if (!mesh.twinOf(h).isValid()) borders[square].push_back(h);
      });
    });
  });

  for (const std::vector<HalfedgeId>& border : borders)
    for (const HalfedgeId h : border) mesh.vertexHalfedge[mesh.origin(h)] = h;
  for (const std::vector<HalfedgeId>& border : borders)
    for (const HalfedgeId h : border)
      if (mesh.vertexHalfedge[mesh.origin(h)] != h) pinched.push_back(mesh.origin(h));
  return mesh;
}

}  // namespace arete

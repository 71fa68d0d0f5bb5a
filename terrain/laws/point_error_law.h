// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "engine/cut/cut.h"
#include "terrain/laws/error_law.h"

namespace arete::laws {

/// Law 10 over scattered points. Points and edges of the finest triangulation are found through a grid of
/// square cells; every decision about the plan is exact.
class PointErrorLaw : public ErrorLaw {
 public:
  /// O(points + cells that the edges cross).
  PointErrorLaw(const MultiTriangulation& mt, const Cut& finest);

  /// O(points and edges in the cells that the triangle meets).
  bool holds(std::uint32_t triangle) const override;

 private:
  using Edge = std::array<std::uint32_t, 2>;
  /// Things listed by cell.
  struct Lists {
    std::vector<std::uint32_t> begin, things;
    std::span<const std::uint32_t> of(std::size_t firstCell, std::size_t endCell) const {
      return {things.data() + begin[firstCell], things.data() + begin[endCell]};
    }
  };
  struct CellRange {
    std::int64_t first, last;
  };

  Vec3 position(std::uint32_t vertex) const { return mt_.position(VertexId(vertex)); }
  std::int64_t columnOf(double x) const;
  std::int64_t rowOf(double y) const;
  std::size_t cellOf(std::int64_t column, std::int64_t row) const {
    return static_cast<std::size_t>(row * columns_ + column);
  }
  /// The cells of a row that the segment may meet; first > last: none.
  CellRange cellsOf(Vec2 a, Vec2 b, std::int64_t row) const;
  template <class Visit>
  void forCells(Vec2 a, Vec2 b, const Visit& visit) const;
  Lists listEdges() const;
  bool holdsAtPoints(const StoredErrors& stored, const std::array<std::uint32_t, 3>& corners) const;
  bool holdsAlong(const StoredErrors& stored, std::uint32_t a, std::uint32_t b) const;

  const MultiTriangulation& mt_;
  Vec2 low_, high_;
  double side_ = 1;
  std::int64_t columns_ = 1, rows_ = 1;
  std::vector<Edge> edges_;
  Lists pointsOf_, edgesOf_;
};

}  // namespace arete::laws

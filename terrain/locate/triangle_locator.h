// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "engine/base/vec.h"
#include "engine/mt/multitriangulation.h"
#include "terrain/locate/root_grid.h"

namespace arete {

/// A triangle of the multitriangulation over a plan point.
struct LocatedTriangle {
  TriangleId triangle;
  std::array<VertexId, 3> corners;  ///< counter-clockwise in the plan
  /// False for a point beyond the border of the domain by less than the margin: then this is the nearest
  /// triangle.
  bool isInside = true;
};

struct LocatorOptions {
  /// How far beyond a border a point still counts as on it, in plan units.
  double margin = 0;
  /// Whether coarse triangles may cover NODATA (a build with a rim tolerance): then a point in a coarse
  /// triangle may be in no finer one.
  bool mayFill = false;
};

/// Point location in a multitriangulation [DeFlorianiMagilloPuppo1998]: descends through the triangles over a
/// plan point, from the root's to the finest, one node per step. Heights, profiles and sight lines are
/// answered by it, without a cut. Which triangle holds the point is decided by exact predicates; of several
/// (the point is on an edge or at a vertex) the first in the order of ids is taken; their planes agree there.
///
/// Precondition: the indices in the arrays are valid (checkAmtIndices); with an invalid geometry the
/// triangles found may be wrong or missing, nothing worse. Thread-safe: all queries are const. Shares
/// ownership of the arrays.
class TriangleLocator {
 public:
  /// O(root triangles).
  explicit TriangleLocator(MultiTriangulation mt, const LocatorOptions& options = {});

  /// The root triangle over a plan point. O(root triangles of one cell).
  /// @return nothing outside the domain
  std::optional<LocatedTriangle> inRoot(Vec2 p) const;

  bool isFinest(const LocatedTriangle& t) const { return !mt_.remover(t.triangle).isValid(); }

  /// The triangle over p in the ceiling of t's remover, which replaces t. Preconditions: t was located for p;
  /// !isFinest(t). O(degree of the node).
  /// @return nothing where t covers NODATA at p (LocatorOptions::mayFill)
  std::optional<LocatedTriangle> finer(const LocatedTriangle& t, Vec2 p) const;

  /// The height at p of the plane through three vertices; outside of their triangle, that of its border
  /// nearby.
  double interpolate(const std::array<VertexId, 3>& corners, Vec2 p) const;

  const MultiTriangulation& mt() const { return mt_; }
  const RootGrid& roots() const { return roots_; }
  Vec2 planPosition(VertexId v) const {
    const VertexArrays& vertices = mt_.vertices();
    if (!vertices.isLattice()) return vertices.plan[v.index()];
    // A descent computes some hundred positions, so the division is replaced by a product. The added half is
    // far larger than the product's rounding error, and far smaller than the distance to the next row.
    const std::uint32_t sample = vertices.samples[v.index()];
    const auto row = static_cast<std::uint32_t>((sample + 0.5) * perColumn_);
    return {static_cast<double>(sample - row * vertices.columns), static_cast<double>(row)};
  }

 private:
  std::optional<LocatedTriangle> nearestOf(NodeId n, Vec2 p, double within) const;
  double distance(const std::array<VertexId, 3>& corners, Vec2 p) const;

  MultiTriangulation mt_;
  LocatorOptions options_;
  double perColumn_;  // 1 / columns of a raster
  RootGrid roots_;
};

}  // namespace arete

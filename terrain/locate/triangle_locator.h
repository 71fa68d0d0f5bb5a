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
  std::array<std::uint32_t, 3> corners;  ///< MT vertices, counter-clockwise in the plan
  /// False for a point beyond the border of the domain by less than the margin: then this is the triangle
  /// nearest to it.
  bool isInside = true;
};

struct LocatorOptions {
  /// How far beyond a border a point still counts as on it, in plan units.
  double margin = 0;
  /// Coarse triangles may reach over NODATA (a build with a rim tolerance), so a point in one may have no
  /// finer one.
  bool mayFill = false;
};

/// Walks down through the triangles of a multitriangulation over a plan point, from the root's to the finest,
/// one node a step: what heights, profiles and sight lines are answered by, without taking a cut. Which
/// triangle holds the point is decided by exact predicates; of several (the point is on an edge, or is a
/// vertex) the first in the order of ids is taken, whose planes all agree there.
///
/// Precondition: the arrays have been checked (checkAmtIndices); any geometry is survived, an invalid one
/// finds wrong triangles or none. Thread-safe: it is only read. Keeps what the multitriangulation points to
/// alive.
class TriangleLocator {
 public:
  /// O(root triangles).
  explicit TriangleLocator(MultiTriangulation mt, const LocatorOptions& options = {});

  /// The root triangle over a plan point; nothing outside the domain. O(root triangles of one cell).
  std::optional<LocatedTriangle> inRoot(Vec2 p) const;

  bool isFinest(const LocatedTriangle& t) const { return !mt_.remover(t.triangle).isValid(); }

  /// The triangle over p that the remover of t puts in its place; nothing where that leaves a fill open.
  /// Preconditions: t was located for p; !isFinest(t). O(degree of the node).
  std::optional<LocatedTriangle> finer(const LocatedTriangle& t, Vec2 p) const;

  /// The height at p of the plane through three vertices; outside their triangle that of its border there.
  double interpolate(const std::array<std::uint32_t, 3>& corners, Vec2 p) const;

  const MultiTriangulation& mt() const { return mt_; }
  const RootGrid& roots() const { return roots_; }
  Vec2 planPosition(std::uint32_t v) const {
    const VertexArrays& vertices = mt_.vertices();
    if (!vertices.isLattice()) return vertices.plan[v];
    // A descent asks for some hundred positions: no division. Half a sample is far more than the rounding of
    // the product, and far less than what is left to the next row.
    const std::uint32_t sample = vertices.samples[v];
    const auto row = static_cast<std::uint32_t>((sample + 0.5) * perColumn_);
    return {static_cast<double>(sample - row * vertices.columns), static_cast<double>(row)};
  }

 private:
  std::optional<LocatedTriangle> nearestOf(NodeId n, Vec2 p, double within) const;
  double distance(const std::array<std::uint32_t, 3>& corners, Vec2 p) const;

  MultiTriangulation mt_;
  LocatorOptions options_;
  double perColumn_;  // 1 / columns of a raster
  RootGrid roots_;
};

}  // namespace arete

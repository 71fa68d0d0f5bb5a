// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "terrain/locate/triangle_locator.h"
#include "terrain/sight/walk.h"

namespace arete {

/// The part of a leg over one triangle: parameters of the leg, and the heights of the triangle's plane there.
struct TriangleSpan {
  double t0, t1, z0, z1;
  std::uint32_t triangle;

  /// @return the height at t; z0 if the span has no length.
  double at(double t) const { return t1 > t0 ? z0 + (z1 - z0) * ((t - t0) / (t1 - t0)) : z0; }
  /// Clips to [first, last].
  void cut(double first, double last) {
    const TriangleSpan whole = *this;
    if (whole.t0 < first) {
      t0 = first;
      z0 = whole.at(first);
    }
    if (whole.t1 > last) {
      t1 = last;
      z1 = whole.at(last);
    }
  }
};

/// The triangles of a multitriangulation below a leg: the root's, and those of the star that a node puts in
/// the place of the triangles it removes. Keeps references to its arguments.
class MtCrossing {
 public:
  /// Precondition: the leg has a length in plan.
  MtCrossing(const TriangleLocator& locator, const SightLeg& leg);

  /// Appends the spans of the root triangles. O(root triangles near the leg).
  void addRoots(std::vector<TriangleSpan>& spans) const;
  /// Appends the spans within [first, last] of the triangles of a node's star. O(degree).
  void addStar(std::uint32_t node, double first, double last, std::vector<TriangleSpan>& spans) const;
  /// Sorts by where the leg enters the triangles; of those that it enters together, the longest comes first.
  static void sort(std::span<TriangleSpan> spans);

  /// @return differences of the leg's parameter below this are rounding.
  double shortest() const { return shortest_; }

 private:
  /// A vertex relative to the leg.
  struct Projected {
    double side;   ///< distance from the leg, scaled; its sign tells the side
    double along;  ///< parameter of its perpendicular foot
    double z;
  };

  Projected project(std::uint32_t vertex) const;
  void add(std::uint32_t triangle, const Projected& a, const Projected& b, const Projected& c, double first,
           double last, std::vector<TriangleSpan>& spans) const;

  const TriangleLocator& locator_;
  const SightLeg& leg_;
  double perLength_, shortest_;
};

}  // namespace arete

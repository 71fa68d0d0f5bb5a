// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "terrain/locate/triangle_locator.h"
#include "terrain/sight/walk.h"

namespace arete {

/// Where a straight piece in plan passes a triangle: parameters of the piece, and the heights of the plane
/// there.
struct TriangleSpan {
  double t0, t1, z0, z1;
  std::uint32_t triangle;

  double at(double t) const { return t1 > t0 ? z0 + (z1 - z0) * ((t - t0) / (t1 - t0)) : z0; }
  /// Leaves what is within [first, last].
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

/// The triangles of a multitriangulation that a piece passes: those of the root, and those of the star that
/// stands where a node removed others. Keeps references to both.
class MtCrossing {
 public:
  /// Precondition: the piece has a length in plan.
  MtCrossing(const TriangleLocator& locator, const SightPiece& piece);

  /// Appends the spans of the root triangles. O(root triangles near the piece).
  void addRoots(std::vector<TriangleSpan>& spans) const;
  /// Appends the spans within [first, last] of the triangles of a node's star. O(degree).
  void addStar(std::uint32_t node, double first, double last, std::vector<TriangleSpan>& spans) const;
  /// In the order in which the piece enters them, the longer first.
  static void sort(std::span<TriangleSpan> spans);

  /// Of the piece's parameter: less is rounding.
  double shortest() const { return shortest_; }

 private:
  /// A vertex as the piece sees it.
  struct Seen {
    double side;   ///< of the piece, scaled
    double along;  ///< the parameter of the nearest place on it
    double z;
  };

  Seen see(std::uint32_t vertex) const;
  void add(std::uint32_t triangle, const Seen& a, const Seen& b, const Seen& c, double first, double last,
           std::vector<TriangleSpan>& spans) const;

  const TriangleLocator& locator_;
  const SightPiece& piece_;
  double perLength_, shortest_;
};

}  // namespace arete

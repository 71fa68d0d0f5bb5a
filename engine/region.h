// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/vec.h"

namespace arete {

struct MetricFrame;

/// A closed region of the plan: the inside of rings by the even-odd rule, their edges included.
/// Queries look only at the edges in the query's band of y: O(edges of those bands).
class Region {
 public:
  /// Rings are closed by themselves (the last point need not repeat the first); fewer than 3 points are
  /// ignored.
  explicit Region(std::vector<std::vector<Vec2>> rings);
  static Region box(const Box2& box);

  bool isEmpty() const { return edges_.empty(); }
  Box2 bounds() const { return bounds_; }

  bool contains(Vec2 p) const;
  bool meetsTriangle(Vec2 a, Vec2 b, Vec2 c) const;
  /// Errs, if at all, towards true: rounding is covered by widening the disc by one part in 1e9.
  bool meetsDisc(Vec2 centre, double radius) const;

  /// The same region in metric space.
  Region scaled(const MetricFrame& metric) const;

 private:
  struct Edge {
    Vec2 a, b;
  };
  template <class Visit>
  void forEdgesBetween(double yLow, double yHigh, const Visit& visit) const;

  std::vector<std::vector<Vec2>> rings_;
  std::vector<Edge> edges_;
  Box2 bounds_;
  // Bands of equal height; band i lists the edges that touch it.
  std::vector<std::uint32_t> bandBegin_, bandEdges_;
  double bandHeight_ = 1;
};

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "engine/base/segment_bvh.h"
#include "engine/base/vec.h"
#include "engine/mt/multitriangulation.h"

namespace arete {

/// The shapes that make up a region.
struct RegionShape {
  std::vector<std::vector<Vec2>> rings = {};  ///< polygons by the even-odd rule; each is closed implicitly
  std::vector<std::vector<Vec2>> lines = {};  ///< open chains: a road, a flight path; of one vertex: a point
  double distance = 0;  ///< points within this distance of them belong to the region; metric units
};

/// A closed region of the plan: polygons, lines, and everything within a distance of either. Queries are in
/// plan coordinates. O(log n + edges near the query) each.
class Region {
 public:
  /// @param shape In plan coordinates. Rings of fewer than 3 points and empty lines are ignored.
  /// @param metric The space in which the shape's distance is measured; not used without a distance.
  explicit Region(RegionShape shape, const MetricFrame& metric = {});
  explicit Region(std::vector<std::vector<Vec2>> rings) : Region(RegionShape{std::move(rings)}) {}
  static Region box(const Box2& box);

  bool isEmpty() const { return tree_.isEmpty(); }
  /// In plan coordinates.
  Box2 bounds() const { return bounds_; }

  bool contains(Vec2 p) const;
  bool meetsTriangle(Vec2 a, Vec2 b, Vec2 c) const;
  /// Whether the disc meets the region. Conservative: the disc is widened by one part in 1e9, so rounding can
  /// only make it true.
  bool meetsDisc(Vec2 centre, double radius) const;
  /// Whether the region contains the disc. Conservative: false where the disc meets an edge of a ring, and
  /// rounding can only make it false.
  bool holdsDisc(Vec2 centre, double radius) const;

  /// The same region for queries in metric space. Precondition: the metric frame of the constructor, where
  /// there is a distance.
  Region scaled(const MetricFrame& metric) const;

 private:
  bool meetsInner(Vec2 a, Vec2 b, Vec2 c) const;
  bool isInRings(Vec2 p) const;
  Vec2 toInner(Vec2 p) const {
    const Vec3 q = frame_.toMetric({p.x, p.y, 0});
    return {q.x, q.y};
  }

  RegionShape shape_;  // in inner coordinates: metric with a distance, else those of the queries
  MetricFrame frame_;  // from the queries' coordinates to the inner ones
  SegmentBvh tree_, ringTree_;
  Box2 bounds_;
};

}  // namespace arete

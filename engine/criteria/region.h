// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "engine/base/segment_bvh.h"
#include "engine/base/vec.h"
#include "engine/mt/multitriangulation.h"

namespace arete {

/// What a region is drawn with.
struct RegionShape {
  std::vector<std::vector<Vec2>> rings =
      {};  ///< the inside is theirs, by the even-odd rule; closed by themselves
  std::vector<std::vector<Vec2>> lines = {};  ///< open chains: a road, a flight path
  double distance = 0;                        ///< this near to them is in the region too; in metric units
};

/// A closed region of the plan: the inside of rings, lines, and all that is within a distance of either.
/// Queries are in plan coordinates and cost O(log n + edges near the query).
class Region {
 public:
  /// The shape is in plan coordinates. Rings of fewer than 3 points and lines of fewer than 2 are ignored.
  /// `metric` says what a distance is; without a distance it does not matter.
  explicit Region(RegionShape shape, const MetricFrame& metric = {});
  explicit Region(std::vector<std::vector<Vec2>> rings) : Region(RegionShape{std::move(rings)}) {}
  static Region box(const Box2& box);

  bool isEmpty() const { return tree_.isEmpty(); }
  /// In plan coordinates.
  Box2 bounds() const { return bounds_; }

  bool contains(Vec2 p) const;
  bool meetsTriangle(Vec2 a, Vec2 b, Vec2 c) const;
  /// Errs, if at all, towards true: rounding is covered by widening the disc by one part in 1e9.
  bool meetsDisc(Vec2 centre, double radius) const;
  /// Whether all of the disc is in the region. Errs towards false: where the disc meets an edge of a ring,
  /// and by rounding.
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

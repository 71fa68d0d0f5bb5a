// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/nearest_on_triangle.h"
#include "surface/error/attribute_field.h"
#include "surface/error/squares_over_triangle.h"

namespace arete {

/// The distances of a point that has attributes from several triangles: where place and attributes, each
/// weighed by its length, are nearest together. What is divided or chosen by them is still bounded by itself.
class JointDistance {
 public:
  using DrawnCorners = std::array<std::uint32_t, 3>;
  /// Precondition: the field outlives this.
  explicit JointDistance(const AttributeField& field) : field_(&field) {}

  void clear() { triangles_.clear(); }
  /// @param drawn the corners as the field has them
  void add(const SpaceTriangle& places, const DrawnCorners& drawn);
  std::size_t size() const { return triangles_.size(); }

  /// The squared distance to a triangle. Attributes that are not finite do not count.
  /// @param wanted the attributes at p, AttributeField::components(). O(components).
  double squared(std::size_t triangle, const Vec3& p, std::span<const double> wanted) const;
  /// The same of the point of the triangle that is nearest in space.
  double squaredAtNearest(std::size_t triangle, const Vec3& p, std::span<const double> wanted) const;

 private:
  struct Triangle {
    SpaceTriangle places;
    DrawnCorners drawn;
    SquaresOverTriangle squares;
  };
  const AttributeField* field_;
  std::vector<Triangle> triangles_;
};

}  // namespace arete

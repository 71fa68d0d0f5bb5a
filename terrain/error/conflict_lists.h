// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/ids.h"
#include "engine/base/vec.h"

namespace arete {

/// The conflict lists [ClarksonShor1989] of a star's triangles merged into one, laid out for vector
/// instructions: the removed points below a hole. A triangle that may fill the hole finds the points that it
/// covers, and that lie far enough from its plane, by linear functions in floats with bounds of their
/// rounding errors. The few points that these do not decide are left to exact predicates (PointError).
class ConflictLists {
 public:
  /// Removes all points and sets the origin of the coordinates kept. O(1).
  /// @param apex  a position near all of the points
  void clear(const Vec3& apex) {
    apex_ = apex;
    size_ = 0;
  }
  void add(VertexId point, const Vec3& position) {
    if (size_ == points_.size()) grow();
    points_[size_] = point;
    x_[size_] = static_cast<float>(position.x - apex_.x);
    y_[size_] = static_cast<float>(position.y - apex_.y);
    z_[size_] = static_cast<float>(position.z - apex_.z);
    ++size_;
  }
  /// Ends a series of add(); call before the first Triangle.
  /// @param reach  in each coordinate, the largest distance from the apex of any point added and of any
  /// corner
  ///        of a Triangle to come
  void close(const Vec3& reach) { reach_ = reach; }

  std::size_t size() const { return size_; }
  /// The point at an index, below size(), in the order of add().
  VertexId operator[](std::size_t index) const { return points_[index]; }

  struct Found {
    std::size_t index;  ///< size() where no point is left
    bool isCovered;     ///< true: the triangle covers the point; false: not decided
  };
  /// A triangle of the hole, counter-clockwise in the plan. Keeps a reference to the lists.
  class Triangle {
   public:
    Triangle(const ConflictLists& lists, const Vec3& a, const Vec3& b, const Vec3& c);

    /// The first point, from an index on, that the triangle may cover and where z_triangle - z may exceed
    /// `above` or be less than -`below`. Misses none. Precondition: above, below >= 0. O(points), four at a
    /// time.
    Found next(std::size_t from, double above, double below) const;
    /// The first point, from an index on, that the triangle may cover.
    Found nextCovered(std::size_t from) const;

   private:
    /// value(x, y) = atApex + alongX * x + alongY * y, with x and y counted from the apex
    struct Linear {
      float atApex, alongX, alongY;
    };
    /// Twice the signed area of an edge and a point, > 0 for a point left of the edge.
    Linear leftOf(const Vec3& from, const Vec3& to) const;

    const ConflictLists& lists_;
    Linear edges_[3];
    float edgeMargin_;  // bounds the rounding error of edges_
    Linear plane_;      // the plane's height above the apex
    float planeMargin_;
  };

 private:
  void grow();

  Vec3 apex_, reach_;
  std::size_t size_ = 0;
  std::vector<VertexId> points_;
  // From the apex. Padded by arbitrary values, since they are read four at a time.
  std::vector<float> x_, y_, z_;
};

}  // namespace arete

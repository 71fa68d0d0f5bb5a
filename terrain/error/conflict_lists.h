// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/base/vec.h"

namespace arete {

/// The points that a hole has below it, laid out for vectors: a triangle of the hole asks of all of them
/// whether it covers them and how far they are from it. That is told by linear functions in floats, with
/// what they can be off by; the few points that it does not decide are for exact predicates (PointError).
class ConflictLists {
 public:
  /// Forgets all. `apex`: the place that the others are told from, a point like them.
  void clear(const Vec3& apex) {
    apex_ = apex;
    size_ = 0;
  }
  void add(std::uint32_t point, const Vec3& position) {
    if (size_ == points_.size()) grow();
    points_[size_] = point;
    x_[size_] = static_cast<float>(position.x - apex_.x);
    y_[size_] = static_cast<float>(position.y - apex_.y);
    z_[size_] = static_cast<float>(position.z - apex_.z);
    ++size_;
  }
  /// When all are there. `reach`: how far any of them, or any corner of a triangle that will be asked about,
  /// lies from the apex at most, in each coordinate.
  void close(const Vec3& reach) { reach_ = reach; }

  std::size_t size() const { return size_; }
  std::uint32_t operator[](std::size_t k) const { return points_[k]; }

  struct Found {
    std::size_t place;  ///< size() where there is none
    bool isCovered;     ///< for certain; else it may be
  };
  /// A counter-clockwise triangle over them.
  class Triangle {
   public:
    Triangle(const ConflictLists& below, const Vec3& a, const Vec3& b, const Vec3& c);

    /// The first point from a place on that the triangle may cover and where z_triangle - z may be above
    /// `above`, or below -`below`. O(points), four at a time. Precondition: neither is negative.
    Found next(std::size_t from, double above, double below) const;
    /// The first that it may cover.
    Found nextCovered(std::size_t from) const;

   private:
    /// value = atApex + alongX * x + alongY * y
    struct Linear {
      float atApex, alongX, alongY;
    };
    /// Twice the area of an edge and a point left of it.
    Linear leftOf(const Vec3& from, const Vec3& to) const;

    const ConflictLists& below_;
    Linear edges_[3];
    float edgeMargin_;  // what those can be off by
    Linear plane_;      // the height, from the apex's
    float planeMargin_;
  };

 private:
  void grow();

  Vec3 apex_, reach_;
  std::size_t size_ = 0;
  std::vector<std::uint32_t> points_;
  // From the apex; a few more, of any value, for those who read four at a time.
  std::vector<float> x_, y_, z_;
};

}  // namespace arete

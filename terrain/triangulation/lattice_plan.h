// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "engine/base/ids.h"
#include "engine/base/vec.h"
#include "terrain/triangulation/delaunay_hole.h"

namespace arete {

/// The plan geometry of a raster, exact in integers: sample (column, row) has the coordinates (p * column,
/// q * row), where p / q is a small rational near the true ground aspect. This metric decides which triangles
/// are Delaunay; nothing else depends on it. A vertex has the number of its sample.
class LatticePlan {
 public:
  /// Precondition: columns > 1; p, q > 0.
  LatticePlan(std::uint32_t columns, std::uint32_t p, std::uint32_t q)
      : columns_(columns), reciprocal_(~std::uint64_t(0) / columns + 1), p_(p), q_(q) {}

  struct Cell {
    std::uint32_t column, row;
  };

  /// The column and row of a vertex, by a multiplication in place of a division. Exact: the factor, 2^64 /
  /// columns rounded up, is off by less than one, so the row of a sample below 2^32 by less than 2^-32.
  Cell cell(VertexId vertex) const {
    const std::uint32_t sample = vertex.index();
    const auto row = static_cast<std::uint32_t>((UnsignedWide(sample) * reciprocal_) >> 64);
    return {sample - row * columns_, row};
  }

  std::uint32_t columns() const { return columns_; }
  std::uint32_t p() const { return p_; }
  std::uint32_t q() const { return q_; }

  Vec2 planPosition(VertexId vertex) const {
    const Cell c = cell(vertex);
    return {double(c.column), double(c.row)};
  }

  /// > 0 when a, b, c turn counter-clockwise in (column, row); exact (the products are below columns * rows *
  /// p * q).
  int orientation(VertexId a, VertexId b, VertexId c) const {
    const Cell ca = cell(a), cb = cell(b), cc = cell(c);
    const std::int64_t d = (std::int64_t(cb.column) - ca.column) * (std::int64_t(cc.row) - ca.row) -
                           (std::int64_t(cb.row) - ca.row) * (std::int64_t(cc.column) - ca.column);
    return (d > 0) - (d < 0);
  }

  /// A star polygon with the apex at the origin.
  class Polygon {
   public:
    /// Corners (and the apex) by column x and row y.
    template <class Corner>
    Polygon(const LatticePlan& plan, const Corner& apex, std::span<const Corner> corners) {
      std::int64_t spread = 0;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        x_[i] = (std::int64_t(corners[i].x) - apex.x) * plan.p_;
        y_[i] = (std::int64_t(corners[i].y) - apex.y) * plan.q_;
        spread |= std::abs(x_[i]) | std::abs(y_[i]);
      }
      isSmall_ = spread < kSmall;
    }

    /// Sign of the area of corners i, j, m; exact.
    int orientation(int i, int j, int m) const { return sign(area(i, j, m)); }
    /// Sign of the area of corners i, j and the apex; exact.
    int orientationToApex(int i, int j) const { return sign(x_[i] * y_[j] - y_[i] * x_[j]); }

    /// > 0 when n lies strictly inside the circle through the counter-clockwise i, j, m; exact.
    int inCircle(int i, int j, int m, int n) const {
      return isSmall_ ? sign(determinant<std::int64_t>(i, j, m, n)) : sign(determinant<Wide>(i, j, m, n));
    }

   private:
    __extension__ using Wide = __int128;
    // Differences below 2^14 keep the determinant below 12 * 2^56 < 2^63.
    static constexpr std::int64_t kSmall = 1 << 13;

    template <class T>
    static int sign(T value) {
      return (value > 0) - (value < 0);
    }
    std::int64_t area(int i, int j, int m) const {
      return (x_[j] - x_[i]) * (y_[m] - y_[i]) - (y_[j] - y_[i]) * (x_[m] - x_[i]);
    }
    template <class T>
    T determinant(int i, int j, int m, int n) const {
      const T ax = x_[i] - x_[n], ay = y_[i] - y_[n], bx = x_[j] - x_[n], by = y_[j] - y_[n],
              cx = x_[m] - x_[n], cy = y_[m] - y_[n];
      return (ax * ax + ay * ay) * (bx * cy - by * cx) + (bx * bx + by * by) * (cx * ay - cy * ax) +
             (cx * cx + cy * cy) * (ax * by - ay * bx);
    }

    std::array<std::int64_t, kMaxHoleCorners> x_, y_;
    bool isSmall_;
  };

 private:
  __extension__ using UnsignedWide = unsigned __int128;

  std::uint32_t columns_;
  std::uint64_t reciprocal_;
  std::uint32_t p_, q_;
};

}  // namespace arete

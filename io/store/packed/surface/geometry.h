// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Places of the vertices of a run's nodes in space, and the spheres of their stars. A vertex is predicted at
// the mean of its link, or, on a border, in the middle of the border edge that it divides; first the two
// coordinates in which the link is widest, then the third one in the plane of the link. How wide it is
// selects the tables.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include "engine/mt/enclosing_ball.h"
#include "engine/mt/hole_limit.h"
#include "io/store/entropy/numbers.h"
#include "io/store/packed/nodes/arrays.h"
#include "io/store/packed/nodes/layout.h"
#include "io/store/packed/nodes/shapes.h"
#include "io/store/packed/nodes/tables.h"
#include "io/store/packed/surface/coordinates.h"

namespace arete::packed {

/// The classes of the third coordinate, each of this many octaves.
inline constexpr unsigned kThirdOctaves = 4;

/// @tparam Io  the reader's or the writer's, see node_coder.h
template <class Io>
class SpaceGeometry {
 public:
  SpaceGeometry(Arrays& arrays, Io& io) : a_(arrays), io_(io), coordinates_(arrays) {}

  /// Codes the places of all nodes of a run. Neither shapes nor areas are used.
  /// @return false if a coordinate or the metric is not finite
  bool run(const Run& run, unsigned, std::span<const Shape* const>, std::uint8_t*) {
    std::uint32_t slot = run.firstSlot;
    for (std::uint32_t n = run.firstNode; n != run.firstNode + run.nodes; ++n) {
      io_.at(n);
      const std::uint32_t size = a_.starSize(n);
      for (std::uint32_t i = 0; i < size; ++i) star_[i] = arrayOf(a_.place(a_.link[slot + i]));
      const std::uint32_t vertex = a_.rootVertices + n;
      const Point apex = code(size, a_.isOpen(n));
      const Vec3 place{apex[0], apex[1], apex[2]};
      if (!isFinite(place)) return false;
      a_.setPlace(vertex, place);
      if constexpr (Io::kKeepsValues) {
        star_[size] = apex;
        if (!ball(n, size + 1)) return false;
      }
      slot += size;
    }
    return true;
  }

 private:
  using Point = std::array<double, 3>;
  static Point arrayOf(const Vec3& p) { return {p.x, p.y, p.z}; }

  Point code(std::uint32_t size, bool isOpen) {
    Point mean{}, width{}, normal{};
    for (std::uint32_t i = 0; i < size; ++i)
      for (std::size_t k = 0; k < 3; ++k) mean[k] += star_[i][k];
    for (double& m : mean) m /= size;
    for (std::uint32_t i = 0; i < size; ++i) {
      const Point &p = star_[i], &q = star_[i + 1 < size ? i + 1 : 0];
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
        width[k] += std::fabs(p[k] - mean[k]);
        normal[k] += (p[u] - mean[u]) * (q[v] - mean[v]) - (p[v] - mean[v]) * (q[u] - mean[u]);
      }
    }
    Point predicted = mean;
    if (isOpen)
      for (std::size_t k = 0; k < 3; ++k) predicted[k] = (star_[0][k] + star_[size - 1][k]) / 2;
    std::size_t third = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (std::fabs(normal[k]) > std::fabs(normal[third])) third = k;
    const std::size_t first = (third + 1) % 3, second = (third + 2) % 3;

    const Point actual = arrayOf(io_.actualPosition());
    Point apex{};
    for (const std::size_t k : {first, second})
      apex[k] =
          code(kPlaceStream, kPlaceTable + coordinates_.classOf(width[k] / size, predicted[k], kPlaceClasses),
               predicted[k], actual[k]);
    const double slope = (normal[first] * (apex[first] - predicted[first]) +
                          normal[second] * (apex[second] - predicted[second])) /
                         normal[third];
    const double level = std::isfinite(slope) ? predicted[third] - slope : predicted[third];
    const unsigned wide =
        coordinates_.classOf((width[first] + width[second]) / size, level, kClasses * kThirdOctaves);
    apex[third] = code(kHeightStream, kHeightTable + wide / kThirdOctaves, level, actual[third]);
    return apex;
  }

  double code(Stream stream, unsigned table, double predicted, double actual) {
    const auto near = static_cast<std::uint64_t>(coordinates_.nearest(predicted));
    const std::int64_t residual =
        codeSigned(io_, stream, table,
                   static_cast<std::int64_t>(static_cast<std::uint64_t>(coordinates_.whole(actual)) - near));
    return coordinates_.coordinate(static_cast<std::int64_t>(near + static_cast<std::uint64_t>(residual)));
  }

  /// The sphere of the star; saturate() adds those of the children. Its radius is negative until then.
  bool ball(std::uint32_t node, std::uint32_t points) {
    for (std::uint32_t i = 0; i < points; ++i) {
      const auto& [x, y, z] = star_[i];
      metric_[i] = a_.metric.toMetric({x, y, z});
    }
    EnclosingBall around = EnclosingBall::around({metric_.data(), points});
    around.radius += a_.moved;
    Sphere ball = around.rounded();
    ball.radius = -std::bit_cast<float>(std::bit_cast<std::uint32_t>(ball.radius) + 1);
    a_.sphere[node] = ball;
    return std::isfinite(ball.x + ball.y + ball.z + ball.radius);
  }

  Arrays& a_;
  Io& io_;
  Coordinates coordinates_;
  std::array<Point, kMaxHoleCorners + 1> star_;  ///< the link, then the vertex
  std::array<Vec3, kMaxHoleCorners + 1> metric_;
};

}  // namespace arete::packed

// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/fronts/met_triangle.h"

#include <array>
#include <cmath>

namespace arete {
namespace {

/// What rounding may take from the shares of the corners at an edge.
constexpr double kEdgeSlack = 1e-9;

/// How far along the ray it meets the triangle, from the ray's start on.
std::optional<double> meeting(const std::array<Vec3, 3>& t, const Vec3& from, const Vec3& direction,
                              bool isFrontAlone) {
  const Vec3 a = t[1] - t[0], b = t[2] - t[0], across = cross(direction, b);
  const double volume = dot(a, across);
  if (volume == 0 || (isFrontAlone && volume < 0)) return std::nullopt;
  const Vec3 way = from - t[0];
  const double u = dot(way, across) / volume;
  const Vec3 beside = cross(way, a);
  const double v = dot(direction, beside) / volume;
  if (!(u >= -kEdgeSlack && v >= -kEdgeSlack && u + v <= 1 + kEdgeSlack)) return std::nullopt;
  const double along = dot(b, beside) / volume;
  if (!(along >= 0)) return std::nullopt;
  return along;
}

}  // namespace

std::optional<MetTriangle> firstMet(const TriangleList& list, const Vec3& from, const Vec3& direction) {
  std::optional<MetTriangle> first;
  for (std::size_t i = 0; i < list.corners.size(); ++i) {
    std::array<Vec3, 3> triangle;
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = list.place(list.corners[i][k]);
    const auto along = meeting(triangle, from, direction, list.isFrontAlone);
    if (along && (!first || *along < first->along)) first = MetTriangle{*along, i};
  }
  return first;
}

}  // namespace arete

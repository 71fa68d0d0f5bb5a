// SPDX-License-Identifier: GPL-3.0-or-later
//
// A triangle in each lane, four or eight lanes at a time. Without branches: the distance from each side
// counts where the point lies beyond the plane through the side that is upright on the triangle; where it
// lies beyond none, that from the triangle's plane.
#include "surface/error/floor_distance.h"

#include <algorithm>
#include <limits>

#include "engine/base/vector_clones.h"

namespace arete {
namespace {

constexpr int kStep = 8;  // lanes are filled up to a multiple of it
constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

void FloorDistance::add(const SpaceTriangle& t) {
  const Vec3 normal = areaNormal(t);
  const double squared = dot(normal, normal);
  const auto put = [&](int i, std::array<Lanes, 3>& to, const Vec3& v) {
    to[0][i] = v.x;
    to[1][i] = v.y;
    to[2][i] = v.z;
  };
  const int i = size_++;
  for (int s = 0; s < 3; ++s) {
    const Vec3 side = t[(s + 1) % 3] - t[s];
    put(i, corner_[s], t[s]);
    put(i, side_[s], side);
    put(i, inward_[s], cross(normal, side));
    const double length = dot(side, side);
    perSide_[s][i] = length > 0 ? 1 / length : 0;
  }
  put(i, normal_, normal);
  perNormal_[i] = squared > 0 ? 1 / squared : 0;
  inside_[i] = squared > 0 ? 0 : kInfinity;
}

ARETE_VECTOR_CLONES
void FloorDistance::squares(const Vec3& p, Squares& to) const {
  const int lanes = std::min((size_ + kStep - 1) / kStep * kStep, kMost);
  for (int i = 0; i < lanes; ++i) {
    double least = kInfinity;
    for (int s = 0; s < 3; ++s) {
      const double x = p.x - corner_[s][0][i], y = p.y - corner_[s][1][i], z = p.z - corner_[s][2][i];
      const double sx = side_[s][0][i], sy = side_[s][1][i], sz = side_[s][2][i];
      const double height = inward_[s][0][i] * x + inward_[s][1][i] * y + inward_[s][2][i] * z;
      double at = (sx * x + sy * y + sz * z) * perSide_[s][i];
      at = at > 0 ? at : 0;
      at = at < 1 ? at : 1;
      const double dx = x - at * sx, dy = y - at * sy, dz = z - at * sz;
      const double squared = dx * dx + dy * dy + dz * dz;
      const double beyond = height < inside_[i] ? squared : kInfinity;
      least = beyond < least ? beyond : least;
    }
    const double height = normal_[0][i] * (p.x - corner_[0][0][i]) +
                          normal_[1][i] * (p.y - corner_[0][1][i]) + normal_[2][i] * (p.z - corner_[0][2][i]);
    const double inPlane = height * height * perNormal_[i];
    to[i] = least < kInfinity ? least : inPlane;
  }
}

double FloorDistance::nearest(const Vec3& p) const {
  Squares squared;
  squares(p, squared);
  return *std::min_element(squared.begin(), squared.begin() + size_);
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The sphere of a node holds the triangles that it creates and the spheres of all nodes below it, so a ray
// that misses it, or meets it beyond the nearest triangle so far, meets nothing below that is nearer.
#include "surface/rays/first_hit.h"

#include <cmath>
#include <limits>
#include <unordered_set>
#include <vector>

namespace arete {
namespace {

/// Of a surface in the metric space of its multitriangulation.
class RayDescent {
 public:
  RayDescent(const MultiTriangulation& mt, const Vec3& from, const Vec3& direction)
      : mt_(mt), eye_(from), direction_(direction), length2_(dot(direction, direction)) {}

  void run() {
    for (std::uint32_t t = 0; t < mt_.rootTriangleCount(); ++t) follow(TriangleId(t));
    while (!waiting_.empty()) {
      const NodeId n = waiting_.back();
      waiting_.pop_back();
      if (!meets(mt_.sphere(n))) continue;
      for (std::uint32_t slot = 0; slot < mt_.ceilingSize(n); ++slot) follow(mt_.slotTriangle(n, slot));
    }
  }
  std::optional<RayHit> found() const {
    return isFound_ ? std::optional(RayHit{nearest_, triangle_}) : std::nullopt;
  }

 private:
  /// A triangle that is never removed is tried; else the node that removes it is walked, once.
  void follow(TriangleId t) {
    const NodeId remover = mt_.remover(t);
    if (!remover.isValid())
      tryTriangle(t);
    else if (seen_.insert(remover.index()).second)
      waiting_.push_back(remover);
  }

  bool meets(const Sphere& s) const {
    const Vec3 to = Vec3{s.x, s.y, s.z} - eye_;
    const double along = dot(to, direction_) / length2_, radius = double(s.radius) * (1 + 1e-6);
    const Vec3 off = to - along * direction_;
    if (dot(off, off) > radius * radius) return false;
    const double half = radius / std::sqrt(length2_);
    return along + half >= 0 && along - half <= nearest_;
  }

  // By Cramer's rule on the plane of the triangle. Edges belong to both triangles.
  void tryTriangle(TriangleId t) {
    const auto corners = mt_.corners(t);
    const auto at = [&](std::size_t i) { return mt_.metric().toMetric(mt_.position(VertexId(corners[i]))); };
    const Vec3 a = at(0), u = at(1) - a, v = at(2) - a;
    const Vec3 p = cross(direction_, v), s = eye_ - a, q = cross(s, u);
    const double determinant = dot(u, p);
    if (determinant == 0) return;
    const double b = dot(s, p) / determinant, c = dot(direction_, q) / determinant;
    const double along = dot(v, q) / determinant;
    constexpr double kEdge = 1e-9;
    if (!(b >= -kEdge && c >= -kEdge && b + c <= 1 + kEdge && along >= 0 && along <= nearest_)) return;
    if (isFound_ && along == nearest_) return;
    nearest_ = along;
    triangle_ = t;
    isFound_ = true;
  }

  const MultiTriangulation& mt_;
  Vec3 eye_, direction_;
  double length2_, nearest_ = std::numeric_limits<double>::infinity();
  bool isFound_ = false;
  TriangleId triangle_{};
  std::vector<NodeId> waiting_;
  std::unordered_set<std::uint32_t> seen_;
};

}  // namespace

std::optional<RayHit> firstHit(const MultiTriangulation& mt, const Vec3& from, const Vec3& direction) {
  RayDescent descent(mt, from, direction);
  descent.run();
  return descent.found();
}

}  // namespace arete

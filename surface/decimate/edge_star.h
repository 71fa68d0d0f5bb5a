// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <boost/container/small_vector.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "engine/base/nearest_on_triangle.h"
#include "engine/base/triangle_bvh.h"
#include "engine/base/vec.h"

namespace arete {

/// The triangles around both ends of an edge that CGAL collapses, and what they say of a place for the vertex
/// that it becomes.
///
/// A placement that keeps the volume flings a vertex far where a long wall loses volume that a narrow rim has
/// to give back. So a place has to be among the planes of the triangles, and near them:
///
/// Along the normal of each triangle, and of the planes that stand on its borders, a place lies between the
/// ends of the edge, or beyond them by as much as the edge bridges of planes that face alike and run along
/// it: on a curved surface that is its rise, on a flat rim it is nothing.
///
/// And it stands off the triangles by no more than the ends are left behind by the worst of the places on the
/// edge, its ends and its middle: by no more than the error that is made anyway, about.
template <class Mesh>
class EdgeStar {
 public:
  using Vertex = typename Mesh::Vertex_index;
  using Halfedge = typename Mesh::Halfedge_index;

  EdgeStar(const Mesh& mesh, Vertex v0, Vertex v1)
      : mesh_(mesh), ends_{placeOf(v0), placeOf(v1)}, edge_(ends_[1] - ends_[0]) {
    squaredLength_ = dot(edge_, edge_);
    for (const auto& [v, other] : {std::pair{v0, v1}, std::pair{v1, v0}})
      for (const Halfedge h : mesh.halfedges_around_target(mesh.halfedge(v))) {
        if (mesh.is_border(h)) continue;
        const Halfedge next = mesh.next(h);
        const bool isOfEdge = mesh.source(h) == other || mesh.target(next) == other;
        if (isOfEdge && v == v1) continue;
        triangles_.push_back({placeOf(mesh.source(h)), placeOf(v), placeOf(mesh.target(next)), h, isOfEdge});
      }
  }

  Vec3 middle() const { return (ends_[0] + ends_[1]) / 2.0; }
  const std::array<Vec3, 2>& ends() const { return ends_; }

  /// Whether a triangle that stays would turn by a right angle or more, or lose its area.
  bool turns(const Vec3& place) const {
    return std::ranges::any_of(triangles_, [&](const Triangle& t) {
      return !t.isOfEdge &&
             !(dot(cross(t.before - t.end, t.after - t.end), cross(t.before - place, t.after - place)) > 0);
    });
  }
  bool allows(const Vec3& place) const { return isNear(place) && isAmongPlanes(place); }
  /// Of the ends and the middle, the place that leaves the ends nearest to what is left around it.
  Vec3 leastPlace() const {
    Vec3 best = middle();
    double least = squaredLeft(best);
    for (const Vec3& end : ends_)
      if (const double left = squaredLeft(end); left < least) {
        best = end;
        least = left;
      }
    return best;
  }
  /// Lindstrom's and Turk's cost of a place by the volumes between it and the triangles [LindstromTurk1998]:
  /// half of the sum of their squares.
  double volumeCost(const Vec3& place) const {
    double sum = 0;
    for (const Triangle& t : triangles_) {
      const double sixfold = dot(cross(t.before - t.end, t.after - t.end), place - t.end);
      sum += sixfold * sixfold;
    }
    return sum / 72;
  }

 private:
  /// Of places by what they are solved of.
  static constexpr double kRounding = 1e-9;

  struct Triangle {
    Vec3 before, end, after;
    Halfedge halfedge;  // to the end
    bool isOfEdge;      // it vanishes

    SpaceTriangle places(const Vec3& at) const { return {before, at, after}; }
  };
  struct Plane {
    Vec3 through, normal;
    double least, most;  // of the ends of the edge and 0, along the normal
    double bridged;      // the rise of an edge that runs along the plane
  };
  using Planes = boost::container::small_vector<Plane, 24>;

  Vec3 placeOf(Vertex v) const {
    const auto& p = mesh_.point(v);
    return {p.x(), p.y(), p.z()};
  }

  static double squaredFrom(const Vec3& p, const SpaceTriangle& triangle) {
    return squaredDistance(p, nearestWithShares(p, triangle).place);
  }

  bool isNear(const Vec3& place) const {
    const double at =
        squaredLength_ > 0 ? std::clamp(dot(place - ends_[0], edge_) / squaredLength_, 0.0, 1.0) : 0;
    const double rounding = kRounding * kRounding * squaredLength_;
    double off = squaredDistance(place, ends_[0] + at * edge_);
    for (const Triangle& t : triangles_) {
      if (off <= rounding) return true;
      off = std::min(off, squaredFrom(place, t.places(t.end)));
    }
    const double enough = off - rounding;
    return leaves(ends_[0], enough) || leaves(ends_[1], enough) || leaves(middle(), enough);
  }
  /// Whether squaredLeft() is this much; of most triangles their planes are far enough.
  bool leaves(const Vec3& place, double squared) const {
    return std::ranges::any_of(ends_, [&](const Vec3& end) {
      return end != place && std::ranges::all_of(triangles_, [&](const Triangle& t) {
               if (t.isOfEdge) return true;
               const Vec3 normal = cross(t.before - place, t.after - place);
               const double height = dot(normal, end - place);
               return height * height > squared * dot(normal, normal) ||
                      squaredFrom(end, t.places(place)) >= squared;
             });
    });
  }
  /// The squared distance from the ends to the triangles that stay, around a place.
  double squaredLeft(const Vec3& place) const {
    double most = 0;
    for (const Vec3& end : ends_) {
      if (end == place) continue;
      double least = std::numeric_limits<double>::infinity();
      for (const Triangle& t : triangles_)
        if (!t.isOfEdge) least = std::min(least, squaredFrom(end, t.places(place)));
      if (least < std::numeric_limits<double>::infinity()) most = std::max(most, least);
    }
    return most;
  }

  bool isAmongPlanes(const Vec3& place) const {
    Planes planes;
    double reach = 0;
    const auto add = [&](const Vec3& through, const Vec3& along) {
      const double length = norm(along);
      if (!(length > 0)) return;
      const Vec3 normal = along / length;
      const double first = dot(ends_[0] - through, normal), second = dot(ends_[1] - through, normal);
      const double across = dot(edge_, normal);
      const double alongEdge = squaredLength_ > 0 ? 1 - across * across / squaredLength_ : 0;
      planes.push_back(
          {through, normal, std::min({0.0, first, second}), std::max({0.0, first, second}),
           std::max(std::fabs(first), std::fabs(second)) * alongEdge * alongEdge * alongEdge * alongEdge});
      reach = std::max(reach, squaredDistance(ends_[0], through));
    };
    for (const Triangle& t : triangles_) {
      const Vec3 normal = cross(t.after - t.end, t.before - t.end);
      if (!t.isOfEdge) add(t.end, normal);
      for (const Halfedge h : {t.halfedge, mesh_.next(t.halfedge), mesh_.prev(t.halfedge)}) {
        if (!mesh_.is_border(mesh_.opposite(h))) continue;
        const Vec3 from = placeOf(mesh_.source(h)), to = placeOf(mesh_.target(h));
        if (isEnd(from) && isEnd(to)) continue;
        add(from, cross(to - from, normal));
      }
    }
    const double rounding = kRounding * std::sqrt(reach);
    return std::ranges::all_of(planes, [&](const Plane& plane) {
      const double is = dot(place - plane.through, plane.normal);
      const double beyond = std::max(plane.least - is, is - plane.most) - rounding;
      return beyond <= 0 || std::ranges::any_of(planes, [&](const Plane& other) {
               return beyond <= other.bridged * std::max(0.0, dot(plane.normal, other.normal));
             });
    });
  }
  bool isEnd(const Vec3& p) const { return p == ends_[0] || p == ends_[1]; }

  const Mesh& mesh_;
  std::array<Vec3, 2> ends_;
  Vec3 edge_;
  double squaredLength_ = 0;
  boost::container::small_vector<Triangle, 24> triangles_;
};

}  // namespace arete

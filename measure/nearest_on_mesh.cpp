// SPDX-License-Identifier: GPL-3.0-or-later
//
// A traversal of CGAL's AABB tree, the nearer child first; a box no nearer than the best triangle so far is
// skipped. CGAL's own closest-point query is not used: it starts from a hint, visits the children in a fixed
// order, and requires triangles that are not degenerate.
#include "measure/nearest_on_mesh.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace arete {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;

/// A triangle as the tree holds it (CGAL's concept AABBPrimitive).
class Primitive {
 public:
  using Id = std::uint32_t;
  using Point = Kernel::Point_3;
  using Datum = Kernel::Triangle_3;

  Primitive(Id id, const SpaceTriangle& corners) : id_(id), corners_(corners) {}

  Id id() const { return id_; }
  const SpaceTriangle& corners() const { return corners_; }
  Datum datum() const { return {point(0), point(1), point(2)}; }
  /// The point by which the tree is sorted.
  Point reference_point() const { return point(0); }

 private:
  Point point(int i) const { return {corners_[i].x, corners_[i].y, corners_[i].z}; }

  Id id_;
  SpaceTriangle corners_;
};

using Traits = CGAL::AABB_traits<Kernel, Primitive>;

double squaredDistance(const Vec3& p, const CGAL::Bbox_3& box) {
  const double x = std::max({box.xmin() - p.x, 0.0, p.x - box.xmax()}),
               y = std::max({box.ymin() - p.y, 0.0, p.y - box.ymax()}),
               z = std::max({box.zmin() - p.z, 0.0, p.z - box.zmax()});
  return x * x + y * y + z * z;
}

/// The traversal's state and its decisions at each node and triangle (CGAL's traversal traits).
class Walk {
 public:
  using Priority = double;

  bool go_further() const { return true; }

  template <class Node>
  std::pair<bool, Priority> do_intersect_with_priority(const Vec3& p, const Node& node) const {
    const double squared = squaredDistance(p, node.bbox());
    return {squared < squared_, -squared};
  }
  template <class Node>
  bool do_intersect(const Vec3& p, const Node& node) const {
    return squaredDistance(p, node.bbox()) < squared_;
  }

  void intersection(const Vec3& p, const Primitive& primitive) {
    const Vec3 point = nearestOnTriangle(p, primitive.corners());
    const double squared = squaredDistance(p, point);
    if (squared >= squared_) return;
    squared_ = squared;
    answer_.point = point;
    answer_.triangle = primitive.id();
  }

  NearestOnMesh::Answer answer() const { return {answer_.point, answer_.triangle, std::sqrt(squared_)}; }

 private:
  double squared_ = std::numeric_limits<double>::infinity();
  NearestOnMesh::Answer answer_;
};

}  // namespace

struct NearestOnMesh::Tree {
  CGAL::AABB_tree<Traits> boxes;
};

NearestOnMesh::NearestOnMesh(const TriangleMesh& mesh) : tree_(std::make_unique<Tree>()) {
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t];
    const SpaceTriangle corners{mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]]};
    tree_->boxes.insert(Primitive(t, corners));
  }
  tree_->boxes.build();
}

NearestOnMesh::~NearestOnMesh() = default;

NearestOnMesh::Answer NearestOnMesh::nearest(const Vec3& p) const {
  Walk walk;
  tree_->boxes.traversal_with_priority(p, walk);
  return walk.answer();
}

}  // namespace arete

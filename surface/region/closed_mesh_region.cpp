// SPDX-License-Identifier: GPL-3.0-or-later
//
// A tree of boxes over the triangles [CGAL] answers all questions: whether a triangle meets one of them or is
// within a distance of one, whether a point is inside, and how far it is from them.
#include "surface/region/closed_mesh_region.h"

#include <CGAL/AABB_face_graph_triangle_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include "engine/base/box3.h"
#include "engine/base/triangle_gap.h"

namespace arete {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_face_graph_triangle_primitive<Mesh>>>;

constexpr double kWiden = 1 + 1e-9;

Point pointOf(const Vec3& p) {
  return {p.x, p.y, p.z};
}

Vec3 placeOf(const Point& p) {
  return {p.x(), p.y(), p.z()};
}

/// Goes through the triangles of a tree until one is within a distance of a given one.
class NearTraversal {
 public:
  NearTraversal(const Mesh& mesh, const SpaceTriangle& triangle, double distance)
      : mesh_(mesh), triangle_(triangle) {
    Box3 box = Box3::empty();
    for (const Vec3& p : triangle) box.include(p);
    double largest = 0;
    for (const Vec3& p : {box.low, box.high})
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    reach_ = distance * kWiden + 1e-14 * largest;
    box_ = {box.low.x - reach_,  box.low.y - reach_,  box.low.z - reach_,
            box.high.x + reach_, box.high.y + reach_, box.high.z + reach_};
  }

  const CGAL::Bbox_3& box() const { return box_; }
  bool isFound() const { return isFound_; }

  // The interface of a traversal in CGAL.
  bool go_further() const { return !isFound_; }
  template <class Primitive>
  void intersection(const CGAL::Bbox_3&, const Primitive& primitive) {
    SpaceTriangle face;
    std::size_t i = 0;
    for (const auto v : mesh_.vertices_around_face(mesh_.halfedge(primitive.id())))
      face[i++] = placeOf(mesh_.point(v));
    isFound_ = gapBetween(face, triangle_) <= reach_;
  }
  template <class Node>
  bool do_intersect(const CGAL::Bbox_3& query, const Node& node) const {
    return CGAL::do_overlap(query, node.bbox());
  }

 private:
  const Mesh& mesh_;
  const SpaceTriangle& triangle_;
  double reach_ = 0;
  CGAL::Bbox_3 box_;
  bool isFound_ = false;
};

}  // namespace

struct ClosedMeshRegion::State {
  Mesh mesh;
  Tree tree;
  std::unique_ptr<CGAL::Side_of_triangle_mesh<Mesh, Kernel>> sides;

  bool holds(const Vec3& p) const { return (*sides)(pointOf(p)) != CGAL::ON_UNBOUNDED_SIDE; }
  double squaredDistance(const Vec3& p) const { return tree.squared_distance(pointOf(p)); }
  /// Whether a triangle of the mesh is within a distance of another one; a mesh that the triangle crosses may
  /// not count.
  bool isNear(const SpaceTriangle& triangle, double distance) const {
    NearTraversal traversal(mesh, triangle, distance);
    tree.traversal(traversal.box(), traversal);
    return traversal.isFound();
  }
};

Result<std::shared_ptr<const ClosedMeshRegion>> ClosedMeshRegion::create(const TriangleMesh& given) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  std::map<std::tuple<double, double, double>, std::size_t> numberOf;
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> polygons;
  for (const auto& t : given.triangles) {
    std::vector<std::size_t> polygon;
    for (const std::uint32_t v : t) {
      const Vec3& p = given.positions[v];
      const auto [at, isNew] = numberOf.try_emplace({p.x, p.y, p.z}, points.size());
      if (isNew) points.push_back(pointOf(p));
      polygon.push_back(at->second);
    }
    const bool isThin = polygon[0] == polygon[1] || polygon[1] == polygon[2] || polygon[2] == polygon[0];
    if (!isThin) polygons.push_back(std::move(polygon));
  }
  if (polygons.empty()) return failure(ErrorCode::invalidData, "has no triangles, and a region is closed");
  // Edges of more than two faces are taken apart, which leaves borders where they are.
  pmp::orient_polygon_soup(points, polygons);
  auto state = std::make_unique<State>();
  pmp::polygon_soup_to_polygon_mesh(points, polygons, state->mesh);
  std::size_t borders = 0;
  for (const auto edge : state->mesh.edges()) borders += state->mesh.is_border(edge) ? 1 : 0;
  if (borders > 0)
    return failure(ErrorCode::invalidData, "is not closed, and a region is: it has " +
                                               std::to_string(borders) +
                                               " edges that are borders or belong to more than two faces");
  state->tree.insert(faces(state->mesh).first, faces(state->mesh).second, state->mesh);
  state->tree.build();
  state->tree.accelerate_distance_queries();
  state->sides = std::make_unique<CGAL::Side_of_triangle_mesh<Mesh, Kernel>>(state->tree);
  return std::shared_ptr<const ClosedMeshRegion>(new ClosedMeshRegion(std::move(state)));
}

ClosedMeshRegion::ClosedMeshRegion(std::unique_ptr<State> state) : state_(std::move(state)) {}
ClosedMeshRegion::~ClosedMeshRegion() = default;

bool ClosedMeshRegion::meetsTriangle(const SpaceTriangle& t, double widening) const {
  const auto& [a, b, c] = t;
  if (state_->holds(a) || (widening > 0 && state_->isNear(t, widening))) return true;
  const Kernel::Triangle_3 triangle(pointOf(a), pointOf(b), pointOf(c));
  // A triangle without area is its sides.
  if (triangle.is_degenerate())
    return state_->tree.do_intersect(Kernel::Segment_3(pointOf(a), pointOf(b))) ||
           state_->tree.do_intersect(Kernel::Segment_3(pointOf(b), pointOf(c))) ||
           state_->tree.do_intersect(Kernel::Segment_3(pointOf(c), pointOf(a)));
  return state_->tree.do_intersect(triangle);
}

bool ClosedMeshRegion::meetsBall(const Vec3& c, double r) const {
  return std::sqrt(state_->squaredDistance(c)) <= r * kWiden || state_->holds(c);
}

bool ClosedMeshRegion::holdsBall(const Vec3& c, double r) const {
  return std::sqrt(state_->squaredDistance(c)) >= r * kWiden && state_->holds(c);
}

}  // namespace arete

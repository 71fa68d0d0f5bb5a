// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/edge_collapse.h"

#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>

#include <array>
#include <vector>

#include "engine/base/stopwatch.h"

namespace arete::bench {
namespace {

namespace sms = CGAL::Surface_mesh_simplification;
namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;

/// Stops when the faces are few enough; CGAL's own predicate counts edges.
struct FewEnoughFaces {
  std::uint64_t most;
  template <class Cost, class Profile>
  bool operator()(const Cost&, const Profile& profile, std::size_t, std::size_t) const {
    return profile.surface_mesh().number_of_faces() <= most;
  }
};

/// Places a vertex at the end of an edge at which Lindstrom's and Turk's cost is less.
struct BetterEnd {
  template <class Profile>
  boost::optional<Point> operator()(const Profile& profile) const {
    const sms::LindstromTurk_cost<Mesh> cost;
    const boost::optional<Point> first(profile.p0()), second(profile.p1());
    const auto atFirst = cost(profile, first), atSecond = cost(profile, second);
    if (!atFirst) return atSecond ? second : boost::none;
    return atSecond && *atSecond < *atFirst ? second : first;
  }
};

}  // namespace

Result<Collapsed> collapseEdges(const TriangleMesh& given, std::uint64_t triangles, EdgeCollapse method) {
  std::vector<Point> points;
  for (const Vec3& p : given.positions) points.emplace_back(p.x, p.y, p.z);
  std::vector<std::array<std::size_t, 3>> polygons;
  for (const auto& t : given.triangles) polygons.push_back({t[0], t[1], t[2]});
  if (!pmp::is_polygon_soup_a_polygon_mesh(polygons))
    return failure(ErrorCode::invalidData, "CGAL cannot hold it as an oriented manifold");
  Mesh mesh;
  pmp::polygon_soup_to_polygon_mesh(points, polygons, mesh);
  Collapsed collapsed;
  const Stopwatch watch;
  const FewEnoughFaces stop{triangles};
  if (method == EdgeCollapse::planeQuadrics) {
    const sms::GarlandHeckbert_plane_policies<Mesh, Kernel> policies(mesh);
    sms::edge_collapse(
        mesh, stop, CGAL::parameters::get_cost(policies.get_cost()).get_placement(policies.get_placement()));
  } else if (method == EdgeCollapse::lindstromTurk) {
    sms::edge_collapse(mesh, stop,
                       CGAL::parameters::get_cost(sms::LindstromTurk_cost<Mesh>())
                           .get_placement(sms::LindstromTurk_placement<Mesh>()));
  } else if (method == EdgeCollapse::lindstromTurkNormals) {
    using Placement = sms::LindstromTurk_placement<Mesh>;
    sms::edge_collapse(mesh, stop,
                       CGAL::parameters::get_cost(sms::LindstromTurk_cost<Mesh>())
                           .get_placement(sms::Bounded_normal_change_placement<Placement>(Placement())));
  } else {
    sms::edge_collapse(
        mesh, stop, CGAL::parameters::get_cost(sms::LindstromTurk_cost<Mesh>()).get_placement(BetterEnd()));
  }
  collapsed.seconds = watch.seconds();
  mesh.collect_garbage();
  for (const auto v : mesh.vertices()) {
    const Point& p = mesh.point(v);
    collapsed.mesh.positions.push_back({p.x(), p.y(), p.z()});
  }
  for (const auto f : mesh.faces()) {
    std::array<std::uint32_t, 3> corners{};
    std::size_t i = 0;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh))
      corners[i++] = static_cast<std::uint32_t>(v.idx());
    collapsed.mesh.triangles.push_back(corners);
  }
  return collapsed;
}

}  // namespace arete::bench

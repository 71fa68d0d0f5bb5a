// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's edge collapse with the memoryless cost and placement of Lindstrom and Turk [CGAL]. Its placement may
// fling a vertex where the constraints are nearly parallel; a place outside of the ball of the edge's
// surroundings is refused.
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Constrained_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "surface/decimate/carried.h"
#include "surface/decimate/contractions.h"
#include "surface/decimate/part_lines.h"
#include "surface/model/parts.h"

namespace arete {
namespace {

namespace sms = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Edge = Mesh::Edge_index;

struct Stop {
  std::size_t most;
  const RunContext& context;

  template <class Cost, class Profile>
  bool operator()(const Cost&, const Profile& profile, std::size_t, std::size_t) const {
    return context.cancelled() || profile.surface_mesh().number_of_faces() <= most;
  }
};

/// Of keepsBorders: edges of the border.
struct Constrained {
  using key_type = Edge;
  using value_type = bool;
  using reference = bool;
  using category = boost::readable_property_map_tag;
  const Mesh* mesh = nullptr;
  bool keepsBorders = false;

  friend bool get(const Constrained& map, Edge e) { return map.keepsBorders && map.mesh->is_border(e); }
};

struct Guarded {
  PartLines<Mesh> lines;
  sms::LindstromTurk_placement<Mesh> inner = {};

  template <class Profile>
  std::optional<Point> placeOf(const Profile& profile) const {
    if (lines.areAt(profile.v0_v1())) {
      const auto end = lines.chooseEnd(profile.v0_v1());
      return end ? std::optional<Point>(profile.surface_mesh().point(*end)) : std::nullopt;
    }
    const auto place = inner(profile);
    if (!place) return std::nullopt;
    const Point middle = CGAL::midpoint(profile.p0(), profile.p1());
    double reach = CGAL::squared_distance(profile.p0(), profile.p1());
    for (const auto v : profile.link())
      reach = std::max(reach, CGAL::squared_distance(middle, profile.surface_mesh().point(v)));
    return CGAL::squared_distance(middle, *place) <= reach ? std::optional<Point>(*place) : std::nullopt;
  }
  template <class Profile>
  boost::optional<Point> operator()(const Profile& profile) const {
    const std::optional<Point> place = placeOf(profile);
    return place ? boost::optional<Point>(*place) : boost::none;
  }
};

/// That of Lindstrom and Turk; what a line loses counts as what a border loses.
struct Cost {
  PartLines<Mesh> lines;
  sms::LindstromTurk_cost<Mesh> inner = {};

  template <class Profile, class Place>
  auto operator()(const Profile& profile, const Place& place) const {
    auto cost = inner(profile, place);
    if (!cost || !place || !lines.areAt(profile.v0_v1())) return cost;
    const bool isFirst = *place == profile.p0();
    const double loss = isFirst ? lines.squaredLoss(profile.v1(), profile.v0())
                                : lines.squaredLoss(profile.v0(), profile.v1());
    *cost += 0.5 * loss / 4 * CGAL::squared_distance(profile.p0(), profile.p1());
    return cost;
  }
};

}  // namespace

Result<DecimatedMesh> decimateByLindstromTurk(const SurfaceMesh& source, const DecimateOptions& options,
                                              const RunContext& context) {
  Mesh mesh;
  for (const Vec3& p : source.positions) mesh.add_vertex({p.x, p.y, p.z});
  for (std::uint32_t t = 0; t < source.triangles.size(); ++t) {
    const auto& [i, j, k] = source.triangles[t];
    if (mesh.add_face(Mesh::Vertex_index(i), Mesh::Vertex_index(j), Mesh::Vertex_index(k)) ==
        Mesh::null_face())
      return failure(
          ErrorCode::invalidData,
          fmt::format(
              "triangle {} of vertices {}, {} and {} makes the mesh no surface (an edge of more than two "
              "triangles, or triangles that turn against each other): arete mesh repair mends it",
              t, i, j, k));
  }
  // Faces and vertices keep their numbers, because none is removed before.
  Constrained constrained;
  constrained.mesh = &mesh;
  constrained.keepsBorders = options.keepsBorders;
  const std::vector<std::uint32_t> partOf = partsOf(source, source.triangles.size());
  const PartLines<Mesh> lines(mesh, partOf);
  const auto steps = sms::edge_collapse(
      mesh, Stop{options.maxTriangles, context},
      CGAL::parameters::get_cost(Cost{lines})
          .get_placement(
              sms::Constrained_placement<sms::Bounded_normal_change_placement<Guarded>, Constrained>(
                  constrained, sms::Bounded_normal_change_placement<Guarded>(Guarded{lines})))
          .edge_is_constrained_map(constrained));
  if (context.cancelled()) return failure(ErrorCode::interrupted, "decimation was interrupted");
  TriangleMesh shape;
  std::vector<std::uint32_t> vertexOf, faceOf, numberOf(source.positions.size(), 0);
  for (const auto v : mesh.vertices()) {
    if (mesh.is_isolated(v)) continue;
    numberOf[v] = static_cast<std::uint32_t>(vertexOf.size());
    vertexOf.push_back(v);
    const Point& p = mesh.point(v);
    shape.positions.push_back({p.x(), p.y(), p.z()});
  }
  for (const auto f : mesh.faces()) {
    std::array<std::uint32_t, 3> corners{};
    std::size_t c = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) corners[c++] = numberOf[v];
    shape.triangles.push_back(corners);
    faceOf.push_back(f);
  }
  DecimatedMesh result = carried(source, std::move(shape), std::move(vertexOf), std::move(faceOf));
  result.steps = static_cast<std::uint64_t>(steps);
  return result;
}

}  // namespace arete

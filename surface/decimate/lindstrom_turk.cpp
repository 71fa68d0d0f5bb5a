// SPDX-License-Identifier: GPL-3.0-or-later
//
// CGAL's edge collapse with the memoryless cost and placement of Lindstrom and Turk [CGAL]. Places that fling
// a vertex far (surface/decimate/edge_star.h) are replaced by the best of the ends and of their middle. The
// cost is found here, because CGAL's collects the triangles once more.
//
// CGAL's cost of an edge takes time by the triangles of its ends, and is found anew for all of them after
// each step. Vertices of very many triangles get fewer before (narrowWideVertices()).
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Edge_collapse_visitor_base.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Constrained_placement.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "surface/decimate/carried.h"
#include "surface/decimate/contractions.h"
#include "surface/decimate/edge_star.h"
#include "surface/decimate/nearest_corners.h"
#include "surface/decimate/part_lines.h"
#include "surface/decimate/standing.h"
#include "surface/model/charts.h"

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

Vec3 placeOf(const Point& p) {
  return {p.x(), p.y(), p.z()};
}

/// CGAL's placement, or one on the edge where it is too far away. Nothing where a triangle would turn over.
struct Guarded {
  PartLines<Mesh> lines;
  sms::LindstromTurk_placement<Mesh> inner = {};

  template <class Profile>
  boost::optional<Point> operator()(const Profile& profile) const {
    const EdgeStar<Mesh> star(profile.surface_mesh(), profile.v0(), profile.v1());
    const std::optional<Vec3> place = placeFor(profile, star);
    if (!place || star.turns(*place)) return boost::none;
    return Point(place->x, place->y, place->z);
  }

 private:
  template <class Profile>
  std::optional<Vec3> placeFor(const Profile& profile, const EdgeStar<Mesh>& star) const {
    if (lines.areAt(profile.v0_v1())) {
      const auto end = lines.chooseEnd(profile.v0_v1());
      return end ? std::optional(placeOf(profile.surface_mesh().point(*end))) : std::nullopt;
    }
    const boost::optional<Point> place = inner(profile);
    if (!place) return std::nullopt;
    return star.allows(placeOf(*place)) ? placeOf(*place) : star.leastPlace();
  }
};

/// That of Lindstrom and Turk; what a line loses counts as what a border loses.
struct Cost {
  PartLines<Mesh> lines;

  template <class Profile>
  boost::optional<double> operator()(const Profile& profile, const boost::optional<Point>& place) const {
    if (!place) return boost::none;
    const Mesh& mesh = profile.surface_mesh();
    double cost = EdgeStar<Mesh>(mesh, profile.v0(), profile.v1()).volumeCost(placeOf(*place));
    double loss = 0;  // four times the squared areas
    for (const auto border : profile.border_edges())
      loss += CGAL::cross_product(mesh.point(mesh.source(border)) - *place,
                                  mesh.point(mesh.target(border)) - *place)
                  .squared_length();
    if (lines.areAt(profile.v0_v1()))
      loss += *place == profile.p0() ? lines.squaredLoss(profile.v1(), profile.v0())
                                     : lines.squaredLoss(profile.v0(), profile.v1());
    cost += 0.5 * loss / 4 * CGAL::squared_distance(profile.p0(), profile.p1());
    return std::isfinite(cost) ? boost::optional<double>(cost) : boost::none;
  }
};

/// Remembers which vertex became which.
struct Joins : sms::Edge_collapse_visitor_base<Mesh> {
  std::vector<std::uint32_t>* joinedTo = nullptr;

  template <class Profile>
  void OnCollapsed(const Profile& profile, Mesh::Vertex_index kept) const {
    for (const auto v : {profile.v0(), profile.v1()})
      if (v != kept) (*joinedTo)[v] = kept;
  }
};

/// CGAL's time for a vertex grows with the third power of its triangles: above the first they are made fewer,
/// above the second it is not begun.
constexpr std::size_t kWideVertex = 128, kMostAtVertex = 512;

std::size_t mostAtVertex(const TriangleMesh& mesh, std::uint32_t& vertex) {
  std::vector<std::size_t> counts(mesh.positions.size(), 0);
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t v : t) ++counts[v];
  vertex = static_cast<std::uint32_t>(std::ranges::max_element(counts) - counts.begin());
  return counts.empty() ? 0 : counts[vertex];
}

Result<FramedResult> collapse(const FramedMesh& framed, const DecimateOptions& options,
                              const RunContext& context) {
  const SurfaceMesh& source = framed.source;
  Mesh mesh;
  for (const Vec3& p : framed.shape.positions) mesh.add_vertex({p.x, p.y, p.z});
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
  // Closed seams are lines as edges between parts are: charts lie on either side.
  const std::vector<std::uint32_t> partOf = chartsOf(source);
  const PartLines<Mesh> lines(mesh, partOf);
  std::vector<std::uint32_t> joinedTo(source.positions.size());
  std::iota(joinedTo.begin(), joinedTo.end(), 0u);
  Joins joins;
  joins.joinedTo = &joinedTo;
  const auto steps = sms::edge_collapse(
      mesh, Stop{options.maxTriangles, context},
      CGAL::parameters::get_cost(Cost{lines})
          .get_placement(sms::Constrained_placement<Guarded, Constrained>(constrained, Guarded{lines}))
          .edge_is_constrained_map(constrained)
          .visitor(joins));
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
  takeNearestAttributes(framed, result);
  result.steps = static_cast<std::uint64_t>(steps);
  return FramedResult{std::move(result), std::move(joinedTo)};
}

}  // namespace

Result<FramedResult> decimateByLindstromTurk(const FramedMesh& framed, const DecimateOptions& options,
                                             const RunContext& context) {
  std::uint32_t widest = 0;
  if (mostAtVertex(framed.shape, widest) <= kWideVertex) return collapse(framed, options, context);
  Result<FramedResult> narrow = narrowWideVertices(framed, kWideVertex, options, context);
  if (!narrow) return narrow;
  const DecimatedMesh& before = narrow->decimated;
  if (const std::size_t most = mostAtVertex(before.mesh, widest); most > kMostAtVertex)
    return failure(
        ErrorCode::invalidData,
        fmt::format("vertex {} has {} triangles whose other corners cannot be joined, and Lindstrom-Turk "
                    "takes time by their third power: qem does not",
                    before.vertexOf[widest], most));
  Result<FramedResult> last = collapse({before.mesh, before.mesh.shape(), framed.rounding}, options, context);
  if (!last) return last;
  // Back to the numbers of the source.
  DecimatedMesh& result = last->decimated;
  follow(narrow->joinedTo);
  follow(last->joinedTo);
  std::vector<std::uint32_t> numberOf(framed.shape.positions.size(), MeshAttributes::kNone);
  for (std::uint32_t v = 0; v < before.vertexOf.size(); ++v) numberOf[before.vertexOf[v]] = v;
  for (std::uint32_t& to : narrow->joinedTo)
    if (numberOf[to] != MeshAttributes::kNone) to = before.vertexOf[last->joinedTo[numberOf[to]]];
  for (std::uint32_t& v : result.vertexOf) v = before.vertexOf[v];
  for (std::uint32_t& f : result.faceOf) f = before.faceOf[f];
  const std::uint64_t steps = before.steps + result.steps;
  result = carried(framed.source, std::move(result.mesh.shape()), std::move(result.vertexOf),
                   std::move(result.faceOf));
  takeNearestAttributes(framed, result);
  result.steps = steps;
  last->joinedTo = std::move(narrow->joinedTo);
  return last;
}

}  // namespace arete

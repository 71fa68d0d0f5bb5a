// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/decimate/decimate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "engine/parallel/with_threads.h"
#include "surface/decimate/contractions.h"
#include "surface/decimate/standing.h"
#include "surface/edit/normals.h"
#include "surface/edit/small_components.h"
#include "surface/model/transfer.h"
#include "surface/repair/repair.h"

namespace arete {
namespace {

bool hasTriangleWithoutArea(const TriangleMesh& mesh) {
  return std::ranges::any_of(mesh.triangles, [&](const auto& t) {
    const Vec3 &a = mesh.positions[t[0]], &b = mesh.positions[t[1]], &c = mesh.positions[t[2]];
    const Vec3 normal = cross(b - a, c - a);
    return !(dot(normal, normal) > 0);
  });
}

/// Around the first vertex of the first triangle: differences from a point of the mesh are exact where the
/// mesh is small beside its coordinates, so that its place leaves no trace.
Vec3 originOf(const TriangleMesh& mesh) {
  return mesh.triangles.empty() ? Vec3{0, 0, 0} : mesh.positions[mesh.triangles[0][0]];
}

Result<DecimatedMesh> decimateFramed(const SurfaceMesh& mesh, const DecimateOptions& options,
                                     const RunContext& context) {
  FramedMesh framed{mesh, mesh.shape()};
  const Vec3 origin = originOf(mesh);
  double largest = 0;
  for (Vec3& p : framed.shape.positions) {
    largest = std::max({largest, std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    p = p - origin;
  }
  framed.rounding = std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
  ARETE_TRY(FramedResult result, options.method == DecimateOperator::cluster
                                     ? decimateByClusters(framed, options, context)
                                 : options.method == DecimateOperator::lindstromTurk
                                     ? decimateByLindstromTurk(framed, options, context)
                                     : decimateByContractions(framed, options, context));
  follow(result.joinedTo);
  DecimatedMesh& decimated = result.decimated;
  decimated.triangleFor = trianglesFor(framed, decimated, result.joinedTo);
  for (std::size_t v = 0; v < decimated.vertexOf.size(); ++v) {
    Vec3& p = decimated.mesh.positions[v];
    const std::uint32_t of = decimated.vertexOf[v];
    p = p == framed.shape.positions[of] ? mesh.positions[of] : p + origin;
  }
  return std::move(decimated);
}

/// Of a mesh without its triangles without area.
Result<DecimatedMesh> decimateMended(const SurfaceMesh& mesh, const DecimateOptions& options,
                                     const RunContext& context) {
  ARETE_TRY(RepairedMesh repaired, repair(mesh, {.splitsAtTJunctions = false}, context));
  const std::vector<std::uint32_t> vertexOf = repaired.vertexOf, faceOf = repaired.triangleOf;
  ARETE_TRY(const SurfaceMesh mended, transferAttributes(mesh, std::move(repaired.mesh), vertexOf, faceOf));
  if (mended.triangles.empty()) return failure(ErrorCode::degenerate, "no face of the mesh has an area");
  ARETE_TRY(DecimatedMesh result, decimateFramed(mended, options, context));
  std::vector<std::uint32_t> triangleFor(mesh.triangles.size(), MeshAttributes::kNone);
  for (std::size_t t = faceOf.size(); t-- > 0;) triangleFor[faceOf[t]] = result.triangleFor[t];
  result.triangleFor = std::move(triangleFor);
  for (std::uint32_t& v : result.vertexOf) v = vertexOf[v];
  for (std::uint32_t& f : result.faceOf) f = faceOf[f];
  return result;
}

}  // namespace

Result<DecimatedMesh> decimate(const SurfaceMesh& mesh, const DecimateOptions& options,
                               const RunContext& context) {
  ARETE_CHECK(mesh.validate());
  if (options.maxTriangles == 0)
    return failure(ErrorCode::invalidData, "maxTriangles is 0", "`maxTriangles`");
  // Quadrics multiply four lengths.
  constexpr double kLeast = 1e-30, kMost = 1e30;
  const double diagonal = diagonalOf(mesh);
  if (!(diagonal == 0 || (diagonal >= kLeast && diagonal <= kMost)))
    return failure(ErrorCode::invalidData,
                   fmt::format("a diagonal of {} is not between {} and {}", diagonal, kLeast, kMost));
  // Normals that no picture tells apart, and those of flat faces, are no seams.
  std::optional<SurfaceMesh> joined;
  bool dropsFlatNormals = false;
  if (mesh.hasWedges()) {
    joined = mesh;
    joinAgreeingNormals(*joined);
    dropsFlatNormals = dropFlatNormals(*joined);
  }
  const SurfaceMesh& source = joined ? *joined : mesh;
  Result<DecimatedMesh> decimated = withThreads(context, [&] {
    // Clusters take any triangles, and join what is at one place themselves.
    return options.method != DecimateOperator::cluster && hasTriangleWithoutArea(source)
               ? decimateMended(source, options, context)
               : decimateFramed(source, options, context);
  });
  if (decimated) decimated->dropsFlatNormals = dropsFlatNormals;
  return decimated;
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Topology, vertices and triangles, and self-intersections side by side. Triangles with a vertex
// twice have no place in the topology: one of their edges has no length, and the other two are one edge.
#include "surface/diagnosis/diagnosis.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"
#include "surface/diagnosis/parts.h"

namespace arete {
namespace {

Result<MeshDiagnosis> diagnoseHere(const TriangleMesh& mesh, const DiagnosisOptions& options,
                                   const RunContext& context) {
  ARETE_CHECK(mesh.validate());
  if (mesh.triangles.size() >= std::numeric_limits<std::uint32_t>::max() / 3)
    return failure(ErrorCode::unsupported,
                   "the mesh has more triangles than 32-bit numbers of corners allow");
  MeshDiagnosis result;
  result.vertices = mesh.positions.size();
  result.triangles = mesh.triangles.size();
  context.report("diagnose", 0);
  const std::array<Vec3, 2> box = diagnosis::boxOf(mesh);
  result.boxLow = box[0];
  result.boxHigh = box[1];
  result.diagonal = diagnosis::diagonalOf(box);
  if (context.cancelled()) return failure(ErrorCode::interrupted, "the diagnosis was interrupted");
  const diagnosis::KeptTriangles kept(mesh);
  // Each fills members of its own.
  std::optional<diagnosis::SelfIntersections> crossing;
  parallelInvoke([&] { diagnosis::examineTopology(mesh, kept, options, result); },
                 [&] {
                   diagnosis::examineVertices(mesh, options, result);
                   diagnosis::examineFaces(mesh, options, result);
                 },
                 [&] {
                   if (options.selfIntersections)
                     crossing = diagnosis::countSelfIntersections(
                         mesh, std::min(options.mostPlaces, DiagnosisOptions::kMostCrossings), context);
                 });
  if (context.cancelled() || (options.selfIntersections && !crossing))
    return failure(ErrorCode::interrupted, "the diagnosis was interrupted");
  if (options.selfIntersections) {
    MeshFindings& found = result.selfIntersections.emplace();
    for (const auto& [first, second] : crossing->pairs)
      diagnosis::add(found, options.mostPlaces, {first, second}, diagnosis::centroid(mesh, first));
    found.count = crossing->count;
  }
  context.report("diagnose", 1);
  return result;
}

}  // namespace

Result<MeshDiagnosis> diagnose(const TriangleMesh& mesh, const DiagnosisOptions& options,
                               const RunContext& context) try {
  return withThreads(context, [&] { return diagnoseHere(mesh, options, context); });
} catch (...) {
  return caughtFailure();
}

}  // namespace arete

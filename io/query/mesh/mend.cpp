// SPDX-License-Identifier: GPL-3.0-or-later
//
// Borders are welded by a stated distance, or else by the distance that the rounding of the file explains;
// then the mesh is mended, and its attributes follow.
#include "io/query/mesh/mend.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <utility>
#include <vector>

#include "engine/base/warning.h"
#include "surface/diagnosis/diagnosis.h"
#include "surface/edit/joined_surface.h"
#include "surface/edit/small_components.h"
#include "surface/model/transfer.h"

namespace arete {
namespace {

using Json = nlohmann::ordered_json;

/// Errors that the file states of its triangles, for the triangles that were made of them.
void carryErrors(MeshFile& file, const std::vector<std::uint32_t>& triangleOf, bool hasMoved) {
  if (file.triangleErrors.empty()) return;
  if (hasMoved || std::ranges::find(triangleOf, RepairedMesh::kNone) != triangleOf.end()) {
    file.triangleErrors.clear();
    file.warnings.push_back(
        {WarningCode::omitted, "the errors of its triangles do not hold for the mended surface: left out"});
    return;
  }
  std::vector<float> errors;
  for (const std::uint32_t t : triangleOf) errors.push_back(file.triangleErrors[t]);
  file.triangleErrors = std::move(errors);
}

/// Mends the mesh in the file.
/// @param hasMoved  errors that the mesh carries no longer hold where welding has moved a vertex
Result<RepairedMesh> mend(MeshInput& input, RepairOptions options, bool hasMoved, const RunContext& context) {
  MeshFile& file = input.file;
  options.rounding = input.rounding;
  options.partOf = file.mesh.objectOf;
  Result<RepairedMesh> repaired = repair(file.mesh, options, context);
  if (!repaired) return repaired;
  file.warnings.clear();
  if (!repaired->counts.isNothing()) {
    carryErrors(file, repaired->triangleOf, hasMoved);
    ARETE_TRY(SurfaceMesh mended,
              transferAttributes(file.mesh, repaired->mesh, repaired->vertexOf, repaired->triangleOf));
    file.mesh = std::move(mended);
  } else if (hasMoved) {
    std::vector<std::uint32_t> same(file.mesh.triangles.size());
    std::iota(same.begin(), same.end(), 0u);
    carryErrors(file, same, hasMoved);
  }
  file.mesh.faceOf.clear();  // the triangles are the faces of what is written
  return repaired;
}

/// How far apart the borders are that are one but for the rounding of the file; 0: there are none, or edges
/// of borders are too short for it.
Result<double> distanceOfNearBorders(const MeshInput& input, const RunContext& context) {
  const TriangleMesh& mesh = input.file.mesh;
  ARETE_TRY(
      const MeshDiagnosis d,
      diagnose(mesh, {.mostPlaces = 0, .selfIntersections = false, .rounding = input.rounding}, context));
  return d.farthestNear <= d.shortestBorderEdge / 4 ? d.farthestNear : 0;
}

Json countsJson(const RepairCounts& c) {
  return {{"turnedSolids", c.turnedSolids},         {"turnedCavities", c.turnedCavities},
          {"duplicateFaces", c.duplicateTriangles}, {"degenerateFaces", c.degenerateTriangles},
          {"joinedVertices", c.joinedVertices},     {"tJunctions", c.tJunctions},
          {"splitSheetEdges", c.splitSheetEdges},   {"turnedFaces", c.turnedTriangles},
          {"addedVertices", c.addedVertices},       {"filledHoles", c.filledHoles},
          {"fillingTriangles", c.fillingTriangles}, {"unusedVertices", c.unusedVertices}};
}

Json weldedJson(const WeldOutcome& welded) {
  return {
      {"distance", welded.distance}, {"diagonal", welded.diagonal}, {"isOfRounding", welded.isOfRounding},
      {"vertices", welded.vertices}, {"edges", welded.edges},       {"farthestMove", welded.farthestMove}};
}

}  // namespace

Result<MendedMesh> mendMesh(MeshInput& input, const MendOptions& options, const RunContext& context) {
  MendedMesh mended;
  SurfaceMesh& mesh = input.file.mesh;
  double distance = options.weld.value_or(0);
  if (!options.weld) {
    ARETE_TRY(distance, distanceOfNearBorders(input, context));
  }
  if (options.weld || distance > 0) {
    WeldOutcome welded{.distance = distance, .isOfRounding = !options.weld, .diagonal = diagonalOf(mesh)};
    ARETE_TRY(const JoinedSurface joined,
              joinSurface(mesh, {.distance = distance, .partOf = mesh.objectOf}, context));
    welded.vertices = joined.joinedVertices;
    welded.edges = joined.joinedEdges;
    welded.farthestMove = joined.farthestMove;
    mended.welded = welded;
  }
  const bool hasMoved = mended.welded && mended.welded->farthestMove > 0;
  ARETE_TRY(mended.repaired, mend(input, options.repair, hasMoved, context));
  if (mesh.triangles.empty())
    return failure(ErrorCode::invalidData, "no face is left: all were without area");
  return mended;
}

nlohmann::ordered_json mendJson(const MendedMesh& mended, double rounding) {
  return {{"welded", mended.welded ? weldedJson(*mended.welded) : Json()},
          {"mended", countsJson(mended.repaired.counts)},
          {"rounding", rounding},
          {"openHoles", mended.repaired.openHoles},
          {"crossingParts", mended.repaired.crossingParts}};
}

}  // namespace arete

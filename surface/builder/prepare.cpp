// SPDX-License-Identifier: GPL-3.0-or-later
//
// Normals of corners are seams where they differ, as at the creases of a machine part. What no picture can
// show is no difference, and the normals of flat faces are left out (surface/edit/normals.h).
#include "surface/builder/prepare.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include "surface/builder/left_out_faces.h"
#include "surface/edit/normals.h"
#include "surface/model/parts.h"
#include "surface/model/transfer.h"
#include "surface/model/wedges.h"
#include "surface/repair/repair.h"

namespace arete {
namespace {

Status refuse(const MeshFindings& found, const RepairedMesh& repaired, const char* what, const char* remedy) {
  const auto vertexAt = [&](std::size_t i) { return repaired.vertexOf[found.places[0].elements[i]]; };
  return failure(
      ErrorCode::invalidData,
      fmt::format("{} {}, the first one between the vertices {} and {}, counted from 0; {}", found.count,
                  fmt::format(fmt::runtime(what), found.count == 1 ? "edge has" : "edges have"), vertexAt(0),
                  vertexAt(1), remedy));
}

/// Vertices without a face are left out: whatever their coordinates are, they are no reason to refuse.
void forgetUnusedNumbers(SurfaceMesh& mesh) {
  if (std::ranges::all_of(mesh.positions, [](const Vec3& p) { return isFinite(p); })) return;
  std::vector<std::uint8_t> isUsed(mesh.positions.size(), 0);
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle)
      if (v < isUsed.size()) isUsed[v] = 1;
  for (std::size_t v = 0; v < isUsed.size(); ++v)
    if (isUsed[v] == 0 && !isFinite(mesh.positions[v])) mesh.positions[v] = {};
}

/// Takes what belongs to faces out of a mesh.
MeshAttributes takeFaceAttributes(SurfaceMesh& mesh) {
  MeshAttributes taken;
  taken.triangleAttributes = std::exchange(mesh.triangleAttributes, {});
  taken.faceOf = std::exchange(mesh.faceOf, {});
  taken.objects = std::exchange(mesh.objects, {});
  taken.groups = std::exchange(mesh.groups, {});
  taken.objectOf = std::exchange(mesh.objectOf, {});
  taken.groupOf = std::exchange(mesh.groupOf, {});
  taken.materials = std::exchange(mesh.materials, {});
  taken.materialOf = std::exchange(mesh.materialOf, {});
  taken.pictures = std::exchange(mesh.pictures, {});
  return taken;
}

}  // namespace

Result<PreparedSurface> prepareSurface(SurfaceMesh source, const RunContext& context) {
  forgetUnusedNumbers(source);
  ARETE_CHECK(source.validate());
  // A surface that faces inwards, as a room, stays so.
  RepairOptions options{.splitsAtTJunctions = false, .turnsOutwards = false, .partOf = source.objectOf};
  ARETE_TRY(RepairedMesh repaired, repair(source, options, context));
  if (repaired.mesh.triangles.empty())
    return failure(ErrorCode::degenerate,
                   source.triangles.empty() ? "the mesh has no face" : "no face of the mesh has an area");
  const MeshDiagnosis& d = repaired.diagnosis;
  if (d.nonManifoldEdges.count > 0) {
    // What does not help is no advice.
    options.splitsSheets = true;
    const Result<RepairedMesh> split = repair(source, options, context);
    const std::uint64_t left = split ? split->diagnosis.nonManifoldEdges.count : d.nonManifoldEdges.count;
    const std::string remedy =
        left == 0 ? "repairing with `splitsSheets` makes several edges of each"
        : left < d.nonManifoldEdges.count
            ? fmt::format(
                  "repairing with `splitsSheets` makes several edges of each but {}, which have to be "
                  "taken apart by hand",
                  left)
            : "they have to be taken apart by hand: their faces meet again around both ends";
    return tl::unexpected(
        refuse(d.nonManifoldEdges, repaired, "{} more than two faces", remedy.c_str()).error());
  }
  if (d.nonOrientable.count > 0)
    return tl::unexpected(refuse(d.nonOrientable, repaired, "{} two faces that no turns make agree",
                                 "cut the surface there, as a Moebius strip has to be")
                              .error());
  PreparedSurface prepared;
  prepared.sourceVertices = source.positions.size();
  prepared.sourceFaces = source.triangles.size();
  prepared.boxLow = d.boxLow;
  prepared.boxHigh = d.boxHigh;
  prepared.diagonal = d.diagonal;
  const RepairCounts& c = repaired.counts;
  prepared.mending = {.duplicateFaces = c.duplicateTriangles,
                      .degenerateFaces = c.degenerateTriangles,
                      .splitFaces = c.splitTriangles,
                      .joinedVertices = c.joinedVertices,
                      .turnedFaces = c.turnedTriangles,
                      .addedVertices = c.addedVertices,
                      .unusedVertices = c.unusedVertices};
  prepared.vertexOf = std::move(repaired.vertexOf);
  prepared.faceOf = std::move(repaired.triangleOf);
  prepared.leftOutFaces = leftOutFacesOf(source, repaired.mesh, prepared.faceOf);
  prepared.ofSource = takeFaceAttributes(source);
  prepared.partOf = partsOf(prepared.ofSource, prepared.faceOf);
  if (c.isNothing()) {
    prepared.mesh = std::move(source);
  } else {
    ARETE_TRY(SurfaceMesh mesh,
              transferAttributes(source, std::move(repaired.mesh), prepared.vertexOf, prepared.faceOf));
    prepared.mesh = std::move(mesh);
  }
  if (prepared.mesh.hasWedges()) {
    moveToVertices(prepared.mesh);
    joinAgreeingNormals(prepared.mesh);
    prepared.mending.dropsFlatNormals = dropFlatNormals(prepared.mesh);
  }
  return prepared;
}

}  // namespace arete

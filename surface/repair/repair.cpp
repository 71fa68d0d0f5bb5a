// SPDX-License-Identifier: GPL-3.0-or-later
//
// The passes one after the other, and all of them again until none finds anything: what one mends can be what
// another one waits for, as a border that ends at a sheet which was split. Edges only become shorter and
// vertices only get copies for fans that there are, so it ends.
#include "surface/repair/repair.h"

#include <utility>

#include "engine/base/caught_failure.h"
#include "surface/diagnosis/parts.h"
#include "surface/repair/draft.h"

namespace arete {

Result<RepairedMesh> repair(const TriangleMesh& mesh, const RepairOptions& options,
                            const RunContext& context) try {
  ARETE_CHECK(mesh.validate());
  if (!options.partOf.empty() && options.partOf.size() != mesh.triangles.size())
    return failure(ErrorCode::invalidData, "there must be one part for each triangle", "partOf");
  repair_passes::Draft draft(mesh);
  const double distance = diagnosis::withinRounding(
      options.tJunctionTolerance * diagnosis::diagonalOf(diagnosis::boxOf(mesh)), options.rounding);
  context.report("repair", 0);
  RepairCounts before = {.unusedVertices = 1};
  for (std::uint64_t turns = 0; before != draft.counts || turns != draft.turns;) {
    before = draft.counts;
    turns = draft.turns;
    if (context.cancelled()) return failure(ErrorCode::interrupted, "the repair was interrupted");
    do {
      repair_passes::removeDuplicates(draft);
      repair_passes::removeDegenerate(draft);
    } while (options.splitsAtTJunctions && repair_passes::splitAtTJunctions(draft, distance, options.partOf));
    repair_passes::orient(draft, options);
    if (options.splitsSheets) repair_passes::splitSheets(draft);
    // Before fans get vertices of their own: a vertex at which two holes touch is one corner of each.
    repair_passes::fillHoles(draft, options.mostHoleEdges);
    repair_passes::splitFans(draft);
  }
  draft.removeUnusedVertices();

  ARETE_TRY(MeshDiagnosis diagnosis, diagnose(draft.mesh,
                                              {.selfIntersections = false,
                                               .tJunctionTolerance = options.tJunctionTolerance,
                                               .rounding = options.rounding},
                                              context));
  RepairedMesh repaired;
  repaired.mesh = std::move(draft.mesh);
  repaired.vertexOf = std::move(draft.vertexOf);
  repaired.triangleOf = std::move(draft.triangleOf);
  repaired.counts = draft.counts;
  repaired.openHoles = draft.openHoles;
  repaired.crossingParts = draft.crossingParts;
  repaired.diagnosis = std::move(diagnosis);
  context.report("repair", 1);
  return repaired;
} catch (...) {
  return caughtFailure();
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/decimate/decimate.h"

#include "engine/parallel/with_threads.h"
#include "surface/decimate/contractions.h"

namespace arete {

Result<DecimatedMesh> decimate(const SurfaceMesh& mesh, const DecimateOptions& options,
                               const RunContext& context) {
  if (const Status valid = mesh.validate(); !valid) return tl::unexpected(valid.error());
  if (options.maxTriangles == 0)
    return failure(ErrorCode::invalidData, "maxTriangles is 0", "`maxTriangles`");
  return withThreads(context, [&] {
    switch (options.method) {
      case DecimateOperator::cluster:
        return decimateByClusters(mesh, options, context);
      case DecimateOperator::lindstromTurk:
        return decimateByLindstromTurk(mesh, options, context);
      default:
        return decimateByContractions(mesh, options, context);
    }
  });
}

}  // namespace arete

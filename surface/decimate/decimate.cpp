// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/decimate/decimate.h"

#include <fmt/format.h>

#include "engine/parallel/with_threads.h"
#include "surface/decimate/contractions.h"
#include "surface/edit/small_components.h"

namespace arete {

Result<DecimatedMesh> decimate(const SurfaceMesh& mesh, const DecimateOptions& options,
                               const RunContext& context) {
  if (const Status valid = mesh.validate(); !valid) return tl::unexpected(valid.error());
  if (options.maxTriangles == 0)
    return failure(ErrorCode::invalidData, "maxTriangles is 0", "`maxTriangles`");
  // Quadrics multiply four lengths.
  constexpr double kLeast = 1e-30, kMost = 1e30;
  const double diagonal = diagonalOf(mesh);
  if (!(diagonal == 0 || (diagonal >= kLeast && diagonal <= kMost)))
    return failure(ErrorCode::invalidData,
                   fmt::format("a diagonal of {} is not between {} and {}", diagonal, kLeast, kMost));
  return withThreads(context, [&]() -> Result<DecimatedMesh> {
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

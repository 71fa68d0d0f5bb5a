// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "surface/decimate/decimate.h"

namespace arete {

/// decimate() by the operators that contract edges, pairs of vertices or triangles. Precondition: the mesh is
/// valid.
Result<DecimatedMesh> decimateByContractions(const SurfaceMesh& mesh, const DecimateOptions& options,
                                             const RunContext& context);

/// decimate() by clusters.
Result<DecimatedMesh> decimateByClusters(const SurfaceMesh& mesh, const DecimateOptions& options,
                                         const RunContext& context);

/// decimate() by CGAL's Lindstrom-Turk.
Result<DecimatedMesh> decimateByLindstromTurk(const SurfaceMesh& mesh, const DecimateOptions& options,
                                              const RunContext& context);

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "surface/model/parts.h"
#include "surface/model/surface_mesh.h"
#include "surface/model/surface_model.h"

namespace arete {

/// The charts of a mesh, by triangle: what hangs together without crossing a line (SurfaceParts) has the same
/// number. Empty without lines. O(n log n).
std::vector<std::uint32_t> chartsOf(const SurfaceMesh& mesh);

/// The charts of the finest front, by triangle of the MT: those of coarse triangles are the charts that they
/// stand for. Empty unless the model bounds its lines (SurfaceModel::boundsLines). O(n log n).
std::vector<std::uint32_t> chartsOf(const SurfaceModel& model);

/// What the lines of a model are between; its labels name faces of the source.
/// @param partOf receives the parts, which the result refers to
SurfaceParts partsOf(const SurfaceModel& model, std::vector<std::uint32_t>& partOf);

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "surface/attributes/attribute_weight.h"
#include "surface/model/surface_mesh.h"
#include "surface/model/surface_model.h"

namespace arete {

/// Builds the multitriangulation of a triangle mesh, with all its attributes. What leaves the surface as it
/// is is mended and counted (SurfaceModel::mending).
///
/// Every cut is an oriented manifold of the topology of the source: as many components, each with its Euler
/// number. Seams, edges between objects, materials and labels of faces, and their ends stay lines of every
/// cut, as creases are where the options ask for it, simplified along themselves: an error is a distance to
/// the same part and chart (SurfaceModel::boundsLines), and none vanishes. A new vertex is never made.
///
/// The result does not depend on the number of threads, nor, but for scale, on a power of two that all
/// coordinates are multiplied with. O(n log n) time. Errors: those of prepareSurface(); usage: an option out
/// of range; unsupported: too many triangles; interrupted; outOfMemory.
///
/// @param source is taken apart: moved in, it takes no memory beside what it becomes.
/// @param fewEnough  triangles at which the removals end, for cuts that are not coarser; 0: none is left
/// @param weights    of attributes in the order of the removals; empty: what is bounded has a weight of its
///                   own (AttributeField), and nothing else counts
Result<SurfaceModel> buildSurface(SurfaceMesh source, const SurfaceBuildOptions& options = {},
                                  const RunContext& context = {}, std::size_t fewEnough = 0,
                                  std::span<const AttributeWeight> weights = {});

}  // namespace arete

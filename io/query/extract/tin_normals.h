// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "engine/base/result.h"
#include "surface/model/surface_mesh.h"
#include "surface/normals/made_normals.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// A TIN of terrain with normals.
///
/// Smooth: the finest triangles at each vertex, weighted by their angles there, so that a coarse TIN is
/// shaded as the terrain. Beyond options.creaseAngleDegrees they are hard (isCrease()): a corner of the TIN
/// has the normal of the side into which it points; 180: no edge is one. Flat: of the TIN's own
/// triangles.
///
/// @param tin       positions in source coordinates
/// @param vertexOf  by vertex of the TIN: its number in the model's MT
/// @param model     whole, not a part: the finest triangles are its
/// @param toLengths leads source coordinates to right-handed ones, z up, in which angles have a meaning: the
///                  normals are of these
/// Errors: as makeNormals(). O(finest triangles).
Result<SurfaceMesh> withNormals(const TriangleMesh& tin, std::span<const std::uint32_t> vertexOf,
                                const TerrainModel& model, const std::function<Vec3(const Vec3&)>& toLengths,
                                const NormalsOptions& options);

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "surface/model/surface_model.h"
#include "viewer/gl/gl_objects.h"
#include "viewer/surface/upright.h"

namespace arete {

/// The vertices of a surface in graphics memory, written once: one for each wedge, or for each vertex of the
/// MT where there are no wedges. Every cut draws triangles of them.
struct SurfaceOnGpu {
  GlBuffer positions;      ///< 3 floats, upright
  GlBuffer normals;        ///< 3 floats, upright; zero: the triangle's own is to be used
  GlBuffer textureCoords;  ///< 4 floats: two sets, v from the upper side; empty without
  GlBuffer colors;         ///< 4 bytes, sRGB and alpha; empty without
};

/// O(vertices + triangles of the MT).
SurfaceOnGpu uploadSurface(const SurfaceModel& model, const Upright& upright);

}  // namespace arete

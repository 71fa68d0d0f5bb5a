// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "surface/model/surface_model.h"
#include "viewer/gl/gl_objects.h"
#include "viewer/surface/z_up_frame.h"

namespace arete {

/// The vertices of a surface in graphics memory: one for each wedge, or for each vertex of the MT where there
/// are no wedges. Uploaded once and indexed by every cut; displaced positions alone are rewritten.
struct SurfaceOnGpu {
  GlBuffer positions;      ///< 3 floats, upright
  GlBuffer normals;        ///< 3 floats, upright; zero: the triangle's own is to be used
  GlBuffer smoothNormals;  ///< the same without those that the file states; empty where it states none
  GlBuffer textureCoords;  ///< 4 floats: two sets, v from the upper side; empty without
  GlBuffer colors;         ///< 4 bytes, sRGB and alpha; empty without
};

/// Three floats for each drawn vertex, upright, as in the source.
std::vector<float> drawnPositions(const SurfaceModel& model, const ZUpFrame& upright);

/// O(vertices + triangles of the MT).
SurfaceOnGpu uploadSurface(const SurfaceModel& model, const ZUpFrame& upright);

}  // namespace arete

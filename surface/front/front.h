// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/cut/cut.h"
#include "surface/model/surface_mesh.h"
#include "surface/model/surface_model.h"

namespace arete {

/// The mesh of a cut, and where it comes from.
struct SurfaceFront {
  SurfaceMesh mesh;
  std::vector<std::uint32_t> vertexOf;  ///< by vertex: that of the source
  std::vector<std::uint32_t> faceOf;    ///< by triangle: a face of the source that it stands for
  std::vector<float> errors;            ///< by triangle, as stored: the largest distance
};

/// The front of a cut with the attributes of the source: vertices and wedges keep theirs to the bit, a
/// triangle has those of a face that it stands for. Objects, materials and pictures stay whole. Triangles and
/// vertices are in the order of the cut. O(front + attributes). Precondition: the cut is one of the model's
/// MT.
SurfaceFront surfaceOf(const SurfaceModel& model, const Cut& cut);

/// The finest front: the source as the build mended it.
SurfaceFront finestSurfaceOf(const SurfaceModel& model);

}  // namespace arete

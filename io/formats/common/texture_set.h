// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "surface/model/surface_mesh.h"

namespace arete {

/// The mesh for a format that has one set of texture coordinates: each face has, as "texcoord", those of the
/// set that the picture of its material's base colour is placed by, else those of the first of its pictures,
/// else those of the first set. The textures of the materials that used that set use the first one then. The
/// set that was the first has another name. Nothing: the mesh is so already. O(size).
std::optional<SurfaceMesh> withOneTextureSet(MeshRef mesh);

}  // namespace arete

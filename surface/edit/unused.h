// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "surface/model/surface_mesh.h"

namespace arete {

/// Leaves out the objects, groups and materials that no triangle has, and the pictures in the mesh that no
/// material uses. The others keep their order. Precondition: the mesh is valid. O(size).
void removeUnusedNames(MeshAttributes& mesh);

}  // namespace arete

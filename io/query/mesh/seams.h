// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "surface/model/surface_mesh.h"

namespace arete {

/// What keeps vertices where attributes or parts differ from face to face, and the field that leaves it out,
/// in backquotes, as the end of a sentence: "; "normal" differs at 480 edges: `dropAttributes` normal leaves
/// it out". Empty: nothing does. O(triangles).
std::string seamsText(const SurfaceMesh& mesh);

}  // namespace arete

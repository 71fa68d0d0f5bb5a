// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// Names for what is said of faces beside attributes; they can be left out as attributes can.
inline constexpr const char *kObjectsName = "objects", *kGroupsName = "groups", *kMaterialsName = "materials";

/// What dropAttributes() can leave out of a mesh: the names of its attributes, each once and in their order,
/// then "objects", "groups" and "materials" where there are any.
std::vector<std::string> droppableNames(const MeshAttributes& mesh);

/// Leaves out the attributes of these names, the file's own or an option's (surface/attributes/
/// attribute_names.h), of vertices, corners and faces. Corners of a vertex that
/// differed in nothing else are one again. Positions and triangles stay. A mesh whose parts are left out is
/// one part.
///
/// Errors: usage, with the name as culprit: there is none of that name; lists those that there are. Then the
/// mesh is as it was. O(n log n).
Status dropAttributes(SurfaceMesh& mesh, std::span<const std::string> names);

}  // namespace arete

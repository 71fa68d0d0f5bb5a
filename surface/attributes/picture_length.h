// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "surface/model/surface_mesh.h"

namespace arete {

/// How long a unit of texture coordinates is on a surface: the root of the area that a unit square covers, in
/// the mean. 0 where no triangle has an area in the picture. O(triangles).
/// @param ofWedges whose attribute it is; otherwise vertices'
double lengthOfPictureUnit(const SurfaceMesh& mesh, const Attribute& coordinates, bool ofWedges);

}  // namespace arete

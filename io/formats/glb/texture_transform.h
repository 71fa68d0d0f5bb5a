// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "surface/model/surface_mesh.h"

namespace arete {

/// Applies the transforms of textures that a glTF states (KHR_texture_transform, which materials keep under
/// "gltf:ROLE") to the texture coordinates, and takes them away: for formats that do not have them.
/// Coordinates that change become 32-bit floats. Where vertices are shared by materials whose transforms
/// differ, the coordinates become those of wedges.
///
/// The textures of one material and one set of coordinates can have one transform only: that of the base
/// color, else of the first.
///
/// @return A sentence for each material some of whose transforms are lost that way. O(size).
/// @param alsoOfMtl the shift and scale that an MTL states, too (io/formats/glb/texture_options.h).
std::vector<std::string> applyTextureTransforms(SurfaceMesh& mesh, bool alsoOfMtl = false);

/// Whether a material has a transform that applyTextureTransforms() takes away. O(materials).
bool hasTextureTransforms(const MeshAttributes& mesh, bool alsoOfMtl);

}  // namespace arete

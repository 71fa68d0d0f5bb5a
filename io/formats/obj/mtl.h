// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// The materials of a Wavefront MTL.
///
/// Kd is the base colour, as linear numbers; d, or without it 1 - Tr (but for "Tr 1", which some programs
/// write of what is opaque), is alpha, which blends where it is below 1. map_Kd, norm (or map_Kn), map_Ke are
/// textures of the roles that glTF has too, and so is the pair "map_Pr -imfchan g" and "map_Pm -imfchan b" of
/// one picture (metallicRoughness). Every other statement that names a picture is a texture of the role of
/// its keyword ("map_Bump"). Options of a texture are kept as Material::verbatim["mtl:<role>"], all other
/// statements, line by line, as verbatim["mtl"].
struct MtlMaterials {
  std::vector<Material> materials;  ///< in their order; of several of one name the first
  Warnings warnings;                ///< each a sentence about the file
};

/// Reads the text of an MTL. A texture that a material states twice is the later one, as most programs have
/// it. O(size).
MtlMaterials readMtl(std::string_view text);

/// The role of the texture that a keyword of MTL states; empty: it states none.
std::string mtlTextureRole(std::string_view keyword);

/// What MTL writes of a picture: its path beside the file. Empty: the texture is left out.
using PicturePath = std::function<Result<std::string>(const std::string& picture)>;

struct MtlText {
  std::string text;
  std::vector<std::string> lost;  ///< as MeshWriteReport::lost
};

/// The materials as an MTL, without a first line.
///
/// A normal map is written as both "norm" and "map_Bump", because some programs know the first only and some
/// the second. Of a material from glTF metallicFactor, roughnessFactor and emissiveFactor become Pm, Pr and
/// Ke.
///
/// @param names by material, each once: mtlNames().
///
/// Errors: those of `path`.
Result<MtlText> mtlText(std::span<const Material> materials, std::span<const std::string> names,
                        const PicturePath& path);

/// Names for the materials that MTL and OBJ can hold: on one line, not empty, without blanks at their ends,
/// and no two the same.
std::vector<std::string> mtlNames(std::span<const Material> materials);

}  // namespace arete

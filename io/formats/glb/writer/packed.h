// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "io/formats/common/file.h"
#include "io/formats/glb/writer/container.h"
#include "io/formats/glb/writer/parts.h"

namespace arete {

/// The glTF of the parts with KHR_mesh_quantization and EXT_meshopt_compression, both required: positions on
/// one grid for all (position_grid.h), attributes as packedValues() has them, triangles in the order of a
/// cache and vertices in the order of first use. Errors in the file grow by what the grid may add.
///
/// @param lost Gets what is rounded, and how many vertices fall together and triangles lose their area.
/// O(n log n).
GltfContent packedContent(const GltfParts& parts, const MeshWriteOptions& options,
                          std::vector<std::string>& lost);

}  // namespace arete

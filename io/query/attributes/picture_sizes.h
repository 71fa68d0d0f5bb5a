// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <filesystem>
#include <vector>

#include "engine/base/result.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// By material: width and height of the picture that a set of texture coordinates is for, of its colours if
/// it has some; {0, 0}: the material has none. Only the heads of the pictures are decoded. Errors: as
/// PictureSource and pictureSize(), with the picture as culprit.
Result<std::vector<std::array<double, 2>>> pictureSizesOf(const MeshAttributes& mesh,
                                                          const std::filesystem::path& folder,
                                                          std::uint32_t textureCoords);

}  // namespace arete

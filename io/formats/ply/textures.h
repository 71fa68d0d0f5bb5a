// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "io/formats/common/file.h"

namespace arete {

/// The materials of a mesh as a PLY has them: one picture each.
struct PlyTextures {
  std::vector<std::string> pictures;  ///< paths for comments TextureFile
  std::vector<std::int32_t> numbers =
      {};  ///< by triangle: which of them, -1: none; empty: all have the first
  std::vector<std::filesystem::path> files = {};
  std::vector<std::string> lost = {};
};

/// Places the pictures beside the file (io/formats/common/pictures.h). What a material has beside a picture
/// of its base color is lost.
///
/// Errors: those of PicturePlacer.
Result<PlyTextures> plyTextures(MeshRef mesh, const std::filesystem::path& path,
                                const MeshWriteOptions& options);

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// The MTL that was written for an OBJ.
struct ObjLibraryFile {
  std::string name;                                ///< without folders
  std::vector<std::filesystem::path> filesBeside;  ///< itself, and the pictures
  std::vector<std::string> lost;                   ///< as MeshWriteReport::lost
};

/// Writes the materials of a mesh beside its OBJ, and their pictures. The file is called as the OBJ is, with
/// a number behind the name if another model's file has that name: the first line says whose it is.
///
/// @param names mtlNames().
/// @param pictures the folder that pictures are named relative to.
///
/// Errors: those of FileWriter and PicturePlacer.
Result<ObjLibraryFile> writeObjLibrary(const MeshAttributes& mesh, std::span<const std::string> names,
                                       const std::filesystem::path& obj,
                                       const std::filesystem::path& pictures);

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/exchange/mesh_formats.h"

namespace arete {

struct ConvertOptions {
  std::string crs = {};  ///< any text GDAL takes; empty = what the mesh's file says. Nothing is reprojected.
};

/// What became of a mesh in another format.
struct ConvertedMesh {
  MeshFrame frame;                ///< of the file that was written
  std::string crsWkt;             ///< of the coordinates, whether the format can hold it or not
  std::string verticalUnit;       ///< likewise
  std::vector<std::string> lost;  ///< what the mesh had and the format has no place for: "the CRS", ...
  std::vector<std::string> warnings;
};

/// Writes a mesh that was read from one file in the format that the extension of `path` names, with its CRS,
/// unit and errors where the format can hold them. Errors: those of writeMesh(); usage, naming it, for a CRS
/// that GDAL does not understand. O(size).
Result<ConvertedMesh> convertMesh(MeshFile mesh, const std::filesystem::path& path,
                                  const ConvertOptions& options = {}, const RunContext& context = {});

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "engine/base/result.h"
#include "io/query/extract/model_file.h"
#include "io/store/amt/file.h"

namespace arete {

/// Opens a model of terrain. Errors: as openTerrainFile(); of a model of a surface it says how terrain
/// is made of the same file.
inline Result<AmtFile> openTerrain(const std::string& path) {
  Result<AmtFile> file = openTerrainFile(path);
  if (file || file.error().code != ErrorCode::unsupported) return file;
  if (const auto container = openModelFile(path); container && container->isOfSurface())
    file.error().message += "; build --as terrain takes the vertices of a mesh as samples of a terrain";
  return file;
}

}  // namespace arete

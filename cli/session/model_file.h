// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "cli/session/session.h"
#include "engine/base/result.h"
#include "io/query/extract/model_file.h"
#include "io/query/extract/query_footprint.h"
#include "io/store/amt/file.h"

namespace arete {

// A command that reads only the part of a file that its question needs opens the file, reads the outline,
// finds with it which places the question touches, and reads the terrain there. Every check is done.

/// Opens a model of terrain. Errors: as openTerrainFile(); of a model of a surface it says how terrain
/// is made of the same file.
inline Result<AmtFile> openTerrain(const std::string& path) {
  Result<AmtFile> file = openTerrainFile(path);
  if (file || file.error().code != ErrorCode::unsupported) return file;
  if (const auto container = openModelFile(path); container && container->isOfSurface())
    file.error().message += "; build --as terrain takes the vertices of a mesh as samples of a terrain";
  return file;
}

/// Reads everything but the terrain: of a raster, the root. Of points, the whole model, because the rounding
/// of their coordinates follows from their number.
///
/// Errors: those of AmtFile::read().
inline Result<TerrainModel> outlineOf(const AmtFile& file, const Session& session) {
  if (!file.model().isRaster) return file.read({}, session.context());
  return file.read({.wanted = requiredNowhere()}, session.context());
}

/// Reads the part of the model that a query requires.
///
/// @param outline of the file, from outlineOf().
/// @param wanted the error required at each place.
/// Errors: those of AmtFile::read().
inline Result<TerrainModel> readWanted(const AmtFile& file, const TerrainModel& outline,
                                       const RequiredError& wanted, const Session& session) {
  if (!outline.isRaster) return outline;
  return file.read({.wanted = wanted}, session.context());
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "cli/session/session.h"
#include "engine/base/result.h"
#include "io/amt/file.h"
#include "io/extract/query_footprint.h"

namespace arete {

// A command that reads no more of a file than its question needs opens it, asks for its outline, by which the
// question's places are known, and reads as far as they want, with every check.

/// All but the terrain itself: of a raster the root alone. Of points everything, since what their coordinates
/// are rounded by is told by how many there are.
inline Result<TerrainModel> outlineOf(const AmtFile& file, const Session& session) {
  if (!file.model().isRaster) return file.read({}, session.context());
  return file.read({.wanted = requiredNowhere()}, session.context());
}

/// The model, as far as it is wanted. `outline`: of the file.
inline Result<TerrainModel> readWanted(const AmtFile& file, const TerrainModel& outline,
                                       const RequiredError& wanted, const Session& session) {
  if (!outline.isRaster) return outline;
  return file.read({.wanted = wanted}, session.context());
}

}  // namespace arete

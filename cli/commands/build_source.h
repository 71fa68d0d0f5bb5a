// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "cli/arguments/arguments.h"
#include "cli/session/session.h"
#include "io/geo/dem/dem_reader.h"
#include "io/store/amt/expected_size.h"

namespace arete {

/// Whether a reader of meshes reads the input: a single file. Not a GeoPackage: it holds layers of many
/// kinds.
bool isMesh(const DemArguments& dem);

/// Reads what `arete build` builds of terrain, and writes its warnings. A mesh (PLY, OBJ, STL, OFF, glTF,
/// 2DM) with faces is a surface; its vertices are read as points where `kind` says so, those of a mesh
/// without faces always.
///
/// @param kind terrain, surface or points; empty: the file says.
/// Errors: those of DemArguments::read() and readMesh(). usage: `kind` contradicts the file.
/// Precondition: it is no mesh with faces, unless `kind` says what its vertices are.
Result<DemRead> readSource(const DemArguments& dem, const std::string& kind, Session& session);

/// Says, before the work, about how large the file will be, as announceSize() does of a size
/// (cli/surface/build.h).
ExpectedAmtSize announceSize(const DemRead& dem, const std::string& output, bool isPacked, Session& session);

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <variant>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/geo/dem/dem_reader.h"
#include "io/query/surface/mesh_input.h"
#include "terrain/model/source_reading.h"

namespace arete {

/// What a model is built of: elevation data, or a mesh with faces.
using Source = std::variant<DemRead, MeshInput>;

/// How a file is taken.
struct SourceOptions {
  SourceReading reading = {};
  std::string kind = {};  ///< "terrain", "surface" or "points"; empty: the file says
};

/// Whether a reader of meshes reads the input: a single file. Not a GeoPackage: it holds layers of many
/// kinds.
bool isMeshSource(const std::string& path, const SourceReading& reading = {});

/// Reads what `arete build` builds of. A raster is terrain, a mesh with faces (PLY, OBJ, STL, OFF, glTF, 2DM)
/// a surface, as a GeoPackage of triangles without points is, and any other file holds points, as the
/// vertices of a mesh without faces are. A kind says otherwise: of a mesh, "terrain" and "points" take the
/// vertices as points. Warnings are in DemRead::warnings and MeshInput::file.
///
/// Errors: as readDem(), readMeshInput() and warnOfGaps(). usage: the kind contradicts the file,
/// culprit "kind"; a `reading` that a mesh does not have.
Result<Source> readSource(const std::string& path, const SourceOptions& options = {},
                          const RunContext& context = {});

}  // namespace arete

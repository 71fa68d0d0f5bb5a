// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "cli/arguments/arguments.h"
#include "cli/session/session.h"
#include "io/formats/exchange/convert.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/formats/exchange/placed_mesh.h"
#include "io/geo/bent/target.h"

namespace arete {

/// Where a command writes a mesh, and how.
struct MeshTarget {
  MeshFormat format;
  std::string path;  ///< of stdout, if the session leaves it to the mesh
};
/// Errors: usage: no format has the name; those of checkOutput().
Result<MeshTarget> meshTarget(const MeshOutput& output, const std::string& input, Session& session);

/// ConvertOptions::packing.
std::optional<MeshPacking> packingOf(const MeshOutput& output);

/// MESH, and the options of the file that a command writes it to.
void addMeshFilesTo(CLI::App& command, std::string& input, MeshOutput& output, ExistingFile& existing);

/// The options --up and --unit of every command that writes a mesh.
void addPlacingTo(CLI::App& command, MeshPlacing& placing);

/// The options --to-crs and --metric of every command that writes meshes of terrain.
struct PlaceOptions {
  CLI::Option *toCrs = nullptr, *metric = nullptr;
};
PlaceOptions addPlaceTo(CLI::App& command, PlaceTarget& place);

/// ", led into WGS 84 / UTM zone 32N (EPSG:32632): 12 vertices, 20 triangles and at most 0.4 m of error
/// more".
std::string placedText(const PlacedFigures& placed);
Json placedJsonOf(const PlacedFigures& placed);

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "cli/arguments/arguments.h"
#include "cli/session/session.h"
#include "io/formats/exchange/convert.h"
#include "io/formats/exchange/mesh_formats.h"

namespace arete {

/// Where a command writes a mesh, and how.
struct MeshTarget {
  MeshFormat format;
  std::string path;  ///< of stdout, if the session leaves it to the mesh
};
/// Errors: usage: no format has the name; those of checkOutput().
Result<MeshTarget> meshTarget(const MeshOutput& output, const std::string& input, Session& session);

/// The options --up and --unit of every command that writes a mesh.
void addPlacingTo(CLI::App& command, MeshPlacing& placing);

/// Writes the warnings of a conversion, and a line of what the format cannot hold.
void warnOf(const ConvertedMesh& converted, const std::string& input, std::string_view format,
            const Session& session);

/// The text of a mesh that was written: "part.obj: 12 triangles, 8 vertices", and the files beside it.
std::string doublesText(double movedByFloats);
std::string writtenText(const std::string& output, const ConvertedMesh& converted);

/// What a command answers of a mesh that it wrote.
Json writtenJson(const std::string& input, const std::string& output, std::string_view format,
                 const ConvertedMesh& converted);

}  // namespace arete

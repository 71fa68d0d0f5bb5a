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

}  // namespace arete

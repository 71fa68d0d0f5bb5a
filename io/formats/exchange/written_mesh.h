// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/formats/exchange/mesh_formats.h"

namespace arete {

/// A mesh as its file holds it, after rounding.
struct WrittenMesh {
  std::optional<TriangleMesh> mesh;  ///< missing: the file holds the positions that were written, to the bit
  MeshFrame frame;
  /// Upper bound on the change of the height of the surface by the rounding of the file, in the unit of the
  /// heights.
  double heightRounding = 0;
  MeshWriteReport report = {};
};

/// Writes a mesh, to a file or a pipe, and, if the format does not hold doubles, reads it back, so that later
/// measurements use the mesh of the file.
///
/// @param onGrid The vertices are at samples of a grid, to which measure() snaps them, so only heights are
/// rounded. Otherwise a sideways shift of a vertex changes the height of a slope.
///
/// Errors: those of writeMesh() and readMesh(). corrupt: the file has another number of triangles. O(size).
Result<WrittenMesh> writeAndReadBack(MeshRef mesh, const std::filesystem::path& path,
                                     const MeshWriteOptions& options, bool onGrid,
                                     const RunContext& context = {});

}  // namespace arete

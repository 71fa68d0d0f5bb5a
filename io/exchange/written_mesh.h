// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/exchange/mesh_formats.h"

namespace arete {

/// A mesh as its file holds it.
struct WrittenMesh {
  TriangleMesh mesh;
  MeshFrame frame;
  /// How much the rounding of the file may have changed the height of the surface anywhere, in the unit of
  /// the heights.
  double heightRounding = 0;
};

/// Writes a mesh and, where the format does not hold doubles, reads it back: what is measured then is what
/// the file says. `onGrid`: the vertices stand on samples of a grid, where measure() finds them again, so
/// that only heights are rounded; otherwise a vertex that moves sideways changes the height of a slope.
/// Errors: those of writeMesh() and readMesh(). O(size).
Result<WrittenMesh> writeAndReadBack(TriangleMesh mesh, const std::filesystem::path& path,
                                     const MeshWriteOptions& options, bool onGrid,
                                     const RunContext& context = {});

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "io/mesh/file.h"

namespace arete {

/// Reads the "v" and "f" lines of a Wavefront OBJ (a, a/b, a//c, a/b/c; negative indices count back from the
/// last vertex so far). Skips lines with other keywords. Understands the comments "# crs <WKT>" and
/// "# vertical_unit <unit>".
///
/// Errors: those of readMesh(). corrupt: also a file of Arete without its last line.
Result<MeshFile> readObj(const std::filesystem::path& path, const RunContext& context = {});

/// Writes coordinates with the shortest digits that give the same double. An OBJ cannot hold
/// options.triangleErrors.
///
/// Errors: those of writeMesh().
Result<MeshWriteReport> writeObj(MeshRef mesh, const std::filesystem::path& path,
                                 const MeshWriteOptions& options = {}, const RunContext& context = {});

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "io/mesh/mesh_file.h"

namespace arete {

/// Reads the "v" and "f" lines of a Wavefront OBJ (a, a/b, a//c, a/b/c; negative indices count from the last
/// vertex so far); everything else that looks like OBJ is passed over. "# crs <WKT>" and "# vertical_unit
/// <unit>" are understood. A file that Arete wrote and that has lost its last line is refused as truncated.
/// Errors as readMesh().
Result<MeshFile> readObj(const std::filesystem::path& path, const RunContext& context = {});

/// Writes coordinates with as many digits as bring the same double back. options.triangleErrors has no place
/// in an OBJ. Errors as writeMesh().
Status writeObj(const TriangleMesh& mesh, const std::filesystem::path& path,
                const MeshWriteOptions& options = {}, const RunContext& context = {});

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "io/mesh/mesh_file.h"

namespace arete {

/// Reads an STL of any program, binary or ASCII; which of the two is told by the size, since binary ones that
/// begin with "solid" exist. Corners at one place become one vertex, numbered in the order in which they
/// come; normals, colours and names are passed over. "arete origin X Y Z" at the start of a binary header is
/// added to every coordinate. Errors as readMesh(): a binary file whose count of triangles does not fit its
/// size and an ASCII one without its "endsolid" are corrupt.
Result<MeshFile> readStl(const std::filesystem::path& path, const RunContext& context = {});

/// Writes binary STL: 32-bit floats relative to an origin (io/crs/local_origin.h) that the header records.
/// STL has no place for anything else in `options`. Errors as writeMesh(); invalidData for coordinates that
/// float32 cannot hold.
Status writeStl(const TriangleMesh& mesh, const std::filesystem::path& path,
                const MeshWriteOptions& options = {}, const RunContext& context = {});

}  // namespace arete

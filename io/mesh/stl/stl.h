// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "io/mesh/file.h"

namespace arete {

/// Reads a binary or an ASCII STL. The file's size decides which of the two it is, or, where bytes follow the
/// triangles, the bytes at its start: some binary files begin with "solid". Such bytes are left out with a
/// warning. Corners at equal positions become one vertex, in the order of first occurrence.
/// Normals, colours and names are ignored. If a binary header begins with "arete origin X Y Z", the origin is
/// added to every coordinate.
///
/// Errors: those of readMesh(). corrupt: also a binary file that is too short for its triangle count or has
/// whole records behind it, and an ASCII file without "endsolid".
Result<MeshFile> readStl(const std::filesystem::path& path, const RunContext& context = {});

/// Writes binary STL: 32-bit floats relative to an origin (io/crs/local_origin.h), which the header records.
/// STL holds nothing else of `options`.
///
/// Errors: those of writeMesh(). invalidData: also coordinates beyond the range of float32.
Result<MeshWriteReport> writeStl(MeshRef mesh, const std::filesystem::path& path,
                                 const MeshWriteOptions& options = {}, const RunContext& context = {});

}  // namespace arete

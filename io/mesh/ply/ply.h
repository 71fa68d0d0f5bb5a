// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "io/mesh/file.h"

namespace arete {

/// Reads a PLY (Turk's format 1.0): ascii, binary little or big endian, with any property types and order.
/// Reads x, y, z, vertex_indices (or vertex_index) and a face property "error"; skips other elements and
/// properties. Understands "comment crs <WKT>", continued in lines "comment crs+ <more>", and "comment
/// vertical_unit <unit>". Memory is bounded by a multiple of the file's size, whatever counts the header
/// states.
///
/// Errors: those of readMesh().
Result<MeshFile> readPly(const std::filesystem::path& path, const RunContext& context = {});

/// Writes binary little-endian PLY: vertices as doubles, faces as "list uchar int vertex_indices". With
/// options.triangleErrors each face has a float "error"; with vertexQualities and vertexColors each vertex
/// has a float "quality" and uchar red, green, blue. Exact to the bit.
///
/// Errors: those of writeMesh().
Result<MeshWriteReport> writePly(MeshRef mesh, const std::filesystem::path& path,
                                 const MeshWriteOptions& options = {}, const RunContext& context = {});

}  // namespace arete

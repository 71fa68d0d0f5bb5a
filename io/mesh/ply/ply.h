// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "io/mesh/mesh_file.h"

namespace arete {

/// Reads a PLY: ascii, binary little or big endian; any property types and order; elements and properties
/// beside x, y, z and vertex_indices (or vertex_index) are skipped. "comment crs <WKT>", continued in lines
/// "comment crs+ <more>", and "comment vertical_unit <unit>" are understood, and a property "error" of the
/// faces. Errors as readMesh(). No count
/// of the header is believed before the size of the file allows it.
Result<MeshFile> readPly(const std::filesystem::path& path, const RunContext& context = {});

/// Writes binary little-endian PLY: vertices as doubles, faces as list uchar int vertex_indices, with a float
/// property "error" per face when options.triangleErrors is given, and per vertex a float "quality" and uchar
/// red, green, blue when options.vertexQualities and vertexColors are. Exact to the bit. Errors as
/// writeMesh().
Status writePly(const TriangleMesh& mesh, const std::filesystem::path& path,
                const MeshWriteOptions& options = {}, const RunContext& context = {});

}  // namespace arete

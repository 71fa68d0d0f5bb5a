// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "io/mesh/file.h"

namespace arete {

/// Reads glTF 2.0, binary (GLB) or as text, whatever the name ends in: the triangles of the default scene
/// with the transforms of their nodes, moved by the morph targets that have a weight. Primitives of one mesh
/// that share their positions share vertices; vertices without a triangle are left out. Positions of a file
/// that Arete wrote are in source coordinates, within the rounding of 32-bit floats, and all its vertices are
/// kept. In other files they are as in the file, y up. Materials, normals, cameras and animations are
/// ignored. Every offset, length and index is checked. Buffers may be in the file, as a chunk or in base 64,
/// or files beside it (io/mesh/glb/buffers.h).
///
/// Errors: those of readMesh(). unsupported: also required extensions (Draco, ...), sparse accessors, buffers
/// elsewhere, primitives other than triangle lists, positions that are not float32, skins; the message names
/// it.
Result<MeshFile> readGlb(const std::filesystem::path& path, const RunContext& context = {});
/// The same.
Result<MeshFile> readGltf(const std::filesystem::path& path, const RunContext& context = {});

/// Writes a GLB in metres, Y up, relative to a local origin. The axes are east, north and up at the origin
/// for a geographic CRS, and those of the map otherwise (terrain/model/local_frame.h). Positions and smooth
/// normals are float32, indices uint32. With options.triangleErrors each vertex has an "_ERROR": the largest
/// error of its triangles, in the unit of the heights. CRS, units and origin are in asset.extras.arete.
/// Vertices without a triangle are written too, unless the mesh has no triangle.
///
/// Errors: those of writeMesh(). usage: a CRS that GDAL does not understand. invalidData: also a latitude
/// beyond the pole, and more than 4 GiB.
Result<MeshWriteReport> writeGlb(MeshRef mesh, const std::filesystem::path& path,
                                 const MeshWriteOptions& options = {}, const RunContext& context = {});

/// Writes the same as text: JSON that has the bytes in base 64, a third more, in one file.
///
/// Errors: those of writeGlb().
Result<MeshWriteReport> writeGltf(MeshRef mesh, const std::filesystem::path& path,
                                  const MeshWriteOptions& options = {}, const RunContext& context = {});

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "io/formats/common/file.h"

namespace arete {

/// Reads glTF 2.0, binary (GLB) or as text, whatever the name ends in: the triangles of the default scene
/// where their nodes put them, moved by the morph targets that have a weight, with all attributes of their
/// vertices, the names of their nodes as objects, and their materials and pictures.
///
/// Primitives that share all accessors and stand at the same place share vertices. Vertices without a
/// triangle are left out, but not of a file that Arete wrote. Positions of a file with Arete's frame are in
/// source coordinates, within the rounding of 32-bit floats; its computed normals and errors are left out. In
/// other files positions are as in the file, y up. Strips and fans become triangles one by one; degenerate
/// ones stay.
///
/// Read are accessors of every kind, KHR_mesh_quantization, EXT_mesh_gpu_instancing, compression by Draco and
/// meshopt. Transforms of textures (KHR_texture_transform) and extensions of materials are kept as the file
/// has them (io/formats/glb/reader/materials.h). A mesh with a skin stands where its node puts it. Warnings
/// name what is left out: skins, animations, cameras, lights, points, lines, attributes that do not fit their
/// vertices. Every offset, length and index is checked. Buffers and pictures may be in the file, as a chunk
/// or in base 64, or files beside it (io/formats/glb/buffers.h); pictures beside it are not read.
///
/// Errors: those of readMesh(). unsupported: also other required extensions, which the message names, buffers
/// elsewhere, and data far larger than the file.
Result<MeshFile> readGlb(const std::filesystem::path& path, const RunContext& context = {});
/// The same.
Result<MeshFile> readGltf(const std::filesystem::path& path, const RunContext& context = {});

/// Writes a GLB.
///
/// With options.up z it is in metres, Y up, relative to a local origin. The axes are east, north and up at
/// the origin for a geographic CRS, and those of the map otherwise (io/geo/crs/local_frame.h). Positions
/// and smooth normals are float32. With options.triangleErrors each vertex has an "_ERROR": the largest error
/// of its triangles, in the unit of the heights. CRS, units and origin are in asset.extras.arete.
///
/// Otherwise positions are written as they are, in their axes and unit: float32 to the bit where it holds
/// them, else relative to the translation of the nodes, and the report names what is rounded.
///
/// Attributes are converted as io/formats/glb/writer/vertex_values.h says, materials as materials.h beside
/// it; each object becomes a node, each of its materials a primitive. Corners of different values at one
/// vertex become vertices. Pictures are embedded. Vertices without a triangle are written too, unless the
/// mesh has no triangle or several objects.
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

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "io/mesh/mesh_file.h"

namespace arete {

/// Reads a GLB (glTF 2.0 binary): the triangles of the default scene with the transforms of their nodes. Of a
/// file of ours positions come back in source coordinates, within the rounding of 32-bit floats; of any other
/// file x, -z, y are taken as x, y, height. Materials, normals, cameras, animations are passed over.
/// Errors as readMesh(); unsupported, named, for what Arete does not know: required extensions (Draco, ...),
/// sparse accessors, data outside the file, primitives that are no triangle lists, positions that are not
/// float32, skins. No offset, length or index is believed.
Result<MeshFile> readGlb(const std::filesystem::path& path, const RunContext& context = {});

/// Writes a GLB in metres, Y up, about a local origin: with a geographic CRS in the frame that is east, north
/// and up there, otherwise along the axes of the map (terrain/model/local_frame.h). Positions and smooth
/// normals float32, indices uint32, and where options has errors the largest of a vertex's triangles as
/// "_ERROR" in the unit of the heights. CRS, units and origin stand in asset.extras.arete. Vertices without a
/// triangle are written along unless there is no triangle at all. Errors as writeMesh(); usage for a CRS that
/// GDAL does not understand; invalidData for a latitude beyond the pole and for more than 4 GiB.
Status writeGlb(const TriangleMesh& mesh, const std::filesystem::path& path,
                const MeshWriteOptions& options = {}, const RunContext& context = {});

}  // namespace arete

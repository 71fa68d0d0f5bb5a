// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "io/formats/common/file.h"

namespace arete {

/// Reads a Wavefront OBJ with its libraries of materials (MTL, io/formats/obj/mtl.h). Understands the
/// comments
/// "# crs <WKT>" and "# vertical_unit <unit>".
///
/// - "v": three coordinates, then a weight, which is left out; or red, green, blue and perhaps alpha, sRGB:
///   the vertex attribute "color", floats, or bytes where all are the fractions of a byte that writeObj()
///   writes. Vertices without one are white where others have one.
/// - "f": a, a/b, a//c, a/b/c; negative indices count back from the last one so far. "vt" and "vn" are the
///   wedge attributes "texcoord" and "normal".
/// - "o": an object for every line, also of a name that was there before. "g": a group for every list of
///   names, the list being its name. "s": the triangle attribute "smoothing_group", 0 where it is off.
/// - "usemtl", "mtllib": materials.
///
/// What else there is, points, lines, curves and surfaces among it, is left out with a warning, and so are
/// faces of fewer than three corners.
///
/// Errors: those of readMesh(). corrupt: also a file of Arete without its last line.
Result<MeshFile> readObj(const std::filesystem::path& path, const RunContext& context = {});

/// Writes coordinates with the shortest digits that give the same double, and the attributes, objects,
/// groups and materials that readObj() reads. A normal of zeros is left out where other corners have one.
///
/// Materials are in an MTL beside the file: of the same name, or with a number behind it. One that is there
/// is overwritten only if its first line says that it belongs to this OBJ. Pictures are placed by
/// PicturePlacer. Both are written before the OBJ. A pipe has neither.
///
/// An OBJ cannot hold options.triangleErrors.
///
/// Errors: those of writeMesh().
Result<MeshWriteReport> writeObj(MeshRef mesh, const std::filesystem::path& path,
                                 const MeshWriteOptions& options = {}, const RunContext& context = {});

}  // namespace arete

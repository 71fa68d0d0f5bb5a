// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "io/formats/common/file.h"

namespace arete {

/// Reads a binary or an ASCII STL. The file's size decides which of the two it is, or, where bytes follow the
/// triangles, the bytes at its start: some binary files begin with "solid". Such bytes are left out with a
/// warning. Every triangle has three vertices of its own; readMesh() joins them.
///
/// Text counts as rounded to float32, unless a coordinate has more digits than that needs.
/// Each solid of an ASCII file is an object, unless there is one only and it has no name. A binary file has
/// one, which has a name where Arete wrote it: other headers say who wrote the file, not what.
///
/// Normals are left out, since the corners say them too; a warning counts those that contradict the corners,
/// if most do. The two bytes behind a triangle that the format calls unused are its colour where that is
/// clear (io/formats/stl/facet_colors.h): the triangle attribute "color", sRGB bytes; else they are the
/// triangle attribute "attribute" where one of them is not 0.
///
/// If a binary header begins with "arete origin X Y Z", the origin is added to every coordinate.
///
/// Errors: those of readMesh(). corrupt: also a binary file that is too short for its triangle count or has
/// whole records behind it, and an ASCII file without "endsolid".
Result<MeshFile> readStl(const std::filesystem::path& path, const RunContext& context = {});

/// Writes binary STL, or ASCII where a mesh has several objects, which binary STL cannot hold.
///
/// Binary: 32-bit floats. Where options.up is z, or there is options.origin, they are relative to an origin
/// (io/geo/crs/local_origin.h), which the header records; else as they are. "color" of triangles is written
/// as most programs read it, with five bits for each; "attribute" as it is. ASCII: the shortest digits that
/// give the same double; nothing else of the triangles.
///
/// Errors: those of writeMesh(). invalidData: also coordinates beyond the range of float32.
Result<MeshWriteReport> writeStl(MeshRef mesh, const std::filesystem::path& path,
                                 const MeshWriteOptions& options = {}, const RunContext& context = {});

}  // namespace arete

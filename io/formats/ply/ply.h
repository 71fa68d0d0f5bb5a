// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

#include "io/formats/common/file.h"

namespace arete {

/// Reads a PLY (Turk's format 1.0): ascii, binary little or big endian, with any property types and order of
/// elements. Faces are those of the element face (vertex_indices or vertex_index) and the triangles of the
/// element tristrips; other elements are left out with a warning.
///
/// Every other property of vertices and faces is an attribute of its own type (io/formats/ply/scheme.h says
/// which belong together). Lists of as many values in every record are attributes as well; others are left
/// out with a warning. Lists with values for each corner, "texcoord", "color" of floats and "corner_NAME",
/// are attributes of wedges. A face property "error" is MeshFile::triangleErrors if it can be. Each comment
/// "TextureFile NAME" is a material with that picture; faces say by "texnumber" which they have. Understands
/// "comment crs <WKT>", continued in lines "comment crs+ <more>", "comment vertical_unit <unit>", and the
/// notes of io/formats/ply/notes.h. Memory is bounded by a multiple of the file's size, whatever counts the
/// header states.
///
/// Errors: those of readMesh(). corrupt: also if no face has three corners.
Result<MeshFile> readPly(const std::filesystem::path& path, const RunContext& context = {});
/// The same, also of a file that has no element of faces: a point cloud.
Result<MeshFile> readPlyOfPoints(const std::filesystem::path& path, const RunContext& context = {});

/// Writes binary little-endian PLY: vertices as doubles, or as floats where these hold every
/// coordinate and the mesh is no terrain (options.up is not z), faces as "list uchar int vertex_indices".
/// With options.triangleErrors each face has a float "error"; with vertexQualities and vertexColors each
/// vertex has a float "quality" and uchar red, green, blue. Exact to the bit.
///
/// Attributes keep their types (io/formats/ply/columns.h). Materials keep the picture of their base color,
/// placed beside the file, by "comment TextureFile" and "texnumber". Objects, groups and the rest of
/// materials are lost.
///
/// Errors: those of writeMesh().
Result<MeshWriteReport> writePly(MeshRef mesh, const std::filesystem::path& path,
                                 const MeshWriteOptions& options = {}, const RunContext& context = {});

}  // namespace arete

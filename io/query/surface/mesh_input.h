// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "io/formats/common/file.h"

namespace arete {

/// The numbers by which a file knows the vertices and faces of a mesh.
struct MeshNumbers {
  std::uint32_t first = 0;              ///< what the file counts from: 1 in OBJ and 2DM
  std::vector<std::uint32_t> vertexOf;  ///< by vertex, from 0; empty: its own
  std::vector<std::uint32_t> faceOf;    ///< by triangle, from 0; empty: its own

  std::uint64_t vertex(std::uint32_t v) const {
    return std::uint64_t{first} + (vertexOf.empty() ? v : vertexOf[v]);
  }
  std::uint64_t face(std::uint32_t t) const {
    return std::uint64_t{first} + (faceOf.empty() ? t : faceOf[t]);
  }
};

/// A mesh to be examined or built from: joined where the file had to repeat vertices.
struct MeshInput {
  MeshFile file;
  std::string_view format;  ///< "PLY"
  std::uint64_t fileVertices = 0, fileFaces = 0;
  std::uint64_t joinedAtSeams = 0;  ///< vertices
  MeshNumbers numbers;
  double rounding = 0;  ///< roundingOf() the file
};

/// The most by which rounding to the numbers of its file may have moved a vertex of a mesh, in the unit of
/// the mesh: MeshFrame::rounding, or that of 32-bit floats along an axis whose coordinates were rounded to
/// such, whatever the format writes them as. O(triangles).
double roundingOf(const MeshFile& file);

/// Warns of border edges that others end inside of, or that are others but for the rounding of the file:
/// there a surface opens once vertices are removed. The warning says how to close them. O(n log n). Errors:
/// those of diagnose().
Status warnOfGaps(MeshInput& input, const RunContext& context);

/// Reads a mesh. Formats without corners, and programs that write none, repeat a
/// vertex where its attributes differ from face to face: coincident borders are joined, within an object, if
/// the file is a glTF or its vertices have attributes. What was said of the vertices is then said of corners.
/// Errors: those of readMesh() and joinSurface().
Result<MeshInput> readMeshInput(const std::string& path, const RunContext& context);

}  // namespace arete

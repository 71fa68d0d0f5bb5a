// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "cli/session/session.h"
#include "engine/base/result.h"
#include "io/mesh/file.h"

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

/// A mesh as the commands examine it: joined where the file had to repeat vertices.
struct MeshInput {
  MeshFile file;
  std::string_view format;  ///< "PLY"
  std::uint64_t fileVertices = 0, fileFaces = 0;
  std::uint64_t joinedAtSeams = 0;  ///< vertices
  MeshNumbers numbers;
};

/// Reads a mesh and writes its warnings. Formats without corners, and programs that write none, repeat a
/// vertex where its attributes differ from face to face: coincident borders are joined, within an object, if
/// the file is a glTF or its vertices have attributes. What was said of the vertices is then said of corners.
/// Errors: those of readMesh() and joinSurface().
Result<MeshInput> readMeshInput(const std::string& path, const Session& session);

}  // namespace arete

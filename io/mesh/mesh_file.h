// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "engine/parallel/run_context.h"

namespace arete {

/// How the coordinates of a file relate to source coordinates.
struct MeshFrame {
  std::string coordinates = "float64";  ///< what one is, for people: "float32 relative to the origin"
  /// Where the file's own zero is, in source coordinates; none where they are the same or nothing is said.
  std::optional<Vec3> origin = {};
  /// How far a position that was read may be from the one that was written, axis by axis, in source units:
  /// the rounding of the file's numbers. 0 where they are doubles.
  Vec3 rounding = {};
};

/// A mesh and what its file says of its frame. Polygons of the file are split into fans.
struct MeshFile {
  TriangleMesh mesh;         ///< in source coordinates wherever the file says how to come back to them
  std::string crsWkt;        ///< empty where the file does not say
  std::string verticalUnit;  ///< empty where the file does not say
  /// One per triangle, finite and not negative, or empty where the file does not say.
  std::vector<float> triangleErrors;
  MeshFrame frame;
};

/// What a written mesh file says besides the triangles.
struct MeshWriteOptions {
  std::string crsWkt = {};
  std::string verticalUnit = {};
  double verticalUnitMetres = 0;  ///< 0: what the unit's name says, or the CRS, or else 1
  /// One per triangle, when not empty. Formats without a place for it leave it out.
  std::span<const float> triangleErrors = {};
  /// One per vertex each, when not empty, with the same rule. Programs show a PLY's "quality" in colours.
  std::span<const float> vertexQualities = {};
  std::span<const std::array<std::uint8_t, 3>> vertexColors = {};
  /// Where a format of 32-bit floats puts its zero (io/crs/local_origin.h), in the coordinates of the
  /// positions; a vertex near the middle of the mesh without one. Meshes of one origin lie on each other in
  /// any program.
  std::optional<Vec3> origin = {};
  /// More comment lines, for people.
  std::vector<std::string> notes = {};
};

/// What a format has a place for.
struct MeshFormatTraits {
  bool isExact = false;  ///< doubles come back to the bit; otherwise float32 about a recorded origin
  bool holdsCrs = false;
  bool holdsVerticalUnit = false;
  bool holdsErrors = false;     ///< one per triangle
  bool holdsQualities = false;  ///< one per vertex, and colours
};

}  // namespace arete

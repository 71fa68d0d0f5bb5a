// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/result.h"
#include "engine/run_context.h"
#include "engine/triangle_mesh.h"

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
  /// Where a format of 32-bit floats puts its zero (io/local_origin.h), in the coordinates of the positions;
  /// a vertex near the middle of the mesh without one. Meshes of one origin lie on each other in any program.
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

/// One mesh file format. A new one is its own pair of files and a line in the table of mesh_file.cpp.
struct MeshFormat {
  std::string_view name;       ///< "PLY"
  std::string_view extension;  ///< lower case, with its dot: ".ply"
  Result<MeshFile> (*read)(const std::filesystem::path& path, const RunContext& context);  ///< null: cannot
  Status (*write)(const TriangleMesh& mesh, const std::filesystem::path& path,
                  const MeshWriteOptions& options,
                  const RunContext& context);  ///< null: cannot
  MeshFormatTraits holds = {};
};

/// The formats this build knows.
std::span<const MeshFormat> meshFormats();

/// The extensions of the formats that can be read or written: ".ply, .obj, .stl".
std::string readableMeshExtensions();
std::string writableMeshExtensions();

/// By the extension of the path, in either case. Errors: unsupported, naming the known formats.
Result<MeshFormat> meshFormatOf(const std::filesystem::path& path);

/// Whether readMesh() is the way to read a path: its extension says so, and a GeoPackage, which may as well
/// hold points or a raster, has surfaces.
bool isMeshFile(const std::filesystem::path& path);

/// Reads a mesh in the format its extension names. Errors, always naming the path and, where there is one,
/// the line or element: notFound, unreadable, unsupported, corrupt (truncated, hostile or nonsense),
/// interrupted. Every index of the result is valid and every coordinate finite. O(file size).
Result<MeshFile> readMesh(const std::filesystem::path& path, const RunContext& context = {});

/// Writes a mesh in the format the extension of `path` names; the file appears whole or not at all.
/// Errors: unsupported, invalidData for a mesh that does not validate(), unreadable for the disk,
/// interrupted.
Status writeMesh(const TriangleMesh& mesh, const std::filesystem::path& path,
                 const MeshWriteOptions& options = {}, const RunContext& context = {});

}  // namespace arete

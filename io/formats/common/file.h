// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "io/files/existing_file.h"
#include "surface/model/surface_mesh.h"

namespace arete {

/// How the coordinates of a file relate to source coordinates.
struct MeshFrame {
  std::string coordinates = "float64";  ///< their type, for a report: "float32 relative to the origin"
  /// The file's origin in source coordinates; missing if the file states none.
  std::optional<Vec3> origin = {};
  /// Per axis, in source units: the most by which rounding to the file's numbers may have moved a position;
  /// 0 if they are doubles.
  Vec3 rounding = {};
  /// The file's own coordinates are metres to the east, to the north and up from the origin, of which the
  /// mesh has degrees: a glTF of terrain in a geographic CRS.
  bool isLocalMetres = false;
};

/// Which axis of a mesh points up.
enum class MeshUp : std::uint8_t { unknown, y, z };

/// A mesh as read from a file, with its attributes. Polygons are split into triangles
/// (io/formats/common/polygon.h).
struct MeshFile {
  SurfaceMesh mesh;          ///< in source coordinates if the file states its frame, else as in the file
  std::string crsWkt;        ///< empty if the file has none
  std::string verticalUnit;  ///< empty if the file has none
  /// Positions are metres to the east, to the north and up from this place, which is in the coordinates of a
  /// source that the file does not have (MeshWriteOptions::metresAbout).
  std::optional<Vec3> metresAbout;
  /// One per triangle, finite and not negative; empty if the file has none.
  std::vector<float> triangleErrors;
  MeshFrame frame;
  /// z if the file has a CRS or states Arete's frame, y in another glTF, else unknown.
  MeshUp up = MeshUp::unknown;
  /// Where the pictures are that materials name by a path; empty: nowhere, as of standard input.
  std::filesystem::path folder;
  std::uint64_t joinedVertices = 0;  ///< of a soup, at reading
  /// By vertex: its number in the file, from 0, where vertices were joined; empty: its own.
  std::vector<std::uint32_t> vertexOf;
  /// What was left out or guessed, each a sentence about the file.
  Warnings warnings;
};

/// How a glTF is made small: its numbers are rounded and compressed (io/formats/glb/writer/packed.h).
struct MeshPacking {
  int positionBits = 14;  ///< 1 to 16: the longest side of the box has 2^bits - 1 steps
};

/// What to write besides the mesh. A value is left out if the format has no field for it.
struct MeshWriteOptions {
  std::string crsWkt = {};
  std::string verticalUnit = {};
  double verticalUnitMetres = 0;  ///< 0: derive it from verticalUnit, else from the CRS, else 1
  /// Empty, or one per triangle.
  std::span<const float> triangleErrors = {};
  /// Empty, or one per vertex; a PLY's "quality", which viewers show as colours.
  std::span<const float> vertexQualities = {};
  std::span<const std::array<std::uint8_t, 3>> vertexColors = {};
  /// The origin of a format of 32-bit floats (io/geo/crs/local_origin.h), in the coordinates of the
  /// positions. Default: a vertex near the middle of the mesh. Files with the same origin align in any
  /// program.
  std::optional<Vec3> origin = {};
  /// Positions are metres to the east, to the north and up from this place of the source: its x, y and
  /// height.
  std::optional<Vec3> metresAbout = {};
  /// The format by its extension ("ply"), where the file name does not say it: a pipe has none.
  std::string format = {};
  /// Further comment lines.
  std::vector<std::string> notes = {};
  /// What happens to the other layers of a GeoPackage that exists.
  ExistingFile existing = ExistingFile::keepsOtherLayers;
  /// Normals have the axes of the frame of a glTF of terrain: x east, y north, z up, in metres. Otherwise
  /// they belong to the positions, and are made anew where the frame scales axes differently.
  bool normalsAreOfFrame = false;
  /// A glTF of a mesh whose z is up is turned and has a frame; of any other its axes are those of the mesh.
  MeshUp up = MeshUp::z;
  /// MeshFile::folder.
  std::filesystem::path pictureFolder = {};
  /// Of a glTF only: what it takes to be small.
  std::optional<MeshPacking> packing = {};
};

/// What became of a mesh that was written.
struct MeshWriteReport {
  /// What the mesh has and the file does not, each a noun that follows "cannot hold": "the names of its
  /// objects".
  std::vector<std::string> lost = {};
  std::vector<std::filesystem::path> filesBeside = {};  ///< MTL, pictures
};

/// What a format can hold, and how.
struct MeshFormatTraits {
  bool isExact = false;  ///< keeps doubles bit by bit; else float32 relative to a recorded origin
  bool holdsCrs = false;
  bool holdsVerticalUnit = false;
  bool holdsErrors = false;     ///< one per triangle
  bool holdsQualities = false;  ///< one per vertex, and colours
  /// A frame of its own, whose y is up and whose unit is the metre; and texture coordinates of several sets,
  /// each with its transform.
  bool isYUp = false;
  bool hasOneTextureSet = false;        ///< the others are left out
  bool holdsTextureTransforms = false;  ///< shift and scale of a material's pictures
  bool statesPartsOnce = false;         ///< an object, group or material is one run of faces
  bool mayHoldPoints = false;           ///< reads a file without faces as points
  bool statesScalarType = false;        ///< coordinates are floats or doubles, as the header says
  bool sharesFile = false;              ///< a file of it may hold no mesh, and it is a database, not a stream
  std::uint32_t firstIndex = 0;         ///< the number of the first vertex and face in the file
};

}  // namespace arete

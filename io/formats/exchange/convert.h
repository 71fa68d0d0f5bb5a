// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "io/formats/exchange/axes.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/formats/exchange/placed_mesh.h"
#include "surface/normals/made_normals.h"

namespace arete {

struct ConvertOptions {
  std::string crs = {};     ///< any text that GDAL accepts; empty: that of the mesh
  std::string format = {};  ///< MeshWriteOptions::format
  /// What happens to the other layers of a GeoPackage that exists.
  ExistingFile existing = ExistingFile::keepsOtherLayers;
  MeshPlacing placing = {};  ///< what the file does not say of its axes and its unit
  /// Where the coordinates are led; only from a CRS, which the file has or `crs` states.
  PlaceTarget place = {};
  NormalsOptions normals = {};  ///< of the mesh as it is written
  /// Whether the coordinates of the source are floats; empty: if those of the mesh are.
  std::optional<bool> isOfFloats = {};
  std::optional<MeshPacking> packing = {};  ///< MeshWriteOptions::packing
  /// Texture coordinates count from the other side of the picture: v becomes 1 - v (flipTextures()).
  bool flipsV = false;
};

/// The result of a conversion.
struct ConvertedMesh {
  MeshFrame frame;                ///< of the file that was written
  std::string crsWkt;             ///< of the coordinates, even if the format cannot hold it
  std::string verticalUnit;       ///< likewise
  std::vector<std::string> lost;  ///< what the mesh has and the format cannot hold: "the CRS", ...
  std::vector<std::filesystem::path> filesBeside;  ///< MTL, pictures
  std::uint64_t triangles = 0, vertices = 0;       ///< of the mesh
  std::uint64_t joinedVertices = 0;                ///< MeshFile::joinedVertices
  std::vector<std::uint32_t> triangleOf;           ///< trianglesOfFile()
  std::optional<PlacedFigures> placed;             ///< with ConvertOptions::place
  double diagonal = 0;  ///< of the box of a scan; 0 of terrain, of which every digit may count
  Warnings warnings;
  /// Of a PLY with doubles of a source with floats, which so takes twice the bytes for its coordinates: how
  /// far floats would have moved one; otherwise 0.
  double movedByFloats = 0;
};

/// How far the farthest coordinate of a mesh lies from the nearest float of 32 bits. O(vertices).
double movedByFloats(const TriangleMesh& mesh);

/// Counts all texture coordinates from the other side of their pictures, for files that were written the
/// other way than their format says. Returns false for a mesh without them. O(1).
bool flipTextures(MeshAttributes& mesh);

/// Writes a mesh in the format that options.format or the extension of `path` names, with its CRS, unit and
/// errors as far as the format can hold them. A mesh is turned and scaled only where options.placing says so
/// (placeMesh()), and a mesh of which y is up where options.crs states a CRS, in which z is up.
///
/// With a place, edges are split where bending adds more than a tenth of the largest error of a triangle that
/// the file states, or of a metre where it states none (placeInTarget()).
///
/// Errors: as writeMesh(), placeMesh() and placeInTarget(). usage: attributes that splits cannot keep.
/// usage, culprit `normals`: normals are to be made of a mesh in degrees; culprit `flipV`: no texture
/// coordinates; with the text as culprit: options.crs is not a CRS; culprit `unit`: options.crs states the
/// unit. O(size), O(n log n) to a format that rounds.
Result<ConvertedMesh> convertMesh(MeshFile mesh, const std::filesystem::path& path,
                                  const ConvertOptions& options = {}, const RunContext& context = {});

}  // namespace arete

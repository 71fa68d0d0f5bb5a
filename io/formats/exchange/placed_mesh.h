// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/geo/bent/target.h"
#include "terrain/model/georeference.h"

namespace arete {

/// What became of a mesh on its way into a target, as a report states it.
struct PlacedFigures {
  std::string target;  ///< "WGS 84 / UTM zone 32N (EPSG:32632)", "metres"
  bool isMetric = false;
  std::string unit;  ///< of the errors below, which is the source's heights; empty: not known
  std::uint64_t addedVertices = 0, addedTriangles = 0;  ///< by splits of edges
  double added = 0;         ///< the most that bending adds to the error of a triangle, in the source's unit
  double largestError = 0;  ///< with it: the largest error of a triangle, in that unit
};

/// A mesh in a target, and what its file says of it.
struct PlacedMesh {
  TriangleMesh mesh;                 ///< as it is handed to the writer
  std::vector<float> errors;         ///< by triangle, in the unit of `mesh`; rounded outwards
  std::vector<double> sourceErrors;  ///< the same in the unit of the source
  std::string crsWkt, verticalUnit;
  double verticalUnitMetres = 0;
  std::optional<Vec3> origin, metresAbout;
  std::string note;  ///< a comment that says what the coordinates are
  /// In a glTF, which has a frame of its own, `mesh` is in the source: its positions lead into metres by this
  /// CRS about the origin.
  bool isFramedByWriter = false;
  PlacedFigures figures;
  Warnings warnings;

  /// Overwrites what the options say of coordinates and errors, and adds the note.
  void describe(MeshWriteOptions& options) const;
};

struct PlacingOptions {
  double tolerance = 0;             ///< of the mesh, in the source's unit of heights
  std::uint64_t samples = 0;        ///< BendOptions::samples
  std::optional<Vec3> origin = {};  ///< MeshWriteOptions::origin, in source coordinates
};

/// Whether a file of that format can be written in a target. Errors: usage, naming the field: a metric
/// GeoPackage, whose layers are maps.
Status checkPlacing(const PlaceTarget& target, const MeshFormat& format);

/// Leads a mesh of terrain into a target for a format: bendMesh() (io/geo/bent/bend.h), where nothing below a
/// millimetre is split for. Errors: as PlaceMap::of(), bendMesh() and checkPlacing().
Result<PlacedMesh> placeInTarget(const TriangleMesh& mesh, std::span<const float> errors,
                                 const Georeference& source, const PlaceTarget& target,
                                 const MeshFormat& format, const PlacingOptions& options,
                                 const RunContext& context = {});

/// The warning that a file for programs that know no CRS (PLY, OBJ, OFF, STL) has degrees for x and y and
/// lengths for heights; nothing for other formats and CRSs. It names the fields of the remedies.
std::optional<Warning> warningOfDegrees(const MeshFormat& format, const std::string& crsWkt,
                                        const std::string& verticalUnit);

}  // namespace arete

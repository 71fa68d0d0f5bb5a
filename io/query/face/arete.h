// SPDX-License-Identifier: GPL-3.0-or-later
//
// The face of the library, installed as <arete/arete.h>: open or build a model, cut it, ask it for heights
// and lines of sight, write what comes out. Whatever it does not do the other headers do
// (docs/topics/library.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "io/formats/common/file.h"
#include "io/geo/bent/target.h"
#include "io/query/extract/model.h"
#include "io/query/request/cut_request.h"
#include "io/query/request/wholes.h"
#include "surface/model/surface_mesh.h"
#include "terrain/sight/paths.h"

namespace arete {

/// How a model is built from a file.
struct ModelOptions {
  bool isFidelity = false;    ///< of terrain: far fewer triangles, thinner ones (`--shape fidelity`)
  bool isDisplaced = false;   ///< of a surface: coarse cuts are drawn nearer to the source
  bool keepsBorders = false;  ///< of a surface: border vertices stay in every cut
  bool isDem = false;         ///< takes a file of a mesh for the points of a terrain
};

/// A mesh that a model was cut to, with what it needs to be written.
struct Tin {
  SurfaceMesh mesh;           ///< in the coordinates of the source; of a surface with its attributes
  std::vector<float> errors;  ///< by triangle: no sample that it stands for is farther; empty: not known
  double error = 0;  ///< nothing of the source is farther: vertically of terrain, in space of a surface
  /// False: a budget or a deadline ended the refinement, or rounding left more than was asked for.
  bool isComplete = true;
  std::optional<double> pixels = {};  ///< with a camera: the worst error in its picture
  std::string crsWkt, verticalUnit;   ///< of the source; empty: not known
  double verticalUnitMetres = 0;      ///< 0: not known
  std::optional<Vec3> origin = {};    ///< for formats of 32-bit floats: one for all cuts of a model
  MeshUp up = MeshUp::z;
  std::string note = {};                     ///< what it is, as a comment in files
  std::vector<std::uint32_t> vertexOf = {};  ///< of a surface, by vertex: the source's
  /// Of a surface whose attributes are bounded: what they are off by at most, each within `error`.
  std::vector<AttributeNumber> attributeErrors = {};
  Warnings warnings = {};
};

/// Opens an .amt file: terrain or a surface, a path that GDAL reads too. Errors: as openModel().
Result<Model> open(const std::string& path, const RunContext& context = {});

/// Builds a model from a DEM, points or a mesh, as `arete build` does it. Warnings are not returned:
/// readDem() and buildSurfaceModel() have them. Errors: as readDem(), chooseFixedVertices(), build(),
/// readMeshInput() and buildSurfaceModel().
Result<Model> build(const std::string& path, const ModelOptions& options = {},
                    const RunContext& context = {});

/// Cuts a model: cut(model, {.maxError = 5}). Of terrain CutRequest::planRegion is taken, or else the text
/// CutRequest::region is read. Errors and lengths are in the unit of the source; a share of the
/// relief or the diagonal is 0.01 * wholesOf(model).length.
///
/// Where a fit moved heights of terrain, `error` is what the fit promises; measure() (terrain/measure) says
/// more. Errors: usage, naming the field: a request without an error, a budget, a camera or a deadline; those
/// of takeTin() and takeSurface(), of readRegionArgument() for CutRequest::region of terrain.
Result<Tin> cut(const Model& model, const CutRequest& request, const RunContext& context = {});
Result<Tin> cut(const TerrainModel& model, const CutRequest& request, const RunContext& context = {});
Result<Tin> cut(const SurfaceModel& model, const CutRequest& request, const RunContext& context = {});

/// O(1) of a surface; O(samples) of terrain, of which all must have been read.
Wholes wholesOf(const Model& model);

/// The height of terrain at a place in the coordinates of the source, at full resolution; nothing outside
/// the terrain. Many places at once: GroundHeights. Errors: unsupported: the model is of a surface.
Result<std::optional<double>> heightAt(const Model& model, double x, double y);

/// Whether a target is seen from an observer; both are x, y and a height above the ground in the unit of
/// heights. Over the ellipsoid with the usual refraction where the CRS has one, else over a plane. Many lines
/// at once: answerPaths(). Errors: unsupported: the model is of a surface; usage, culprit "observer" or
/// "target": it is outside the terrain; as answerPath().
Result<SightPathAnswer> lineOfSight(const Model& model, const Vec3& observer, const Vec3& target,
                                    const RunContext& context = {});

/// Writes a mesh in the format that the extension of the path names, with its CRS, unit, errors and origin as
/// far as the format holds them. Returns what it cannot hold. Errors: as writeMesh().
Result<MeshWriteReport> write(const Tin& tin, const std::string& path, const RunContext& context = {});
/// The same in another CRS (`{.crs = "utm"}`) or in metres (`{.isMetric = true}`), of terrain. Edges are
/// split where bending adds more than a tenth of the largest error, and the errors in the file count it.
/// Errors: also as placeInTarget() (io/formats/exchange/placed_mesh.h).
Result<MeshWriteReport> write(const Tin& tin, const std::string& path, const PlaceTarget& place,
                              const RunContext& context = {});
/// The same as a small glTF: numbers are rounded to a grid, which moves a point by up to half of a step.
Result<MeshWriteReport> write(const Tin& tin, const std::string& path, const MeshPacking& packing,
                              const RunContext& context = {});
/// Writes a model as an .amt file. Errors: as writeAmt() and writeSurfaceAmt().
Status write(const Model& model, const std::string& path, const RunContext& context = {});

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// No logic of its own: each function calls the room that does the work.
#include "io/query/face/arete.h"

#include <fmt/format.h>

#include <memory>
#include <utility>
#include <variant>

#include "engine/base/caught_failure.h"
#include "io/formats/exchange/export_tin.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/formats/exchange/placed_mesh.h"
#include "io/geo/bent/place_map.h"
#include "io/geo/crs/ellipsoid_earth.h"
#include "io/geo/crs/longitude_turns.h"
#include "io/geo/crs/position_argument.h"
#include "io/geo/dem/dem_reader.h"
#include "io/query/extract/region_argument.h"
#include "io/query/extract/tin.h"
#include "io/query/source/build_terrain.h"
#include "io/query/surface/build_model.h"
#include "io/query/surface/take_surface.h"
#include "io/query/surface/write_model.h"
#include "io/store/amt/file.h"
#include "terrain/locate/ground_height.h"
#include "terrain/model/plan_region.h"

namespace arete {
namespace {

Error isOfSurface() {
  return {ErrorCode::unsupported, "is a question to terrain, and the model is of a surface", "model"};
}

/// Without any of these a cut is the source itself, which is rarely meant.
Status checkEnds(const CutRequest& request) {
  if (request.maxError || request.maxTriangles || request.hasCamera() || request.deadlineMilliseconds)
    return {};
  return failure(ErrorCode::usage, "or maxTriangles, a camera or a deadline is required", "maxError");
}

Result<std::optional<Region>> regionIn(const TerrainModel& model, const CutRequest& request,
                                       Warnings& warnings, const RunContext& context) {
  if (request.planRegion) return std::optional<Region>(*request.planRegion);
  if (request.region.empty()) return std::optional<Region>();
  ARETE_TRY(RegionArgument read, readRegionArgument({request.region, request.distance, request.regionCrs},
                                                    model.georeference, LongitudeTurns(model), context));
  warnings = std::move(read.warnings);
  Region region = planRegion(std::move(read.shape), model);
  if (region.isEmpty() || !meetsDomain(region, model.mt))
    return failure(ErrorCode::usage, "does not meet the terrain", "region");
  return std::optional<Region>(std::move(region));
}

Result<Tin> cutTerrain(const TerrainModel& model, CutRequest request, const RunContext& context) {
  Tin tin;
  if (request.camera && !request.pixelError && !request.maxTriangles) request.pixelError = 1;
  ARETE_TRY(const auto region, regionIn(model, request, tin.warnings, context));
  ExtractedTin found;
  ARETE_TRY(TinExport taken, takeTin(model, request, region, 0, std::nullopt, found, context));
  tin.mesh = SurfaceMesh(std::move(taken.mesh));
  tin.errors = std::move(taken.errors);
  tin.error = found.storedError;
  tin.isComplete = found.isComplete;
  tin.pixels = found.pixels;
  tin.crsWkt = model.georeference.crsWkt;
  tin.verticalUnit = model.georeference.verticalUnit;
  tin.verticalUnitMetres = model.georeference.verticalUnitMetres;
  tin.origin = taken.origin;
  tin.note = fmt::format(
      "arete: TIN of {}, vertical error at most {}{}{}", model.source.substr(model.source.rfind('/') + 1),
      tin.error, tin.verticalUnit.empty() ? "" : " " + tin.verticalUnit, found.fit ? ", heights fitted" : "");
  return tin;
}

Result<Tin> cutSurface(const SurfaceModel& model, const CutRequest& request, const RunContext& context) {
  ARETE_TRY(const auto dropped, componentsToDrop(model, request));
  ARETE_TRY(TakenSurface taken, takeSurface(model, request, dropped ? &*dropped : nullptr, context));
  Tin tin;
  tin.mesh = std::move(taken.front.mesh);
  tin.vertexOf = std::move(taken.front.vertexOf);
  // After a fit only the error of the whole mesh is known.
  if (!taken.fit) tin.errors = std::move(taken.front.errors);
  tin.error = taken.error;
  tin.isComplete = taken.whole.isComplete && taken.leftByRounding == 0;
  tin.pixels = taken.pixels;
  tin.attributeErrors = std::move(taken.attributeErrors);
  tin.crsWkt = model.crsWkt;
  tin.verticalUnit = model.verticalUnit;
  tin.up = model.up == "y" ? MeshUp::y : model.up == "z" ? MeshUp::z : MeshUp::unknown;
  if (taken.leftByRounding > 0)
    tin.warnings.push_back(
        {WarningCode::bound,
         fmt::format(
             "the tolerance is not kept everywhere: rounding (positionBits) has moved vertices of the "
             "source by up to {:.6g}, and with it no error is below {:.6g}",
             model.positionError, taken.leftByRounding)});
  return tin;
}

/// An end of a line of sight, in plan coordinates and from the DEM's zero.
Result<std::pair<Vec2, double>> endOfSight(const TerrainModel& model, const GroundHeights& heights,
                                           const Vec3& place, const char* culprit) {
  const Vec2 xy = LongitudeTurns(model)({place.x, place.y});
  const auto height = demHeight({xy, place.z, HeightKind::aboveGround}, heights);
  if (!height) return failure(ErrorCode::usage, height.error().message, culprit);
  return std::pair{sightPlan(model, xy), *height};
}

}  // namespace

Result<Model> open(const std::string& path, const RunContext& context) {
  return openModel(path, {}, context);
}

Result<Model> build(const std::string& path, const ModelOptions& options, const RunContext& context) try {
  if (!options.isDem && isMeshFile(path)) {
    ARETE_TRY(MeshInput input, readMeshInput(path, context));
    if (input.file.mesh.triangles.empty())
      return failure(ErrorCode::invalidData, "has no faces: they make a surface", path);
    ARETE_TRY(BuiltSurface built, buildSurfaceModel(std::move(input), path,
                                                    {.build = {.keepsBorders = options.keepsBorders},
                                                     .isDisplaced = options.isDisplaced},
                                                    context));
    return Model(std::move(built.model));
  }
  ARETE_TRY(const DemRead dem, readDem(path, {}, context));
  BuildOptions terrain;
  if (options.isFidelity) terrain.shape = HoleShape::dataDependent;
  ARETE_TRY(TerrainModel model, buildTerrain(dem.heightfield, path, terrain, context));
  return Model(std::move(model));
} catch (...) {
  return caughtFailure(path);
}

Result<Tin> cut(const Model& model, const CutRequest& request, const RunContext& context) {
  return std::visit([&](const auto& one) { return cut(one, request, context); }, model);
}

Result<Tin> cut(const TerrainModel& model, const CutRequest& request, const RunContext& context) try {
  ARETE_CHECK(checkEnds(request));
  return cutTerrain(model, request, context);
} catch (...) {
  return caughtFailure();
}

Result<Tin> cut(const SurfaceModel& model, const CutRequest& request, const RunContext& context) try {
  ARETE_CHECK(checkEnds(request));
  return cutSurface(model, request, context);
} catch (...) {
  return caughtFailure();
}

Wholes wholesOf(const Model& model) {
  return std::visit([](const auto& one) { return wholesOf(one); }, model);
}

Result<std::optional<double>> heightAt(const Model& model, double x, double y) try {
  const auto* const terrain = std::get_if<TerrainModel>(&model);
  if (!terrain) return tl::unexpected(isOfSurface());
  const auto found = GroundHeights(*terrain).at(LongitudeTurns(*terrain)({x, y}));
  return found ? std::optional(found->height) : std::nullopt;
} catch (...) {
  return caughtFailure();
}

Result<SightPathAnswer> lineOfSight(const Model& model, const Vec3& observer, const Vec3& target,
                                    const RunContext& context) try {
  const auto* const terrain = std::get_if<TerrainModel>(&model);
  if (!terrain) return tl::unexpected(isOfSurface());
  const GroundHeights heights(*terrain);
  ARETE_TRY(const auto from, endOfSight(*terrain, heights, observer, "observer"));
  ARETE_TRY(const auto to, endOfSight(*terrain, heights, target, "target"));
  std::unique_ptr<SightEarth> earth = makePlaneEarth(*terrain);
  if (isOnEllipsoid(terrain->georeference)) {
    ARETE_TRY(auto ellipsoid, makeEllipsoidEarth(*terrain, kUsualRefraction));
    earth = std::move(ellipsoid);
  }
  ARETE_TRY(const auto engine, makeSightEngine(methodFor(1, 0, *terrain), *terrain, {}, context));
  const Profiles profiles(*terrain, nullptr);
  return answerPath({from.first, to.first, from.second, to.second}, *earth, *engine, profiles, {});
} catch (...) {
  return caughtFailure();
}

Result<MeshWriteReport> write(const Tin& tin, const std::string& path, const PlaceTarget& place,
                              const RunContext& context) {
  if (!place.isStated()) return write(tin, path, context);
  if (tin.up != MeshUp::z)
    return failure(ErrorCode::usage, "is for terrain, and this is a surface",
                   place.isMetric ? "metric" : "toCrs " + place.crs);
  ARETE_TRY(const MeshFormat format, meshFormatOf(path));
  ARETE_TRY(const Georeference georeference,
            georeferenceOf(tin.crsWkt, tin.verticalUnit, tin.verticalUnitMetres));
  ARETE_TRY(PlacedMesh placed, placeInTarget(tin.mesh, tin.errors, georeference, place, format,
                                             {.tolerance = tin.error, .origin = tin.origin}, context));
  MeshWriteOptions options;
  options.triangleErrors = placed.errors;
  if (!tin.note.empty()) options.notes = {tin.note};
  placed.describe(options);
  if (tin.errors.empty()) options.triangleErrors = {};
  return writeMesh(placed.mesh, path, options, context);
}

namespace {

MeshWriteOptions writeOptionsOf(const Tin& tin, const std::string& path) {
  MeshWriteOptions options;
  options.crsWkt = tin.crsWkt;
  options.verticalUnit = tin.verticalUnit;
  options.verticalUnitMetres = tin.verticalUnitMetres;
  // A glTF has errors in a frame of its own, whose z is up.
  const Result<MeshFormat> format = meshFormatOf(path);
  if (!format || !format->holds.isYUp || tin.up == MeshUp::z) options.triangleErrors = tin.errors;
  options.origin = tin.origin;
  options.up = tin.up;
  if (!tin.note.empty()) options.notes = {tin.note};
  return options;
}

}  // namespace

Result<MeshWriteReport> write(const Tin& tin, const std::string& path, const RunContext& context) {
  return writeMesh(tin.mesh, path, writeOptionsOf(tin, path), context);
}

Result<MeshWriteReport> write(const Tin& tin, const std::string& path, const MeshPacking& packing,
                              const RunContext& context) {
  MeshWriteOptions options = writeOptionsOf(tin, path);
  options.packing = packing;
  return writeMesh(tin.mesh, path, options, context);
}

Status write(const Model& model, const std::string& path, const RunContext& context) {
  if (const auto* const terrain = std::get_if<TerrainModel>(&model)) return writeAmt(path, *terrain, context);
  return writeSurfaceModel(path, std::get<SurfaceModel>(model), context);
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whatever the source, it is read as a file is: an array of heights is a raster in memory, points go where
// points of a file go.
#include "python/bindings/build.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <variant>

#include "engine/base/counted.h"
#include "io/files/text/stated_size.h"
#include "io/formats/exchange/axes.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/geo/dem/dem_reader.h"
#include "io/geo/dem/point_reader.h"
#include "io/geo/table/plan_point_reader.h"
#include "python/bindings/array_file.h"
#include "python/bindings/arrays.h"
#include "python/bindings/calls.h"
#include "python/bindings/terrain.h"
#include "terrain/builder/build.h"
#include "terrain/features/fixed_vertices.h"
#include "terrain/model/relief.h"

namespace arete::python {
namespace {

namespace py = pybind11;
using TerrainPtr = std::shared_ptr<Terrain>;

template <class Heightfield>
Result<FixedVertexOptions> fixedOptionsOf(const BuildRequest& request, const Heightfield& field,
                                          Warnings& warnings, const RunContext& context) {
  FixedVertexOptions fixed;
  if (request.features) fixed.features->count = *request.features;
  if (!request.featurePersistence.empty()) {
    ARETE_TRY(const StatedSize stated, parseStatedSize(request.featurePersistence, "featurePersistence"));
    fixed.features->count = std::numeric_limits<std::size_t>::max();
    fixed.features->minimumPersistence = stated.of(stated.isShare ? reliefOf(field.heights) : 0);
  }
  if (request.features == std::size_t{0}) fixed.features.reset();
  fixed.creaseAngleDegrees = request.creaseAngle;
  fixed.given = request.fixed;
  if (!request.fixedFile.empty()) {
    ARETE_TRY(PlanPoints points, readPlanPoints(request.fixedFile, field.georeference.crsWkt, context));
    for (const Warning& warning : points.warnings) warnings.push_back(warning);
    fixed.given = std::move(points.positions);
  }
  return fixed;
}

Result<BuildOptions> buildOptionsOf(const BuildRequest& request) {
  BuildOptions options;
  if (request.shape == "fidelity")
    options.shape = HoleShape::dataDependent;
  else if (request.shape != "delaunay")
    return failure(ErrorCode::usage, "is neither delaunay nor fidelity", "shape=" + request.shape);
  if (request.minimumAspect && options.shape != HoleShape::dataDependent)
    return failure(ErrorCode::usage, "requires shape=\"fidelity\"", "minimumAspect");
  options.minimumAspect = request.minimumAspect.value_or(options.minimumAspect);
  options.thresholdRatio = request.ratio;
  options.maxDegree = request.maxDegree;
  options.rimTolerance = request.rimTolerance;
  return options;
}

/// As `arete build` does it.
Result<TerrainModel> buildFrom(DemRead dem, const BuildRequest& request, Warnings& warnings,
                               const RunContext& context) {
  ARETE_TRY(BuildOptions options, buildOptionsOf(request));
  return std::visit(
      [&](auto& field) -> Result<TerrainModel> {
        if (!request.source.empty()) field.source = request.source;
        ARETE_TRY(const FixedVertexOptions fixedOptions, fixedOptionsOf(request, field, warnings, context));
        ARETE_TRY(const FixedVertices fixed, chooseFixedVertices(field, fixedOptions, context));
        const std::size_t given = fixedOptions.given.size();
        if (given > 0 && fixed.givenOutside == given)
          return failure(ErrorCode::usage,
                         fmt::format("none of {} lies on the DEM's data", counted(given, "point", "points")),
                         "fixed");
        if (fixed.givenOutside > 0)
          warnings.push_back(
              {WarningCode::position,
               fmt::format("fixed: {} of {} {} outside the DEM's data and {} left out", fixed.givenOutside,
                           counted(given, "point", "points"), fixed.givenOutside == 1 ? "lies" : "lie",
                           fixed.givenOutside == 1 ? "is" : "are")});
        options.fixedVertices = fixed.vertices;
        Result<TerrainModel> model = build(field, options, context);
        if (model) model->reading = request.reading;
        return model;
      },
      dem.heightfield);
}

/// The error of a build from an array, whose file in memory the caller never saw.
Error ofArray(Error error, const std::string& path) {
  if (error.culprit == path) error.culprit = "array";
  for (std::size_t at = error.message.find(path); at != std::string::npos; at = error.message.find(path))
    error.message.replace(at, path.size(), "the array");
  return error;
}

/// An error about a text that an argument states names the argument.
Error ofReading(Error error, const SourceReading& reading) {
  if (!reading.crs.empty() && error.culprit == reading.crs) error.culprit = "crs=" + reading.crs;
  if (!reading.verticalUnit.empty() && error.culprit == reading.verticalUnit)
    error.culprit = "vertical_unit=" + reading.verticalUnit;
  return error;
}

/// Builds from what `read` gives.
/// @param file  of an array, its name; empty: there is none
/// @param isArgument  whether bad heights are a wrong argument: of arrays, and of files that are stated
/// together and do not fit
template <class Read>
TerrainPtr buildOf(const BuildRequest& request, const std::string& file, bool isArgument, const Read& read,
                   const py::object& progress) {
  Warnings warnings;
  TerrainModel model = callOn(isArgument, progress, [&](const RunContext& context) -> Result<TerrainModel> {
    const auto named = [&](const Error& error) {
      return tl::unexpected(ofReading(file.empty() ? error : ofArray(error, file), request.reading));
    };
    Result<DemRead> dem = read(context);
    if (!dem) return named(dem.error());
    warnings = std::move(dem->warnings);
    Result<TerrainModel> built = buildFrom(std::move(*dem), request, warnings, context);
    if (!built) return named(built.error());
    return built;
  });
  if (!file.empty())
    for (Warning& warning : warnings)
      warning.sentence = ofArray({ErrorCode::internal, warning.sentence, {}}, file).message;
  // An array without a transform has no position, and its caller knows it.
  if (!request.hasPlace)
    std::erase_if(warnings, [](const Warning& w) { return w.code == WarningCode::position; });
  warn(warnings);
  return std::make_shared<Terrain>(std::move(model));
}

bool isMeshWithFaces(const std::string& path) {
  const Result<MeshFormat> format = meshFormatOf(path);
  return format && format->read && !format->holds.sharesFile;
}

TerrainPtr buildFile(const std::string& path, const BuildRequest& request, const py::object& progress) {
  return buildOf(
      request, "", !request.reading.otherFiles.empty(),
      [&](const RunContext& context) -> Result<DemRead> {
        // Its vertices alone are another thing.
        if (isMeshWithFaces(path))
          return failure(
              ErrorCode::unsupported,
              "is a mesh: arete.build_surface() builds from it, arete.build_points() from its vertices",
              path);
        return readDem(path, request.reading, context);
      },
      progress);
}

TerrainPtr buildArray(const Doubles& heights, const std::optional<std::array<double, 6>>& transform,
                      const std::string& crs, const std::string& unit, const BuildRequest& request,
                      const py::object& progress) {
  const HeightArray array{heights.data(),
                          static_cast<std::size_t>(heights.shape(0)),
                          static_cast<std::size_t>(heights.shape(1)),
                          transform,
                          crs,
                          unit};
  const Result<ArrayFile> file = ArrayFile::write(array);
  if (!file) raise(file.error());
  return buildOf(
      request, file->path(), true,
      [&](const RunContext& context) { return readDem(file->path(), request.reading, context); }, progress);
}

PointReadOptions pointOptionsOf(const SourceReading& reading) {
  PointReadOptions options{.crs = reading.crs,
                           .nodata = reading.nodata,
                           .verticalUnit = reading.verticalUnit,
                           .isDepth = reading.isDepth};
  if (const auto rule = samePlaceNamed(reading.samePlace)) options.samePlace = *rule;
  return options;
}

Result<DemRead> readPointsOf(std::span<const Vec3> points, const std::string& crsWkt,
                             const std::string& source, const PointReadOptions& options) {
  ARETE_TRY(PointRead read, pointsFrom(points, crsWkt, source, options));
  return DemRead{std::move(read.heightfield), std::move(read.warnings)};
}

TerrainPtr buildPoints(const Doubles& rows, const BuildRequest& request, const py::object& progress) {
  std::vector<Vec3> points;
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) {
    const double* const p = rows.data() + 3 * i;
    points.push_back({p[0], p[1], p[2]});
  }
  return buildOf(
      request, "", true,
      [&](const RunContext&) { return readPointsOf(points, "", "points", pointOptionsOf(request.reading)); },
      progress);
}

/// The points of a file, or the vertices of a mesh.
TerrainPtr buildPointFile(const std::string& path, const BuildRequest& request, const py::object& progress) {
  return buildOf(
      request, "", false,
      [&](const RunContext& context) -> Result<DemRead> {
        if (!isMeshWithFaces(path)) return readDem(path, request.reading, context);
        ARETE_TRY(MeshFile mesh, readMeshOrPoints(path, context));
        if (mesh.up == MeshUp::y) ARETE_CHECK(placeMesh(mesh, {.up = MeshUp::y}, MeshUp::z));
        PointReadOptions options = pointOptionsOf(request.reading);
        if (options.verticalUnit.empty()) options.verticalUnit = mesh.verticalUnit;
        return readPointsOf(mesh.mesh.positions, mesh.crsWkt, path, options);
      },
      progress);
}

}  // namespace

void defineBuild(py::module_& module) {
  py::class_<BuildRequest>(module, "BuildRequest")
      .def(py::init<>())
      .def_readwrite("shape", &BuildRequest::shape)
      .def_readwrite("ratio", &BuildRequest::ratio)
      .def_readwrite("min_aspect", &BuildRequest::minimumAspect)
      .def_readwrite("crease_angle", &BuildRequest::creaseAngle)
      .def_readwrite("max_degree", &BuildRequest::maxDegree)
      .def_readwrite("rim_tolerance", &BuildRequest::rimTolerance)
      .def_readwrite("features", &BuildRequest::features)
      .def_readwrite("feature_persistence", &BuildRequest::featurePersistence)
      .def_readwrite("fixed_file", &BuildRequest::fixedFile)
      .def_readwrite("source", &BuildRequest::source)
      .def_readwrite("has_place", &BuildRequest::hasPlace)
      .def("set_fixed",
           [](BuildRequest& request, const Doubles& places) {
             for (py::ssize_t i = 0; i < places.shape(0); ++i)
               request.fixed.push_back({places.data()[2 * i], places.data()[2 * i + 1]});
           })
      .def("set_reading",
           [](BuildRequest& request, std::optional<std::uint32_t> band, const std::string& layer,
              const std::string& zField, const std::string& samePlace, const std::string& crs,
              std::optional<double> nodata, const std::string& verticalUnit, std::optional<bool> isDepth,
              std::vector<std::string> others) {
             request.reading = {.band = band,
                                .layer = layer,
                                .zField = zField,
                                .samePlace = samePlace,
                                .crs = crs,
                                .nodata = nodata,
                                .verticalUnit = verticalUnit,
                                .isDepth = isDepth,
                                .otherFiles = std::move(others)};
           });
  module.def("build_file", &buildFile);
  module.def("build_array", &buildArray);
  module.def("build_points", &buildPoints);
  module.def("build_point_file", &buildPointFile);
}

}  // namespace arete::python

// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/bindings/terrain.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <variant>

#include "io/formats/exchange/mesh_formats.h"
#include "io/geo/crs/longitude_turns.h"
#include "io/geo/crs/position_argument.h"
#include "io/geo/dem/dem_reader.h"
#include "io/query/extract/region_argument.h"
#include "io/store/amt/file.h"
#include "python/bindings/array_file.h"
#include "python/bindings/arrays.h"
#include "python/bindings/calls.h"
#include "python/bindings/sight.h"
#include "python/bindings/tin.h"
#include "terrain/builder/build.h"
#include "terrain/features/fixed_vertices.h"
#include "terrain/model/cell_grid.h"
#include "terrain/model/plan_box.h"
#include "terrain/model/plan_region.h"

namespace arete::python {
namespace {

namespace py = pybind11;
using Box = std::array<double, 4>;
using Polygons = std::vector<std::vector<std::vector<std::array<double, 2>>>>;
/// A box, or polygons of an outer ring and holes.
using AskedRegion = std::variant<Box, Polygons>;

using TerrainPtr = std::shared_ptr<Terrain>;

struct BuildRequest {
  std::string shape = "delaunay";
  std::size_t features = 64;
};

/// As `arete build` does it.
Result<TerrainModel> buildFrom(DemRead dem, const std::string& source, const BuildRequest& request,
                               const RunContext& context) {
  BuildOptions options;
  if (request.shape == "fidelity")
    options.shape = HoleShape::dataDependent;
  else if (request.shape != "delaunay")
    return failure(ErrorCode::usage, "is neither delaunay nor fidelity", "shape=" + request.shape);
  FixedVertexOptions fixedOptions;
  fixedOptions.features->count = request.features;
  return std::visit(
      [&](auto& field) -> Result<TerrainModel> {
        if (!source.empty()) field.source = source;
        ARETE_TRY(const FixedVertices fixed, chooseFixedVertices(field, fixedOptions, context));
        options.fixedVertices = fixed.vertices;
        return build(field, options, context);
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

/// @param hasPlace false: warnings about its position are left out
TerrainPtr buildFile(const std::string& path, const BuildRequest& request, const std::string& source,
                     bool hasPlace, const py::object& progress) {
  Warnings warnings;
  TerrainModel model = call(progress, [&](const RunContext& context) -> Result<TerrainModel> {
    // Its vertices alone are another thing.
    if (const Result<MeshFormat> format = meshFormatOf(path);
        format && format->read && !format->holds.sharesFile)
      return failure(ErrorCode::unsupported, "is a mesh: arete.build_surface() builds from it", path);
    Result<DemRead> dem = readDem(path, {}, context);
    if (!dem) return tl::unexpected(source.empty() ? dem.error() : ofArray(dem.error(), path));
    warnings = std::move(dem->warnings);
    Result<TerrainModel> built = buildFrom(std::move(*dem), source, request, context);
    if (!built && !source.empty()) return tl::unexpected(ofArray(built.error(), path));
    return built;
  });
  if (!source.empty())
    for (Warning& warning : warnings)
      warning.sentence = ofArray({ErrorCode::internal, warning.sentence, {}}, path).message;
  // An array without a transform has no position, and its caller knows it.
  if (!hasPlace) std::erase_if(warnings, [](const Warning& w) { return w.code == WarningCode::position; });
  warn(warnings);
  return std::make_shared<Terrain>(std::move(model));
}

TerrainPtr buildArray(const Doubles& heights, const std::optional<std::array<double, 6>>& transform,
                      const std::string& crs, const BuildRequest& request, const py::object& progress) {
  const HeightArray array{heights.data(), static_cast<std::size_t>(heights.shape(0)),
                          static_cast<std::size_t>(heights.shape(1)), transform, crs};
  const Result<ArrayFile> file = ArrayFile::write(array);
  if (!file) raise(file.error());
  return buildFile(file->path(), request, "array", transform.has_value(), progress);
}

/// How a camera comes from Python: its place, and how high it is of what ("agl", "msl", "ell").
struct CameraNumbers {
  double x = 0, y = 0, height = 0;
  std::string kind;
  double azimuth = 0, pitch = 0, fieldOfView = 0, width = 0, heightOfPicture = 0;
};

Result<Camera> cameraOf(const CameraNumbers& n, const Terrain& terrain) {
  HeightKind kind = HeightKind::aboveGround;
  if (n.kind == "msl")
    kind = HeightKind::seaLevel;
  else if (n.kind == "ell")
    kind = HeightKind::ellipsoidal;
  else if (n.kind != "agl")
    return failure(ErrorCode::usage, "is not one of agl, msl, ell", "reference=" + n.kind);
  const Vec2 xy = LongitudeTurns(terrain.model())({n.x, n.y});
  const auto height = demHeight({xy, n.height, kind}, terrain.heights());
  if (!height)
    return failure(ErrorCode::usage, height.error().message,
                   fmt::format("camera at {}", height.error().culprit));
  return Camera{.xy = xy,
                .height = *height,
                .azimuthDegrees = n.azimuth,
                .pitchDegrees = n.pitch,
                .verticalFieldOfViewDegrees = n.fieldOfView,
                .widthPixels = n.width,
                .heightPixels = n.heightOfPicture};
}

Result<Region> planRegionOf(const AskedRegion& asked, const TerrainModel& model, Warnings& warnings) {
  StatedRegion stated;
  if (const Box* box = std::get_if<Box>(&asked)) {
    stated.box = *box;
  } else {
    for (const auto& polygon : std::get<Polygons>(asked)) {
      auto& rings = stated.polygons.emplace_back();
      for (const auto& ring : polygon) {
        auto& points = rings.emplace_back();
        for (const auto& [x, y] : ring) points.push_back({x, y});
      }
    }
  }
  ARETE_TRY(auto argument, regionArgumentOf(stated, model.georeference, LongitudeTurns(model)));
  warnings = std::move(argument.warnings);
  Region region = planRegion(std::move(argument.shape), model);
  if (region.isEmpty() || !meetsDomain(region, model.mt))
    return failure(ErrorCode::usage, "does not meet the terrain", "region");
  return region;
}

CutTin takeTinOf(const Terrain& terrain, CutRequest request, const std::optional<AskedRegion>& region,
                 const std::optional<CameraNumbers>& camera, const py::object& progress) {
  Warnings warnings;
  Tin taken = call(progress, [&](const RunContext& context) -> Result<Tin> {
    if (region) {
      ARETE_TRY(Region inPlan, planRegionOf(*region, terrain.model(), warnings));
      request.planRegion = std::make_shared<const Region>(std::move(inPlan));
    }
    if (camera) {
      ARETE_TRY(const auto placed, cameraOf(*camera, terrain));
      request.camera = placed;
    }
    if (request.focus) request.focus->xy = LongitudeTurns(terrain.model())(request.focus->xy);
    return cut(terrain.model(), request, context);
  });
  for (Warning& warning : warnings) warning = warning.behind("region: ");
  warn(warnings);
  return CutTin(std::move(taken));
}

/// NaN where there is no terrain.
py::array_t<double> heightsAt(const Terrain& terrain, const Doubles& x, const Doubles& y, double maxError,
                              const py::object& progress) {
  std::vector<Vec2> places(static_cast<std::size_t>(x.size()));
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = {x.data()[i], y.data()[i]};
  LongitudeTurns(terrain.model()).apply(places);
  const auto answers = call(
      progress, [&](const RunContext& context) { return terrain.heights().at(places, maxError, context); });
  py::array_t<double> heights(static_cast<py::ssize_t>(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i)
    heights.mutable_data()[i] = answers[i] ? answers[i]->height : std::numeric_limits<double>::quiet_NaN();
  return heights;
}

std::array<double, 4> boundsOf(const TerrainModel& model) {
  const Box2 plan = sourcePlanBox(model);
  std::vector<Vec2> corners;
  for (const double x : {plan.xMin, plan.xMax})
    for (const double y : {plan.yMin, plan.yMax}) corners.push_back(model.toSource({x, y}));
  const Box2 box = planBox(corners);
  return {box.xMin, box.yMin, box.xMax, box.yMax};
}

}  // namespace

double Terrain::relief() const {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto take = [&](double height) {
    low = std::min(low, height);
    high = std::max(high, height);
  };
  for (std::uint32_t v = 0; v < model_->mt.vertexCount(); ++v) take(model_->mt.position(VertexId(v)).z);
  for (const IsolatedSample& one : model_->isolated) take(one.height);
  return high >= low ? high - low : 0;
}

namespace {

/// Columns, rows and GDAL's six numbers.
py::tuple gridOf(const Terrain& terrain, double cell) {
  const Result<CellGrid> grid = cellGridOf(terrain.model(), cell);
  if (!grid) raise(grid.error());
  return py::make_tuple(grid->columns, grid->rows, grid->geoTransform);
}

/// Samples in no triangle, by number in the raster, and their heights.
py::tuple isolatedOf(const Terrain& terrain) {
  const auto& isolated = terrain.model().isolated;
  py::array_t<std::uint32_t> samples(static_cast<py::ssize_t>(isolated.size()));
  py::array_t<double> heights(static_cast<py::ssize_t>(isolated.size()));
  for (std::size_t i = 0; i < isolated.size(); ++i) {
    samples.mutable_data()[i] = isolated[i].sample;
    heights.mutable_data()[i] = isolated[i].height;
  }
  return py::make_tuple(samples, heights);
}

}  // namespace

void defineTerrain(py::module_& module) {
  py::class_<Terrain, TerrainPtr> its(module, "Terrain");
  defineSight(its);
  py::class_<CameraNumbers>(module, "CameraNumbers")
      .def(py::init([](const std::array<double, 3>& place, std::string kind, double azimuth, double pitch,
                       double fieldOfView, const std::array<double, 2>& size) {
        return CameraNumbers{place[0], place[1],    place[2], std::move(kind), azimuth,
                             pitch,    fieldOfView, size[0],  size[1]};
      }));
  its.def("cut", &takeTinOf)
      .def("heights", &heightsAt)
      .def("grid_of", &gridOf)
      .def("isolated", &isolatedOf)
      .def_property_readonly("relief", &Terrain::relief)
      .def_property_readonly("columns", [](const Terrain& t) { return t.model().columns; })
      .def("save",
           [](const Terrain& terrain, const std::string& path, bool isPacked, const py::object& progress) {
             call(progress, [&](const RunContext& context) {
               return writeAmt(path, terrain.model(), context, {.writer = {}, .isPacked = isPacked});
             });
           })
      .def_property_readonly("crs_wkt", [](const Terrain& t) { return t.model().georeference.crsWkt; })
      .def_property_readonly("vertical_unit",
                             [](const Terrain& t) { return t.model().georeference.verticalUnit; })
      .def_property_readonly("geotransform",
                             [](const Terrain& t) -> std::optional<std::array<double, 6>> {
                               const Georeference& g = t.model().georeference;
                               if (!t.model().isRaster || !g.hasGeoTransform) return std::nullopt;
                               return g.geoTransform;
                             })
      .def_property_readonly("shape",
                             [](const Terrain& t) -> std::optional<std::array<std::uint32_t, 2>> {
                               if (!t.model().isRaster) return std::nullopt;
                               return std::array{t.model().rows, sourceColumns(t.model())};
                             })
      .def_property_readonly("bounds", [](const Terrain& t) { return boundsOf(t.model()); })
      .def_property_readonly("source", [](const Terrain& t) { return t.model().source; })
      .def_property_readonly("largest_error", [](const Terrain& t) { return t.model().mt.largestError(); })
      .def_property_readonly("vertex_count", [](const Terrain& t) { return t.model().mt.vertexCount(); })
      .def_property_readonly("finest_triangle_count",
                             [](const Terrain& t) { return t.model().mt.finestTriangleCount(); });
  module.def("build_file", [](const std::string& path, const std::string& shape, std::size_t features,
                              const py::object& progress) {
    return buildFile(path, {shape, features}, {}, true, progress);
  });
  module.def("build_array", [](const Doubles& heights, const std::optional<std::array<double, 6>>& transform,
                               const std::string& crs, const std::string& shape, std::size_t features,
                               const py::object& progress) {
    return buildArray(heights, transform, crs, {shape, features}, progress);
  });
}

}  // namespace arete::python

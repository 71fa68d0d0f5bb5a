// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/bindings/terrain.h"

#include <fmt/format.h>
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <variant>

#include "io/geo/crs/longitude_turns.h"
#include "io/geo/crs/position_argument.h"
#include "io/geo/crs/transform.h"
#include "io/geo/dem/raster_writer.h"
#include "io/query/extract/extract.h"
#include "io/query/extract/tin.h"
#include "io/query/parts/asked_places.h"
#include "io/store/amt/file.h"
#include "python/bindings/arrays.h"
#include "python/bindings/calls.h"
#include "python/bindings/export_files.h"
#include "python/bindings/questions.h"
#include "python/bindings/region.h"
#include "python/bindings/sight.h"
#include "python/bindings/tin.h"
#include "terrain/model/cell_grid.h"
#include "terrain/model/plan_box.h"

namespace arete::python {
namespace {

namespace py = pybind11;
using TerrainPtr = std::shared_ptr<Terrain>;

/// How a camera comes from Python: its place, and how high it is of what ("agl", "msl", "ell").
struct CameraNumbers {
  double x = 0, y = 0, height = 0;
  std::string kind;
  double azimuth = 0, pitch = 0, fieldOfView = 0, width = 0, heightOfPicture = 0;
};

Result<Camera> cameraOf(const CameraNumbers& n, const Terrain& terrain, const RunContext& context) {
  HeightKind kind = HeightKind::aboveGround;
  if (n.kind == "msl")
    kind = HeightKind::seaLevel;
  else if (n.kind == "ell")
    kind = HeightKind::ellipsoidal;
  else if (n.kind != "agl")
    return failure(ErrorCode::usage, "is not one of agl, msl, ell", "reference=" + n.kind);
  const TerrainModel& outline = terrain.outline();
  const Vec2 xy = LongitudeTurns(outline)({n.x, n.y}), plan = outline.toPlan(xy);
  // A height above the ground needs the ground there.
  const bool isAboveGround = kind == HeightKind::aboveGround;
  ARETE_TRY(const auto ground,
            terrain.at(isAboveGround ? wantedAt({&plan, 1}, outline) : requiredNowhere(), context));
  const auto height = demHeight({xy, n.height, kind}, ground->heights);
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

/// A cut as a request, by which it is known what of the model it needs.
ExtractRequest requestOf(const CutRequest& criterion) {
  ExtractRequest request;
  request.criterion = criterion;
  if (criterion.camera && !criterion.pixelError && !criterion.maxTriangles) request.criterion.pixelError = 1;
  if (criterion.planRegion) request.region = *criterion.planRegion;
  return request;
}

/// What is asked for, with the places as the library takes them.
/// @param isFile  the region is stated as text too, as an export has it
Result<CutRequest> placedRequest(const Terrain& terrain, CutRequest request,
                                 const std::optional<AskedRegion>& region,
                                 const std::optional<CameraNumbers>& camera, bool isFile, Warnings& warnings,
                                 const RunContext& context) {
  if (region) {
    ARETE_TRY(Region inPlan, planRegionOf(*region, terrain.outline(), warnings, context));
    request.planRegion = std::make_shared<const Region>(std::move(inPlan));
    if (isFile) stateRegion(*region, request);
  }
  if (camera) {
    ARETE_TRY(const auto placed, cameraOf(*camera, terrain, context));
    request.camera = placed;
  }
  if (request.focus) request.focus->xy = LongitudeTurns(terrain.outline())(request.focus->xy);
  return request;
}

CutTin takeTinOf(const Terrain& terrain, const CutRequest& asked, const std::optional<AskedRegion>& region,
                 const std::optional<CameraNumbers>& camera, const py::object& progress) {
  Warnings warnings;
  Tin taken = call(progress, [&](const RunContext& context) -> Result<Tin> {
    ARETE_TRY(const CutRequest request,
              placedRequest(terrain, asked, region, camera, false, warnings, context));
    ARETE_TRY(const auto taken, terrain.forRequest(requestOf(request), context));
    return cut(*taken.model, request, context);
  });
  for (Warning& warning : warnings) warning = warning.behind("region: ");
  warn(warnings);
  return CutTin(std::move(taken));
}

/// Cuts, writes and measures as `arete extract` does. Returns its report as JSON.
std::string extractTo(const Terrain& terrain, const CutRequest& asked,
                      const std::optional<AskedRegion>& region, const std::optional<CameraNumbers>& camera,
                      const ExportFiles& files, const py::object& progress) {
  Warnings warnings;
  std::string answer = call(progress, [&](const RunContext& context) -> Result<std::string> {
    ARETE_TRY(const CutRequest placed,
              placedRequest(terrain, asked, region, camera, true, warnings, context));
    ExtractRequest request = requestOf(placed);
    request.output = files.output;
    request.place = files.place;
    request.certificate = files.certificate;
    request.errorRaster = files.errorRaster;
    request.packedBits = files.packedBits;
    for (const std::string& name : {files.output, files.errorRaster})
      if (!name.empty()) ARETE_CHECK(checkExtractOutput(name, terrain.outline()));
    ARETE_TRY(auto taken, terrain.forRequest(request, context));
    TinExtractor extractor(
        taken.model, files.model,
        [&](const RunContext& of) -> Result<TerrainModel> {
          ARETE_TRY(const auto all, terrain.whole(of));
          return all->model;
        },
        [&](const ExtractRequest&, double promised) { return files.check(promised); });
    ARETE_TRY(ExtractedTin tin, extractor.extract(request, context, std::move(taken.cut)));
    const Georeference& georeference = terrain.outline().georeference;
    nlohmann::ordered_json lost = nlohmann::ordered_json::array();
    if (!georeference.crsWkt.empty() && !tin.format.saysCrs) lost.push_back("the CRS");
    if (!georeference.verticalUnit.empty() && !tin.format.saysVerticalUnit)
      lost.push_back("the unit of the heights");
    if (!tin.format.saysErrors && !isGeoTiffName(files.output)) lost.push_back("the error of each triangle");
    nlohmann::ordered_json report = toJson(request, ExtractReport(std::move(tin)));
    report["lost"] = std::move(lost);
    return report.dump();
  });
  for (Warning& warning : warnings) warning = warning.behind("region: ");
  warn(warnings);
  return answer;
}

/// NaN where there is no terrain.
py::array_t<double> heightsAt(const Terrain& terrain, const Doubles& x, const Doubles& y, double maxError,
                              const py::object& progress) {
  std::vector<Vec2> places(static_cast<std::size_t>(x.size()));
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = {x.data()[i], y.data()[i]};
  const TerrainModel& outline = terrain.outline();
  LongitudeTurns(outline).apply(places);
  const auto answers =
      call(progress, [&](const RunContext& context) -> Result<std::vector<std::optional<GroundHeight>>> {
        std::vector<Vec2> plan;
        if (terrain.isInParts())
          for (const Vec2 place : places) plan.push_back(outline.toPlan(place));
        ARETE_TRY(const auto ground, terrain.at(wantedAt(plan, outline), context));
        return ground->heights.at(places, maxError, context);
      });
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

OpenTerrain::Located wholeOf(const Terrain& terrain, const py::object& progress) {
  return call(progress, [&](const RunContext& context) { return terrain.whole(context); });
}

namespace {

/// Places of longitude and latitude in the CRS of the source: rows of x, y.
Doubles fromLonLat(const Terrain& terrain, const Doubles& places) {
  Result<CrsTransform> toSource = CrsTransform::fromLonLat(terrain.outline().georeference);
  if (!toSource && toSource.error().culprit.empty()) toSource.error().culprit = "lonlat";
  if (!toSource) raise(toSource.error());
  std::vector<Vec2> all;
  for (py::ssize_t i = 0; i < places.shape(0); ++i)
    all.push_back({places.data()[2 * i], places.data()[2 * i + 1]});
  toSource->apply(all);
  Doubles moved(std::vector<py::ssize_t>{static_cast<py::ssize_t>(all.size()), 2});
  for (std::size_t i = 0; i < all.size(); ++i) {
    moved.mutable_data()[2 * i] = all[i].x;
    moved.mutable_data()[2 * i + 1] = all[i].y;
  }
  return moved;
}

/// Columns, rows and GDAL's six numbers.
py::tuple gridOf(const Terrain& terrain, double cell) {
  const Result<CellGrid> grid = cellGridOf(terrain.outline(), cell);
  if (!grid) raise(grid.error());
  return py::make_tuple(grid->columns, grid->rows, grid->geoTransform);
}

/// The heights of a raster as it was read, row by row; NaN: NODATA. A first column that is repeated is left
/// out.
py::array_t<double> samplesOf(const Terrain& terrain) {
  const OpenTerrain::Located all = wholeOf(terrain, py::none());
  const TerrainModel& model = all->model;
  const RasterHeightfield field = model.rasterSamples();
  const std::size_t columns = sourceColumns(model);
  py::array_t<double> heights(
      std::vector<py::ssize_t>{static_cast<py::ssize_t>(model.rows), static_cast<py::ssize_t>(columns)});
  double* to = heights.mutable_data();
  for (std::size_t row = 0; row < model.rows; ++row)
    for (std::size_t column = 0; column < columns; ++column)
      *to++ = field.heights[row * model.columns + column];
  return heights;
}

/// Samples in no triangle, by number in the raster, and their heights.
py::tuple isolatedOf(const Terrain& terrain) {
  const auto& isolated = terrain.outline().isolated;
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
  defineQuestions(its);
  py::class_<CameraNumbers>(module, "CameraNumbers")
      .def(py::init([](const std::array<double, 3>& place, std::string kind, double azimuth, double pitch,
                       double fieldOfView, const std::array<double, 2>& size) {
        return CameraNumbers{place[0], place[1],    place[2], std::move(kind), azimuth,
                             pitch,    fieldOfView, size[0],  size[1]};
      }));
  its.def("cut", &takeTinOf)
      .def("extract", &extractTo)
      .def("from_lonlat", &fromLonLat)
      .def("heights", &heightsAt)
      .def("grid_of", &gridOf)
      .def("isolated", &isolatedOf)
      .def("samples", &samplesOf)
      .def_property_readonly("relief", &Terrain::relief)
      .def_property_readonly("columns", [](const Terrain& t) { return t.outline().columns; })
      .def("save",
           [](const Terrain& terrain, const std::string& path, bool isPacked, bool isPaged,
              const py::object& progress) {
             call(progress, [&](const RunContext& context) {
               const auto all = terrain.whole(context);
               if (!all) return Status(tl::unexpected(all.error()));
               return writeAmt(path, (*all)->model, context,
                               {.writer = {}, .isPacked = isPacked, .isPaged = isPaged});
             });
           })
      .def_property_readonly("crs_wkt", [](const Terrain& t) { return t.outline().georeference.crsWkt; })
      .def_property_readonly("vertical_unit",
                             [](const Terrain& t) { return t.outline().georeference.verticalUnit; })
      .def_property_readonly("geotransform",
                             [](const Terrain& t) -> std::optional<std::array<double, 6>> {
                               const Georeference& g = t.outline().georeference;
                               if (!t.outline().isRaster || !g.hasGeoTransform) return std::nullopt;
                               return g.geoTransform;
                             })
      .def_property_readonly("shape",
                             [](const Terrain& t) -> std::optional<std::array<std::uint32_t, 2>> {
                               if (!t.outline().isRaster) return std::nullopt;
                               return std::array{t.outline().rows, sourceColumns(t.outline())};
                             })
      .def_property_readonly("bounds", [](const Terrain& t) { return boundsOf(t.outline()); })
      .def_property_readonly("source", [](const Terrain& t) { return t.outline().source; })
      .def_property_readonly(
          "largest_error",
          [](const Terrain& t) {
            return call(py::none(), [&](const RunContext& context) { return t.largestError(context); });
          })
      .def_property_readonly("vertex_count", &Terrain::vertexCount)
      .def_property_readonly("finest_triangle_count", &Terrain::finestTriangleCount);
}

}  // namespace arete::python

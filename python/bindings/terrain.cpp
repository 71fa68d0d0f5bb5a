// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/bindings/terrain.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <variant>

#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "io/amt/file.h"
#include "io/crs/longitude_turns.h"
#include "io/dem/dem_reader.h"
#include "io/exchange/export_tin.h"
#include "io/exchange/mesh_formats.h"
#include "io/extract/region_argument.h"
#include "python/bindings/array_file.h"
#include "python/bindings/calls.h"
#include "python/bindings/sight.h"
#include "python/bindings/tin.h"
#include "terrain/build/build.h"
#include "terrain/features/fixed_vertices.h"
#include "terrain/model/plan_box.h"
#include "terrain/model/plan_region.h"

namespace arete::python {
namespace {

namespace py = pybind11;
using Rings = std::vector<std::vector<std::array<double, 2>>>;

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
        const Result<FixedVertices> fixed = chooseFixedVertices(field, fixedOptions, context);
        if (!fixed) return tl::unexpected(fixed.error());
        options.fixedVertices = fixed->vertices;
        return build(field, options, context);
      },
      dem.heightfield);
}

/// Whether a warning is about where a raster without a position is: of an array that is no news.
bool isOfPlace(const std::string& warning) {
  return warning.find("has no georeference") != std::string::npos ||
         warning.find("look like degrees") != std::string::npos;
}

/// @param hasPlace false: warnings about its position are left out
TerrainPtr buildFile(const std::string& path, const BuildRequest& request, const std::string& source,
                     bool hasPlace, const py::object& progress) {
  std::vector<std::string> warnings;
  TerrainModel model = call(progress, [&](const RunContext& context) -> Result<TerrainModel> {
    // `arete build` makes a surface of such a file, and its vertices alone are another thing.
    if (const Result<MeshFormat> format = meshFormatOf(path);
        format && format->read && format->extension != ".gpkg")
      return failure(ErrorCode::unsupported,
                     "is a mesh: `arete build` makes a surface of it, which arete.open() opens", path);
    Result<DemRead> dem = readDem(path, {}, context);
    if (!dem) return tl::unexpected(dem.error());
    warnings = std::move(dem->warnings);
    return buildFrom(std::move(*dem), source, request, context);
  });
  for (const std::string& warning : warnings)
    if ((hasPlace || !isOfPlace(warning)) && PyErr_WarnEx(PyExc_UserWarning, warning.c_str(), 2) != 0)
      throw py::error_already_set();
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

Result<Tin> tinOf(const TerrainModel& model, const Cut& cut) {
  Result<TinExport> tin = exportTin(model, cut);
  if (!tin) return tl::unexpected(tin.error());
  return Tin{std::move(tin->mesh.positions),
             std::move(tin->mesh.triangles),
             std::move(tin->errors),
             cut.achievedError,
             cut.isComplete,
             model.georeference.crsWkt};
}

Tin takeTin(const Terrain& terrain, std::optional<double> maxError, std::optional<std::uint32_t> maxTriangles,
            const Rings& rings, double outsideError, const py::object& progress) {
  return call(progress, [&](const RunContext& context) -> Result<Tin> {
    const TerrainModel& model = terrain.model();
    std::unique_ptr<const BoundedCriterion> criterion;
    if (rings.empty()) {
      criterion = std::make_unique<UniformError>(maxError.value_or(0));
    } else {
      RegionArgument stated;
      for (const auto& ring : rings) {
        auto& points = stated.shape.rings.emplace_back();
        for (const auto& [x, y] : ring) points.push_back({x, y});
      }
      turnOnto(LongitudeTurns(model), stated);
      Region region = planRegion(std::move(stated.shape), model);
      if (region.isEmpty() || !meetsDomain(region, model.mt))
        return failure(ErrorCode::usage, "does not meet the terrain", "region");
      criterion = std::make_unique<RegionError>(std::move(region), model.mt.arrays().metric,
                                                maxError.value_or(0), outsideError);
    }
    CutOptions options;
    options.maxTriangles = maxTriangles;
    const Result<Cut> cut = takeCut(model.mt, *criterion, options, context);
    if (!cut) return tl::unexpected(cut.error());
    return tinOf(model, *cut);
  });
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
  const Box2 plan = planBox(model);
  std::vector<Vec2> corners;
  for (const double x : {plan.xMin, plan.xMax})
    for (const double y : {plan.yMin, plan.yMax}) corners.push_back(model.toSource({x, y}));
  const Box2 box = planBox(corners);
  return {box.xMin, box.yMin, box.xMax, box.yMax};
}

}  // namespace

void defineTerrain(py::module_& module) {
  py::class_<Terrain, TerrainPtr> its(module, "Terrain");
  defineSight(its);
  its.def("cut", &takeTin)
      .def("heights", &heightsAt)
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
                               return std::array{t.model().rows, t.model().columns};
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
  module.def("open_terrain", [](const std::string& path, const py::object& progress) {
    return std::make_shared<Terrain>(
        call(progress, [&](const RunContext& context) { return loadAmt(path, {}, context); }));
  });
}

}  // namespace arete::python

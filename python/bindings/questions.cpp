// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/bindings/questions.h"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "engine/cut/error_curve.h"
#include "engine/laws/law.h"
#include "io/geo/crs/names.h"
#include "io/geo/dem/dem_reader.h"
#include "python/bindings/build.h"
#include "python/bindings/calls.h"
#include "surface/laws/validate_surface.h"
#include "terrain/laws/compare_source.h"
#include "terrain/laws/validate_model.h"

namespace arete::python {
namespace {

namespace py = pybind11;
using Json = nlohmann::ordered_json;

/// What both kinds of models say.
Json commonFacts(const auto& model) {
  const MultiTriangulation& mt = model.outline().mt;
  return {{"vertices", model.vertexCount()},
          {"triangles", model.triangleCount()},
          {"finestTriangles", model.finestTriangleCount()},
          {"rootTriangles", mt.rootTriangleCount()},
          {"rootVertices", mt.rootVertexCount()},
          {"rootError",
           call(py::none(), [&](const RunContext& context) { return model.largestError(context); })}};
}

std::string terrainFacts(const Terrain& terrain) {
  const TerrainModel& model = terrain.outline();
  Json facts = {{"kind", "terrain"},
                {"source", model.source},
                {"sourceChecksum", model.sourceChecksum},
                {"crs", crsName(model.georeference.crsWkt)},
                {"verticalUnit", model.georeference.verticalUnit},
                {"verticalDatum", model.georeference.verticalDatum},
                {"relief", terrain.relief()},
                {"samples", terrain.vertexCount() + model.isolated.size()},
                {"isolated", model.isolated.size()}};
  facts.update(commonFacts(terrain));
  facts["levels"] = model.levels;
  facts["shape"] = toString(model.options.shape);
  facts["ratio"] = model.options.thresholdRatioOrDefault();
  facts["maxDegree"] = model.options.maxDegree;
  facts["rimTolerance"] = model.options.rimTolerance;
  facts["fixedVertices"] = model.options.fixedVertices.size();
  return facts.dump();
}

/// The arguments of measure() by which the source is read as the build read it; a rim that may be moved
/// covers NODATA.
std::string terrainReading(const Terrain& terrain) {
  const SourceReading& reading = terrain.outline().reading;
  Json json = Json::object();
  if (reading.band) json["band"] = *reading.band;
  for (const auto& [name, text] : {std::pair{"layer", &reading.layer},
                                   {"zField", &reading.zField},
                                   {"samePlace", &reading.samePlace},
                                   {"crs", &reading.crs},
                                   {"verticalUnit", &reading.verticalUnit}})
    if (!text->empty()) json[name] = *text;
  if (reading.nodata) json["nodata"] = *reading.nodata;
  if (reading.isDepth) json["positive"] = *reading.isDepth ? "down" : "up";
  if (terrain.outline().options.rimTolerance > 0) json["allowCoveredNodata"] = true;
  return json.dump();
}

std::string surfaceFacts(const OpenSurface& surface) {
  const SurfaceModel& model = surface.outline();
  Json facts = {{"kind", "surface"},
                {"source", model.source},
                {"crs", crsName(model.crsWkt)},
                {"sourceFaces", model.fileFaces},
                {"sourceVertices", model.sourceVertices},
                {"diagonal", model.diagonal},
                {"positionError", model.positionError},
                {"displacement", !model.displacement.isEmpty()},
                {"boundsLines", model.boundsLines}};
  facts.update(commonFacts(surface));
  facts["levels"] = model.levels;
  return facts.dump();
}

using Points = std::vector<std::tuple<double, std::uint64_t, std::uint64_t>>;

/// @param at  errors; none: the ladder of the model
Points terrainCurve(const Terrain& terrain, std::vector<double> at, std::size_t most,
                    const py::object& progress) {
  const auto curve = call(progress, [&](const RunContext& context) -> Result<std::vector<CurvePoint>> {
    if (at.empty())
      if (auto stated = terrain.statedCurve(most)) return std::move(*stated);
    ARETE_TRY(const auto all, terrain.whole(context));
    if (at.empty()) at = toleranceLadder(all->model.mt, most);
    return errorCurve(all->model.mt, at, context);
  });
  Points points;
  for (const CurvePoint& p : curve) points.emplace_back(p.maxError, p.minimalTriangles, p.saturatedTriangles);
  return points;
}

Points surfaceCurve(const OpenSurface& surface, const std::vector<double>& at, const py::object& progress) {
  return call(progress, [&](const RunContext& context) -> Result<Points> {
    ARETE_TRY(const auto all, surface.whole(context));
    const SurfaceModel& model = *all;
    Points points;
    for (const double error : at) {
      ARETE_TRY(const Cut cut, takeCut(model.mt, UniformError(error), {}, context));
      points.emplace_back(error, cut.triangles.size(), uniformTriangleCount(model.mt, error));
    }
    return points;
  });
}

/// A violation is an answer; any other error is one.
Result<Json> verdictOf(const Status& valid) {
  if (!valid && valid.error().code != ErrorCode::brokenPromise) return tl::unexpected(valid.error());
  Json json = {{"holds", valid.has_value()}};
  if (!valid) json["violation"] = valid.error().message;
  return json;
}

/// How the source is read: as is stated, or as it was read for the build.
SourceReading readingOf(SourceReading reading, const SourceReading& built) {
  if (!reading.band) reading.band = built.band;
  if (reading.layer.empty()) reading.layer = built.layer;
  if (reading.zField.empty()) reading.zField = built.zField;
  if (reading.crs.empty()) reading.crs = built.crs;
  if (!reading.nodata) reading.nodata = built.nodata;
  if (reading.otherFiles.empty()) reading.otherFiles = built.otherFiles;
  return reading;
}

std::string validateTerrain(const Terrain& terrain, std::uint32_t fronts, std::uint64_t seed, bool isFull,
                            const std::string& against, const BuildRequest& request,
                            const py::object& progress) {
  Warnings warnings;
  std::string answer = call(progress, [&](const RunContext& context) -> Result<std::string> {
    ARETE_TRY(const auto all, terrain.whole(context));
    const TerrainModel& model = all->model;
    ErrorsChecked checked;
    Status valid = validateModel(model, {.randomFronts = fronts, .seed = seed, .everyTriangle = isFull},
                                 context, &checked);
    std::uint64_t compared = 0;
    if (valid && !against.empty()) {
      ARETE_TRY(const DemRead dem, readDem(against, readingOf(request.reading, model.reading), context));
      warnings = dem.warnings;
      const auto same =
          std::visit([&](const auto& field) { return compareWithSource(model, field); }, dem.heightfield);
      if (same)
        compared = *same;
      else
        valid = tl::unexpected(same.error());
    }
    ARETE_TRY(Json json, verdictOf(valid));
    if (valid) {
      json["errorsChecked"] = {{"triangles", checked.checked}, {"of", checked.triangles}};
      json["heightsCompared"] = compared;
      for (const Law& law : kLaws)
        json["laws"].push_back({{"law", law.number},
                                {"says", law.ofTerrain},
                                {"claimed", law.number != 9 || (model.options.shape == HoleShape::delaunay &&
                                                                model.options.rimTolerance == 0)}});
    }
    return json.dump();
  });
  warn(warnings);
  return answer;
}

std::string validateOneSurface(const OpenSurface& surface, bool isFull, const py::object& progress) {
  return call(progress, [&](const RunContext& context) -> Result<std::string> {
    ARETE_TRY(const auto all, surface.whole(context));
    const Status valid = validateSurface(*all, {.everySample = isFull}, context);
    ARETE_TRY(Json json, verdictOf(valid));
    if (valid)
      for (const Law& law : kLaws)
        if (!law.ofSurfaces.empty())
          json["laws"].push_back({{"law", law.number}, {"says", law.ofSurfaces}, {"claimed", true}});
    return json.dump();
  });
}

}  // namespace

void defineQuestions(py::class_<Terrain, std::shared_ptr<Terrain>>& terrain) {
  terrain.def("facts", &terrainFacts)
      .def("reading", &terrainReading)
      .def("other_files", [](const Terrain& t) { return t.outline().reading.otherFiles; })
      .def_property_readonly("root_triangle_count",
                             [](const Terrain& t) { return t.outline().mt.rootTriangleCount(); })
      .def("curve", &terrainCurve)
      .def("validate", &validateTerrain);
}

void defineQuestions(py::class_<OpenSurface, std::shared_ptr<OpenSurface>>& surface) {
  surface.def("facts", &surfaceFacts)
      .def_property_readonly("root_triangle_count",
                             [](const OpenSurface& s) { return s.outline().mt.rootTriangleCount(); })
      .def("curve", &surfaceCurve)
      .def("validate", &validateOneSurface);
}

}  // namespace arete::python

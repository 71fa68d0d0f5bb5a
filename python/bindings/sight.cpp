// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/bindings/sight.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/counted.h"
#include "io/geo/crs/ellipsoid_earth.h"
#include "io/geo/crs/longitude_turns.h"
#include "io/geo/crs/position_argument.h"
#include "python/bindings/arrays.h"
#include "python/bindings/calls.h"
#include "terrain/measure/measure.h"
#include "terrain/model/plan_box.h"
#include "terrain/sight/earth.h"
#include "terrain/sight/engine.h"
#include "terrain/sight/paths.h"
#include "terrain/sight/profile.h"
#include "terrain/viewshed/viewshed.h"

namespace arete::python {
namespace {

namespace py = pybind11;

/// How lines of sight are taken.
struct SightRequest {
  std::string earth, nodata;
  std::optional<double> refraction;
};

Result<std::unique_ptr<SightEarth>> makeEarth(const SightRequest& request, const TerrainModel& model) {
  if (!request.earth.empty() && request.earth != "plane" && request.earth != "ellipsoid")
    return failure(ErrorCode::usage, "is neither ellipsoid nor plane", "earth=" + request.earth);
  const bool isPlane =
      request.earth == "plane" || (request.earth.empty() && !isOnEllipsoid(model.georeference));
  // As --refraction has it.
  if (const double k = request.refraction.value_or(0); !(k >= -10 && k <= 10))
    return failure(ErrorCode::usage, "is not between -10 and 10", fmt::format("refraction={}", k));
  if (!isPlane) return makeEllipsoidEarth(model, request.refraction.value_or(kUsualRefraction));
  if (request.refraction.value_or(0) != 0)
    return failure(ErrorCode::usage, "requires an ellipsoid; the map is taken as a plane", "refraction");
  return makePlaneEarth(model);
}

Result<NodataSight> nodataOf(const SightRequest& request) {
  if (request.nodata == "unknown") return NodataSight::unknown;
  if (request.nodata == "blocked") return NodataSight::blocked;
  if (request.nodata == "clear") return NodataSight::clear;
  return failure(ErrorCode::usage, "is not one of unknown, blocked, clear", "nodata=" + request.nodata);
}

/// An end above the ground, in plan coordinates and from the DEM's zero.
Result<std::pair<Vec2, double>> endOf(const Terrain& terrain, const LongitudeTurns& turns, const double* xyh,
                                      const std::string& culprit) {
  const Vec2 xy = turns({xyh[0], xyh[1]});
  if (!std::isfinite(xyh[2])) return failure(ErrorCode::usage, "has no height", culprit);
  const auto height = demHeight({xy, xyh[2], HeightKind::aboveGround}, terrain.heights());
  if (!height)
    return failure(ErrorCode::usage, height.error().message,
                   fmt::format("{} at {}", culprit, height.error().culprit));
  return std::pair{sightPlan(terrain.model(), xy), *height};
}

/// @param from,to rows of x, y, height above the ground
/// @return verdicts, clearances, distances and places of obstructions
py::tuple los(const Terrain& terrain, const Doubles& from, const Doubles& to, double maxError,
              const std::string& earthName, std::optional<double> refraction, const std::string& nodata,
              const py::object& progress) {
  const auto count = static_cast<std::size_t>(from.shape(0));
  const auto answers = call(progress, [&](const RunContext& context) -> Result<std::vector<SightPathAnswer>> {
    const TerrainModel& model = terrain.model();
    const SightRequest request{earthName, nodata, refraction};
    ARETE_TRY(const auto earth, makeEarth(request, model));
    ARETE_TRY(const auto gaps, nodataOf(request));
    const LongitudeTurns turns(model);
    std::vector<SightPath> paths;
    for (std::size_t i = 0; i < count; ++i) {
      ARETE_TRY(const auto first, endOf(terrain, turns, from.data() + 3 * i, fmt::format("observer {}", i)));
      ARETE_TRY(const auto second, endOf(terrain, turns, to.data() + 3 * i, fmt::format("target {}", i)));
      paths.push_back({first.first, second.first, first.second, second.second});
    }
    ARETE_TRY(const auto engine, makeSightEngine(methodFor(count, maxError, model), model, {}, context));
    const Profiles profiles(model, nullptr);
    SightPathOptions options;
    options.sight.nodata = gaps;
    options.sight.maxError = maxError;
    ARETE_TRY(const auto found, answerPaths(paths, *earth, *engine, profiles, options, context));
    std::vector<SightPathAnswer> all;
    for (std::size_t i = 0; i < count; ++i) {
      const Result<SightPathAnswer>& one = found[i];
      if (!one)
        return failure(one.error().code, one.error().message,
                       fmt::format("line {}: {}", i, one.error().culprit));
      all.push_back(*one);
    }
    return all;
  });
  std::vector<std::string> verdicts;
  Doubles clearances(static_cast<py::ssize_t>(count)), distances(static_cast<py::ssize_t>(count)),
      obstructions(std::vector<py::ssize_t>{static_cast<py::ssize_t>(count), 2});
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t i = 0; i < count; ++i) {
    const SightAnswer& answer = answers[i].sight;
    verdicts.emplace_back(toString(answer.verdict));
    clearances.mutable_data()[i] = answer.clearance.value_or(kNone);
    distances.mutable_data()[i] = answers[i].distanceMetres;
    const Vec2 at =
        answer.obstruction ? terrain.model().toSource(answer.obstruction->plan) : Vec2{kNone, kNone};
    obstructions.mutable_data()[2 * i] = at.x;
    obstructions.mutable_data()[2 * i + 1] = at.y;
  }
  return py::make_tuple(verdicts, clearances, distances, obstructions);
}

/// @param line rows of x, y
/// @return distances, places, heights, and the part of each vertex; the length and how much of it has none
py::tuple profile(const Terrain& terrain, const Doubles& line, double maxError, const std::string& earthName,
                  std::optional<double> refraction, const py::object& progress) {
  const Profile found = call(progress, [&](const RunContext&) -> Result<Profile> {
    const TerrainModel& model = terrain.model();
    ARETE_TRY(const auto earth, makeEarth({earthName, "unknown", refraction}, model));
    const LongitudeTurns turns(model);
    std::vector<Vec2> places;
    for (py::ssize_t i = 0; i < line.shape(0); ++i)
      places.push_back({line.data()[2 * i], line.data()[2 * i + 1]});
    turns.apply(places);
    for (Vec2& place : places) place = sightPlan(model, place);
    ARETE_TRY(const auto track, trackAlong(places, *earth));
    const Profiles profiles(
        model, maxError == 0 && model.isRaster ? std::make_shared<const SightGrid>(model) : nullptr);
    return profiles.along(track, maxError);
  });
  const auto count = static_cast<py::ssize_t>(found.vertices.size());
  Doubles distances(count), heights(count), places(std::vector<py::ssize_t>{count, 2});
  py::array_t<std::int64_t> parts(count);
  std::int64_t part = 0;
  for (py::ssize_t i = 0; i < count; ++i) {
    const ProfileVertex& v = found.vertices[static_cast<std::size_t>(i)];
    const Vec2 xy = terrain.model().toSource(v.plan);
    part += !v.isJoined;
    distances.mutable_data()[i] = v.distance;
    heights.mutable_data()[i] = v.height;
    parts.mutable_data()[i] = part;
    places.mutable_data()[2 * i] = xy.x;
    places.mutable_data()[2 * i + 1] = xy.y;
  }
  return py::make_tuple(distances, places, heights, parts, found.length, found.gapMetres);
}

py::array_t<std::uint8_t> viewshed(const Terrain& terrain, const std::array<double, 3>& observer,
                                   double targetHeight, double radius, const std::string& earthName,
                                   std::optional<double> refraction, const std::string& nodata,
                                   const py::object& progress) {
  const Viewshed seen = call(progress, [&](const RunContext& context) -> Result<Viewshed> {
    const TerrainModel& model = terrain.model();
    const SightRequest request{earthName, nodata, refraction};
    ARETE_TRY(const auto earth, makeEarth(request, model));
    ARETE_TRY(const auto gaps, nodataOf(request));
    ARETE_TRY(const auto end, endOf(terrain, LongitudeTurns(model), observer.data(), "observer"));
    ARETE_TRY(const auto maker, ViewshedMaker::make(model, *earth, {}, context));
    ViewshedOptions options;
    options.targetHeight = targetHeight;
    options.field.greatestMetres = radius;
    options.nodata = gaps;
    return maker.from({end.first, end.second}, options, context);
  });
  if (seen.withoutLine > 0)
    warn({{WarningCode::omitted,
           fmt::format("{} passes a pole or a seam of the CRS",
                       counted(seen.withoutLine, "sample is unknown: the shortest way to it",
                               "samples are unknown: the shortest way to them"))}});
  // Of the source's columns: a first one that is repeated is left out.
  const std::uint32_t columns = sourceColumns(terrain.model());
  py::array_t<std::uint8_t> cells(
      std::vector<py::ssize_t>{static_cast<py::ssize_t>(seen.rows), static_cast<py::ssize_t>(columns)});
  std::uint8_t* to = cells.mutable_data();
  for (std::size_t row = 0; row < seen.rows; ++row)
    for (std::size_t column = 0; column < columns; ++column)
      *to++ = byteOf(seen.cells[row * seen.columns + column]);
  return cells;
}

py::dict measureMesh(const Terrain& terrain, const Doubles& vertices, const Indices& triangles,
                     const py::object& progress) {
  const MeasureReport report = call(progress, [&](const RunContext& context) -> Result<MeasureReport> {
    const TriangleMesh mesh = meshOf(vertices, triangles);
    const TerrainModel& model = terrain.model();
    return model.isRaster ? measure(mesh, model.rasterSamples(), {}, context)
                          : measure(mesh, model.pointSamples(), {}, context);
  });
  py::dict found;
  // An error of nothing is no number.
  const auto ofSome = [&](double error) {
    return report.covered > 0 ? error : std::numeric_limits<double>::quiet_NaN();
  };
  found["max_abs_error"] = ofSome(report.maxAbsError);
  found["rms_error"] = ofSome(report.rmsError);
  found["mean_error"] = ofSome(report.meanError);
  found["mean_abs_error"] = ofSome(report.meanAbsError);
  found["covered"] = report.covered;
  found["uncovered"] = report.uncovered;
  found["doubly_covered"] = report.doublyCovered;
  found["nodata_covered"] = report.nodataCovered;
  return found;
}

}  // namespace

void defineSight(py::class_<Terrain, std::shared_ptr<Terrain>>& terrain) {
  terrain.def("los", &los).def("profile", &profile).def("viewshed", &viewshed).def("measure", &measureMesh);
}

}  // namespace arete::python

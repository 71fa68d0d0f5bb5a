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
#include "io/geo/dem/clutter_raster.h"
#include "io/query/parts/asked_places.h"
#include "python/bindings/arrays.h"
#include "python/bindings/calls.h"
#include "python/bindings/region.h"
#include "python/bindings/viewshed.h"
#include "terrain/measure/measure.h"
#include "terrain/model/plan_box.h"
#include "terrain/sight/earth.h"
#include "terrain/sight/engine.h"
#include "terrain/sight/fresnel.h"
#include "terrain/sight/paths.h"
#include "terrain/sight/profile.h"

namespace arete::python {

namespace py = pybind11;

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
Result<std::pair<Vec2, double>> endOf(const LocatedTerrain& ground, const LongitudeTurns& turns,
                                      const double* xyh, const std::string& culprit) {
  const Vec2 xy = turns({xyh[0], xyh[1]});
  if (!std::isfinite(xyh[2])) return failure(ErrorCode::usage, "has no height", culprit);
  const auto height = demHeight({xy, xyh[2], HeightKind::aboveGround}, ground.heights);
  if (!height)
    return failure(ErrorCode::usage, height.error().message,
                   fmt::format("{} at {}", culprit, height.error().culprit));
  return std::pair{sightPlan(ground.model, xy), *height};
}

namespace {

/// What los() takes beside its ends.
struct LosRequest {
  SightRequest sight;
  double maxError = 0, frequency = 0, clutterFree = 100;
  std::string method = "auto", clutter;
};

Result<SightMethod> methodOf(const LosRequest& request, std::size_t count, const TerrainModel& model) {
  if (request.method == "auto") return methodFor(count, request.maxError, model);
  for (const SightMethod method :
       {SightMethod::descent, SightMethod::pyramid, SightMethod::scan, SightMethod::embree})
    if (toString(method) == request.method) {
      if (model.isRaster || method == SightMethod::descent) return method;
      return failure(ErrorCode::usage, "requires a raster; the model is made of points",
                     "method=" + request.method);
    }
  return failure(ErrorCode::usage, "is not one of auto, descent, pyramid, scan, embree",
                 "method=" + request.method);
}

Result<SightPathOptions> pathOptionsOf(const LosRequest& request, const TerrainModel& model,
                                       const RunContext& context) {
  SightPathOptions options;
  ARETE_TRY(options.sight.nodata, nodataOf(request.sight));
  options.sight.maxError = request.maxError;
  options.frequencyMegahertz = request.frequency;
  if (!request.clutter.empty()) {
    if (request.maxError > 0)
      return failure(ErrorCode::usage, "cannot be combined with max_error", "clutter");
    ARETE_TRY(options.clutter, readClutter(request.clutter, model, context));
    options.clutter.freeMetres = request.clutterFree;
  }
  return options;
}

/// What the lines between some ends require; all of the model where the method reads all samples.
RequiredError wantedFor(SightMethod method, const LongitudeTurns& turns, const Doubles& from,
                        const Doubles& to, const SightEarth& earth, const Terrain& terrain) {
  if (method != SightMethod::descent || !terrain.isInParts()) return {};
  std::vector<std::array<Vec2, 2>> ends;
  for (py::ssize_t i = 0; i < from.shape(0); ++i) {
    const double* const a = from.data() + 3 * i;
    const double* const b = to.data() + 3 * i;
    ends.push_back({turns({a[0], a[1]}), turns({b[0], b[1]})});
  }
  return wantedBetween(ends, earth, terrain.outline());
}

/// @param from,to rows of x, y, height above the ground
/// @return verdicts, and rows of clearance, distance, x and y of the obstruction, azimuth, elevation and part
/// of the Fresnel zone
py::tuple los(const Terrain& terrain, const Doubles& from, const Doubles& to, const LosRequest& request,
              const py::object& progress) {
  const auto count = static_cast<std::size_t>(from.shape(0));
  const auto answers = call(progress, [&](const RunContext& context) -> Result<std::vector<SightPathAnswer>> {
    const TerrainModel& outline = terrain.outline();
    ARETE_TRY(const auto earth, makeEarth(request.sight, outline));
    ARETE_TRY(const SightPathOptions options, pathOptionsOf(request, outline, context));
    ARETE_TRY(const SightMethod method, methodOf(request, count, outline));
    const LongitudeTurns turns(outline);
    ARETE_TRY(const auto ground, terrain.at(wantedFor(method, turns, from, to, *earth, terrain), context));
    const TerrainModel& model = ground->model;
    std::vector<SightPath> paths;
    for (std::size_t i = 0; i < count; ++i) {
      ARETE_TRY(const auto first, endOf(*ground, turns, from.data() + 3 * i, fmt::format("observer {}", i)));
      ARETE_TRY(const auto second, endOf(*ground, turns, to.data() + 3 * i, fmt::format("target {}", i)));
      paths.push_back({first.first, second.first, first.second, second.second});
    }
    // Profiles at full resolution walk over the cells of a raster.
    const bool hasProfiles = request.frequency > 0 || options.clutter.height;
    const auto grid = hasProfiles && model.isRaster ? std::make_shared<const SightGrid>(model) : nullptr;
    ARETE_TRY(const auto engine, makeSightEngine(method, model, grid, context));
    const Profiles profiles(model, grid);
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
  constexpr py::ssize_t kColumns = 7;
  Doubles numbers(std::vector<py::ssize_t>{static_cast<py::ssize_t>(count), kColumns});
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  double* to_ = numbers.mutable_data();
  for (const SightPathAnswer& path : answers) {
    const SightAnswer& answer = path.sight;
    verdicts.emplace_back(toString(answer.verdict));
    const Vec2 at =
        answer.obstruction ? terrain.outline().toSource(answer.obstruction->plan) : Vec2{kNone, kNone};
    for (const double number :
         {answer.clearance.value_or(kNone), path.distanceMetres, at.x, at.y, path.azimuthDegrees,
          path.elevationDegrees, path.fresnel ? path.fresnel->fraction : kNone})
      *to_++ = number;
  }
  return py::make_tuple(verdicts, numbers);
}

/// The straight line between two ends at the vertices of a profile: its height, and the radius of the first
/// Fresnel zone there, in the unit of heights.
/// @param ends two rows of x, y, height above the ground
py::tuple sightOver(const Terrain& terrain, const Doubles& ends, const Doubles& distances,
                    const std::string& earthName, std::optional<double> refraction, double frequency) {
  const TerrainModel& outline = terrain.outline();
  const SightLine line = call(py::none(), [&](const RunContext& context) -> Result<SightLine> {
    ARETE_TRY(const auto earth, makeEarth({earthName, "unknown", refraction}, outline));
    const LongitudeTurns turns(outline);
    const std::array places = {outline.toPlan(turns({ends.data()[0], ends.data()[1]})),
                               outline.toPlan(turns({ends.data()[3], ends.data()[4]}))};
    ARETE_TRY(const auto ground, terrain.at(wantedAt(places, outline), context));
    ARETE_TRY(const auto first, endOf(*ground, turns, ends.data(), "observer"));
    ARETE_TRY(const auto second, endOf(*ground, turns, ends.data() + 3, "target"));
    return sightLine({first.first, second.first, first.second, second.second}, *earth, outline);
  });
  Doubles heights(distances.size()), radii(distances.size());
  const double wavelength = frequency > 0 ? wavelengthMetres(frequency) : 0;
  for (py::ssize_t i = 0; i < distances.size(); ++i) {
    const double s = distances.data()[i];
    heights.mutable_data()[i] = line.height(s);
    radii.mutable_data()[i] = fresnelRadius(wavelength, s, line.length()) / line.heightUnitMetres();
  }
  return py::make_tuple(heights, radii);
}

/// @param line rows of x, y
/// @return distances, places, heights, and the part of each vertex; the length and how much of it has none
py::tuple profile(const Terrain& terrain, const Doubles& line, double maxError, const std::string& earthName,
                  std::optional<double> refraction, const py::object& progress) {
  const TerrainModel& outline = terrain.outline();
  const Profile found = call(progress, [&](const RunContext& context) -> Result<Profile> {
    ARETE_TRY(const auto earth, makeEarth({earthName, "unknown", refraction}, outline));
    const LongitudeTurns turns(outline);
    std::vector<Vec2> places;
    for (py::ssize_t i = 0; i < line.shape(0); ++i)
      places.push_back({line.data()[2 * i], line.data()[2 * i + 1]});
    turns.apply(places);
    ARETE_TRY(const auto ground, terrain.at(wantedAlong({&places, 1}, *earth, outline), context));
    const TerrainModel& model = ground->model;
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
    const Vec2 xy = outline.toSource(v.plan);
    part += !v.isJoined;
    distances.mutable_data()[i] = v.distance;
    heights.mutable_data()[i] = v.height;
    parts.mutable_data()[i] = part;
    places.mutable_data()[2 * i] = xy.x;
    places.mutable_data()[2 * i + 1] = xy.y;
  }
  return py::make_tuple(distances, places, heights, parts, found.length, found.gapMetres);
}

py::dict measureMesh(const Terrain& terrain, const Doubles& vertices, const Indices& triangles,
                     const std::optional<AskedRegion>& region, const py::object& progress) {
  Warnings warnings;
  const MeasureReport report = call(progress, [&](const RunContext& context) -> Result<MeasureReport> {
    const TriangleMesh mesh = meshOf(vertices, triangles);
    ARETE_TRY(const auto all, terrain.whole(context));
    const TerrainModel& model = all->model;
    const auto against = [&](const auto& samples) -> Result<MeasureReport> {
      std::vector<std::uint8_t> mask;
      if (region) {
        ARETE_TRY(mask, samplesIn(*region, samples, warnings, context));
      }
      MeasureOptions options;
      options.mask = mask;
      return measure(mesh, samples, options, context);
    };
    return model.isRaster ? against(model.rasterSamples()) : against(model.pointSamples());
  });
  warn(warnings);
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
  terrain
      .def("los",
           [](const Terrain& self, const Doubles& from, const Doubles& to, double maxError,
              const std::string& earth, std::optional<double> refraction, const std::string& nodata,
              const std::string& method, double frequency, const std::string& clutter, double clutterFree,
              const py::object& progress) {
             return los(self, from, to,
                        {{earth, nodata, refraction}, maxError, frequency, clutterFree, method, clutter},
                        progress);
           })
      .def("profile", &profile)
      .def("sight_over", &sightOver)
      .def("measure", &measureMesh);
  defineViewshed(terrain);
}

}  // namespace arete::python

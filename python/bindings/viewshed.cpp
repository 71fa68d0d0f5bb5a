// SPDX-License-Identifier: GPL-3.0-or-later
#include "python/bindings/viewshed.h"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/counted.h"
#include "io/geo/crs/longitude_turns.h"
#include "io/geo/dem/placed_grid.h"
#include "io/query/parts/asked_places.h"
#include "python/bindings/arrays.h"
#include "python/bindings/calls.h"
#include "python/bindings/sight.h"
#include "terrain/viewshed/many.h"
#include "terrain/viewshed/viewshed.h"

namespace arete::python {
namespace {

namespace py = pybind11;

/// What viewshed() takes beside its observers.
struct ViewshedRequest {
  SightRequest sight;
  double targetHeight = 0, radius = std::numeric_limits<double>::infinity(), minDistance = 0, maxError = 0;
  std::optional<std::array<double, 2>> azimuth, elevation;
  std::string mode = "seen", method = "auto", like;
};

Result<ViewshedField> fieldOf(const ViewshedRequest& request) {
  ViewshedField field;
  field.leastMetres = request.minDistance;
  field.greatestMetres = request.radius;
  if (!(request.minDistance <= request.radius))
    return failure(ErrorCode::usage, "is beyond the radius",
                   fmt::format("min_distance={}", request.minDistance));
  if (request.azimuth) {
    const auto [from, to] = *request.azimuth;
    const auto turned = [](double v) { return v - 360 * std::floor(v / 360); };
    if (!std::isfinite(from + to)) return failure(ErrorCode::usage, "is not finite", "azimuth");
    field.fromAzimuth = turned(from);
    field.azimuthSpan = to - from >= 360 ? 360 : turned(to - from);
    if (!(field.azimuthSpan > 0))
      return failure(ErrorCode::usage, "is an empty field of view: the two must differ", "azimuth");
  }
  if (request.elevation) {
    const auto [low, high] = *request.elevation;
    if (!(low <= high && low >= -90 && high <= 90))
      return failure(ErrorCode::usage, "must be two angles from -90 to 90, the lower first", "elevation");
    field.lowest = low;
    field.highest = high;
  }
  return field;
}

Result<ViewshedOptions> viewshedOptionsOf(const ViewshedRequest& request) {
  ViewshedOptions options;
  options.targetHeight = request.targetHeight;
  options.maxError = request.maxError;
  ARETE_TRY(options.nodata, nodataOf(request.sight));
  ARETE_TRY(options.field, fieldOf(request));
  if (request.mode == "height")
    options.value = ViewshedValue::leastHeight;
  else if (request.mode == "horizon")
    options.value = ViewshedValue::horizon;
  else if (request.mode != "seen" && request.mode != "count" && request.mode != "server")
    return failure(ErrorCode::usage, "is not one of seen, height, horizon, count, server",
                   "mode=" + request.mode);
  if (request.method == "sweep")
    options.method = ViewshedMethod::sweep;
  else if (request.method == "rays")
    options.method = ViewshedMethod::rays;
  else if (request.method != "auto")
    return failure(ErrorCode::usage, "is not one of auto, sweep, rays", "method=" + request.method);
  if (request.method == "sweep" && request.maxError > 0)
    return failure(ErrorCode::usage, "cannot be combined with max_error", "method=sweep");
  return options;
}

struct ViewshedAnswer {
  std::vector<ViewshedCell> cells;
  std::vector<float> values;          // of heights and horizons
  std::vector<std::uint16_t> number;  // of counts and servers
  std::uint32_t columns = 0, rows = 0;
  Georeference georeference;
  std::uint64_t withoutLine = 0;
};

Result<ViewshedAnswer> answerOf(const Terrain& terrain, const std::vector<std::array<double, 3>>& observers,
                                const ViewshedRequest& request, Warnings& warnings,
                                const RunContext& context) {
  const TerrainModel& outline = terrain.outline();
  ARETE_TRY(const auto earth, makeEarth(request.sight, outline));
  ARETE_TRY(ViewshedOptions options, viewshedOptionsOf(request));
  const LongitudeTurns turns(outline);
  std::vector<AskedRange> ranges;
  if (terrain.isInParts())
    for (const auto& [x, y, height] : observers) ranges.push_back({turns({x, y}), request.radius});
  ARETE_TRY(const RequiredError wanted, wantedInRange(ranges, *earth, outline, std::nullopt, context));
  ARETE_TRY(const auto ground, terrain.at(wanted, context));
  const TerrainModel& model = ground->model;
  std::vector<ViewshedSite> sites;
  for (std::size_t i = 0; i < observers.size(); ++i) {
    const std::string name = observers.size() == 1 ? "observer" : fmt::format("observer {}", i);
    ARETE_TRY(const auto end, endOf(*ground, turns, observers[i].data(), name));
    sites.push_back({{end.first, end.second}, options.field});
  }
  ARETE_TRY(const auto maker, ViewshedMaker::make(model, *earth, {}, context));
  const bool isOfOne = sites.size() == 1 && request.mode != "count" && request.mode != "server";
  if (!isOfOne && options.value != ViewshedValue::none)
    return failure(ErrorCode::usage, fmt::format("requires one observer, not {}", sites.size()),
                   "mode=" + request.mode);
  if (!isOfOne && !request.like.empty())
    return failure(ErrorCode::usage, "requires a single observer, and no mode count or server", "like");
  ViewshedAnswer answer;
  answer.columns = model.columns;
  answer.rows = model.rows;
  answer.georeference = model.georeference;
  if (!isOfOne) {
    ARETE_TRY(auto all,
              viewshedOfMany(maker, model, *earth, sites, options, request.mode == "server", context));
    answer.cells = std::move(all.cells);
    if (request.mode == "count") answer.number = std::move(all.count);
    if (request.mode == "server") answer.number = std::move(all.server);
    answer.withoutLine = all.withoutLine;
    return answer;
  }
  Viewshed seen;
  if (request.like.empty()) {
    ARETE_TRY(seen, maker.from(sites.front().observer, options, context));
  } else {
    ARETE_TRY(const PlacedGrid grid, readPlacedGrid(request.like, model, warnings, context));
    ARETE_TRY(seen, maker.of(grid.places, sites.front().observer, options, context));
    answer.columns = grid.columns;
    answer.rows = grid.rows;
    answer.georeference = grid.georeference;
  }
  answer.cells = std::move(seen.cells);
  answer.values = std::move(seen.values);
  answer.withoutLine = seen.withoutLine;
  return answer;
}

/// The cells of a grid, without a first column that is repeated.
template <class Number, class ValueOf>
py::array cellsOf(const ViewshedAnswer& answer, const ValueOf& valueOf) {
  const std::uint32_t columns = answer.columns - (answer.georeference.repeatsFirstColumn ? 1 : 0);
  py::array_t<Number> cells(
      std::vector<py::ssize_t>{static_cast<py::ssize_t>(answer.rows), static_cast<py::ssize_t>(columns)});
  Number* to = cells.mutable_data();
  for (std::size_t row = 0; row < answer.rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) *to++ = valueOf(row * answer.columns + column);
  return cells;
}

/// The cells, and where their grid lies: GDAL's six numbers or None, and the CRS.
py::tuple viewshed(const Terrain& terrain, const std::vector<std::array<double, 3>>& observers,
                   const ViewshedRequest& request, const py::object& progress) {
  Warnings warnings;
  const ViewshedAnswer answer = call(progress, [&](const RunContext& context) {
    return answerOf(terrain, observers, request, warnings, context);
  });
  if (answer.withoutLine > 0)
    warnings.push_back({WarningCode::omitted,
                        fmt::format("{} passes a pole or a seam of the CRS",
                                    counted(answer.withoutLine, "sample is unknown: the shortest way to it",
                                            "samples are unknown: the shortest way to them"))});
  warn(warnings);
  const auto isOutside = [&](std::size_t i) { return answer.cells[i] == ViewshedCell::outside; };
  py::array cells;
  if (request.mode == "seen")
    cells = cellsOf<std::uint8_t>(answer, [&](std::size_t i) { return byteOf(answer.cells[i]); });
  else if (!answer.number.empty())
    cells = cellsOf<std::uint16_t>(
        answer, [&](std::size_t i) { return isOutside(i) ? std::uint16_t{65535} : answer.number[i]; });
  else
    cells = cellsOf<float>(answer, [&](std::size_t i) {
      if (isOutside(i)) return std::numeric_limits<float>::quiet_NaN();
      const double value = answer.values[i];
      return static_cast<float>(request.mode == "horizon" ? std::atan(value) * 180 / std::numbers::pi
                                                          : value);
    });
  const Georeference& g = answer.georeference;
  return py::make_tuple(cells, g.hasGeoTransform ? py::cast(g.geoTransform) : py::none(), g.crsWkt);
}

}  // namespace

void defineViewshed(py::class_<Terrain, std::shared_ptr<Terrain>>& terrain) {
  terrain.def(
      "viewshed",
      [](const Terrain& self, const std::vector<std::array<double, 3>>& observers, double targetHeight,
         double radius, double minDistance, std::optional<std::array<double, 2>> azimuth,
         std::optional<std::array<double, 2>> elevation, const std::string& mode, const std::string& like,
         double maxError, const std::string& method, const std::string& earth,
         std::optional<double> refraction, const std::string& nodata, const py::object& progress) {
        return viewshed(self, observers,
                        {.sight = {earth, nodata, refraction},
                         .targetHeight = targetHeight,
                         .radius = radius,
                         .minDistance = minDistance,
                         .maxError = maxError,
                         .azimuth = azimuth,
                         .elevation = elevation,
                         .mode = mode,
                         .method = method,
                         .like = like},
                        progress);
      });
}

}  // namespace arete::python

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The outline of the model places the observers; the places and radii say which part of the file is read;
// then one viewshed, or the viewsheds of many combined cell by cell, become a GeoTIFF.
#include "cli/sight/viewshed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cli/arguments/arguments.h"
#include "cli/arguments/place_hint.h"
#include "cli/arguments/terrain_error.h"
#include "cli/session/model_file.h"
#include "cli/sight/arguments.h"
#include "cli/sight/viewshed_arguments.h"
#include "cli/sight/viewshed_picture.h"
#include "cli/sight/viewshed_png.h"
#include "io/files/output_file.h"
#include "io/files/text_scan.h"
#include "io/geo/crs/data_unit.h"
#include "io/geo/crs/longitude_turns.h"
#include "io/geo/crs/position_argument.h"
#include "io/geo/dem/placed_grid.h"
#include "io/geo/dem/raster_writer.h"
#include "io/geo/polygons/polygon_file.h"
#include "io/geo/table/sight_pairs.h"
#include "io/query/parts/asked_places.h"
#include "io/store/amt/file.h"
#include "terrain/sight/paths.h"
#include "terrain/viewshed/many.h"
#include "terrain/viewshed/viewshed.h"

namespace arete {
namespace {

using Mode = ViewshedMode;

constexpr const char* kPolygonLayer = "viewshed";

/// Applies the columns of a site (range, azimuth, beamwidth), which come before the options.
Status aim(ViewshedField& field, const SightBeam& beam) {
  if (std::isfinite(beam.range)) {
    if (!(beam.range > 0)) return failure(ErrorCode::invalidData, "has a range that is not above 0");
    if (beam.range < field.leastMetres)
      return failure(ErrorCode::invalidData,
                     fmt::format("has a range below --min-distance {}", field.leastMetres));
    field.greatestMetres = beam.range;
  }
  if (!std::isfinite(beam.beamwidth)) return {};
  if (beam.beamwidth > 360)
    return failure(ErrorCode::invalidData, fmt::format("has a beamwidth of {:g}, above 360", beam.beamwidth));
  if (!(beam.beamwidth > 0)) return failure(ErrorCode::invalidData, "has a beamwidth that is not above 0");
  if (!std::isfinite(beam.azimuth)) return {};
  const double from = beam.azimuth - beam.beamwidth / 2;
  field.fromAzimuth = from - 360 * std::floor(from / 360);
  field.azimuthSpan = beam.beamwidth;
  return {};
}

/// Warns of columns that say nothing: a radius, which is called range, and half a beam.
void warnOfIdleColumns(const SightPairs& sites, const std::string& file, const Session& session) {
  std::size_t azimuths = 0, widths = 0, ranges = 0;
  for (const SightBeam& beam : sites.beams) {
    const bool hasAzimuth = std::isfinite(beam.azimuth), hasWidth = std::isfinite(beam.beamwidth);
    azimuths += hasAzimuth && !hasWidth ? 1 : 0;
    widths += hasWidth && !hasAzimuth && beam.beamwidth < 360 ? 1 : 0;
    ranges += std::isfinite(beam.range) ? 1 : 0;
  }
  const auto warn = [&](const std::string& sentence) {
    session.warn({{WarningCode::omitted, sentence}}, file);
  };
  if (azimuths > 0)
    warn(fmt::format("azimuth is not used in {} without a beamwidth", grouped(azimuths, "row", "rows")));
  if (widths > 0)
    warn(fmt::format("beamwidth is not used in {} without an azimuth", grouped(widths, "row", "rows")));
  const auto isRadius = [](const auto& column) { return text::lowered(column.name) == "radius"; };
  if (ranges == 0 && std::ranges::any_of(sites.attributes.columns, isRadius))
    warn("the column radius is not used; the largest distance of a row is named range");
}

/// An observer whose height above the terrain is not yet resolved.
struct PlacedObserver {
  PositionArgument position;
  ViewshedField field;
  std::string culprit;  // the row of a file, or the option
  bool isOfFile = false;
};

/// Reads the observers. `outline`: of the model, its root at least. Errors: usage, invalidData, naming the
/// option or the row.
Result<std::vector<PlacedObserver>> placeObservers(const ViewshedArguments& a, const ViewshedField& field,
                                                   const TerrainModel& outline, Session& session) {
  std::vector<PlacedObserver> observers;
  ARETE_TRY(const auto toDem, transformOfPlaces(a.sight.lonLat, outline));
  const DataUnit unit = heightUnitOf(outline.georeference);
  for (const std::string& text : a.observers.typed) {
    ARETE_TRY(const auto position, readPositionArgument("--observer", text, toDem, &unit));
    const std::string culprit = "--observer " + text;
    const std::string hint = a.sight.lonLat ? std::string() : degreesHint(position.xy, outline);
    if (!hint.empty() && position.kind == HeightKind::aboveGround)
      return failure(ErrorCode::invalidData, "lies outside the DEM: " + hint, culprit);
    if (!hint.empty()) session.warn(fmt::format("{} lies outside the DEM: {}", culprit, hint));
    observers.push_back({position, field, culprit});
  }
  if (a.observers.file.empty()) return observers;
  std::optional<StatedHeight> usual;
  if (!a.observers.usualHeight.empty()) {
    const auto height = readHeightText(a.observers.usualHeight, &unit);
    if (!height)
      return failure(height.error().code, height.error().message,
                     "--observer-height " + a.observers.usualHeight);
    usual = *height;
  }
  ARETE_TRY(const auto sites,
            readSightSites(inputPath(a.observers.file), outline.georeference,
                           {.layer = a.observers.layer, .lonLat = a.sight.lonLat}, session.context()));
  session.warn(sites.warnings, a.observers.file);
  warnOfIdleColumns(sites, a.observers.file, session);
  const LongitudeTurns turns(outline);
  for (std::size_t i = 0; i < sites.rows.size(); ++i) {
    SightSite site = sites.rows[i][0];
    site.xy = turns(site.xy);
    const std::string culprit = fmt::format("{}, row {}", a.observers.file, i + 1);
    if (!std::isfinite(site.stated.x + site.stated.y))
      return failure(ErrorCode::invalidData, "has no coordinates", culprit);
    if (!std::isfinite(site.xy.x + site.xy.y))
      return failure(ErrorCode::invalidData, "has a place that cannot be expressed in the DEM's CRS",
                     culprit);
    const auto height = site.height ? site.height : usual;
    if (!height) return failure(ErrorCode::usage, "has no height; --observer-height sets one", culprit);
    observers.push_back({{site.xy, height->height, height->kind}, field, culprit, true});
    if (Status turned = aim(observers.back().field, sites.beams[i]); !turned)
      return failure(turned.error().code, turned.error().message, culprit);
  }
  return observers;
}

/// The part of the model within range of an observer, and of a map all of its ground; all of the model where
/// an observer has no limit, or the map is on another grid. Errors: interrupted.
Result<RequiredError> wantedFor(const ViewshedArguments& a, std::span<const PlacedObserver> observers,
                                const SightEarth& earth, const TerrainModel& outline,
                                const RunContext& context) {
  if (!a.png.empty() && !a.like.empty()) return RequiredError();
  std::vector<AskedRange> ranges;
  for (const PlacedObserver& observer : observers)
    ranges.push_back({observer.position.xy, observer.field.greatestMetres});
  constexpr double kMapMargin = 0.08;  // more than that of the map
  return wantedInRange(ranges, earth, outline, a.png.empty() ? std::nullopt : std::optional(kMapMargin),
                       context);
}

/// Resolves the observers' heights on the model.
Result<std::vector<ViewshedSite>> sitesOf(std::span<const PlacedObserver> observers,
                                          const TerrainModel& model) {
  const GroundHeights heights(model);
  std::vector<ViewshedSite> sites;
  for (const PlacedObserver& observer : observers) {
    const auto height = demHeight(observer.position, heights);
    // A typed observer is named by its option, one of a file by its row and its position.
    if (!height && !observer.isOfFile)
      return failure(height.error().code, height.error().message, observer.culprit);
    if (!height)
      return failure(height.error().code,
                     height.error().message + behindSemicolon(degreesHint(observer.position.xy, model)),
                     fmt::format("{}: {}", observer.culprit, height.error().culprit));
    sites.push_back({{sightPlan(model, observer.position.xy), *height}, observer.field});
  }
  return sites;
}

/// Everything a viewshed is computed from.
struct Question {
  const ViewshedArguments& arguments;
  const TerrainModel& model;
  const SightEarth& earth;
  const ViewshedOptions& options;
  std::span<const ViewshedSite> observers;
  const TerrainError& maxError;

  bool isOfOne() const { return arguments.isOfOne(observers.size()); }
};

/// The grid of the answer: the DEM's own, without places, or that of --like.
Result<PlacedGrid> gridOf(const Question& q, Session& session) {
  const ViewshedArguments& a = q.arguments;
  if (a.like.empty()) return PlacedGrid{q.model.columns, q.model.rows, q.model.georeference, {}};
  if (!q.isOfOne())
    return failure(ErrorCode::usage, "requires a single observer, and no --mode count or server", "--like");
  Warnings warnings;
  auto grid = readPlacedGrid(a.like, q.model, warnings, session.context());
  session.warn(warnings, a.like);
  if (!grid && grid.error().code == ErrorCode::usage) grid.error().culprit = "--like " + a.like;
  return grid;
}

struct ViewshedAnswer {
  ViewshedPicture picture;
  std::vector<ViewshedCell> cells;
  std::uint64_t withoutLine = 0;
};

Result<ViewshedAnswer> answerOne(const Question& q, const ViewshedMaker& maker, const PlacedGrid& grid,
                                 const RunContext& context, Json& json) {
  ViewshedOptions options = q.options;
  options.field = q.observers.front().field;
  const ViewshedObserver& observer = q.observers.front().observer;
  ARETE_TRY(auto viewshed, q.arguments.like.empty() ? maker.from(observer, options, context)
                                                    : maker.of(grid.places, observer, options, context));
  // The answers of this mode are its heights: none is known where a number is missing.
  if (q.arguments.mode == Mode::height)
    for (std::size_t i = 0; i < viewshed.cells.size(); ++i)
      if (viewshed.cells[i] != ViewshedCell::outside && std::isnan(viewshed.values[i]))
        viewshed.cells[i] = ViewshedCell::unknown;
  json["method"] = std::string(toString(viewshed.method));
  json["rays"] = viewshed.rays;
  return ViewshedAnswer{viewshedPictureOfOne(q.arguments.mode, viewshed), std::move(viewshed.cells),
                        viewshed.withoutLine};
}

Result<ViewshedAnswer> answerMany(const Question& q, const ViewshedMaker& maker, const RunContext& context) {
  const Mode mode = q.arguments.mode;
  ARETE_TRY(auto all,
            viewshedOfMany(maker, q.model, q.earth, q.observers, q.options, mode == Mode::server, context));
  return ViewshedAnswer{viewshedPictureOfMany(mode, all), std::move(all.cells), all.withoutLine};
}

/// What leaves no sample to answer for: a radius below the spacing of the samples, or the options together.
std::string whyNoSample(const Question& q) {
  const ViewshedArguments& a = q.arguments;
  if (!a.like.empty())
    return fmt::format("no cell of {} is on the terrain and within the field of view", a.like);
  double radius = 0;
  for (const ViewshedSite& site : q.observers) radius = std::max(radius, site.field.greatestMetres);
  const Vec2 plan = q.observers.front().observer.plan;
  const Vec2 step = groundStep(q.model.georeference, plan.x, plan.y);
  const std::string unit = q.model.georeference.crsWkt.empty() ? "" : " m";
  if (radius < std::max(step.x, step.y))
    return fmt::format(
        "no sample is within the radius of {:g}{}: it is in metres, and the samples are {:.4g} x {:.4g}{} "
        "apart",
        radius, unit, step.x, step.y, unit);
  std::string options;
  const auto add = [&](const char* option, bool isStated) {
    if (isStated) options += (options.empty() ? ": " : ", ") + std::string(option);
  };
  add("--radius", std::isfinite(a.fieldOfView.greatestMetres));
  add("--min-distance", a.fieldOfView.leastMetres > 0);
  add("--azimuth", !a.fieldOfView.azimuths.empty());
  add("--elevation", !a.fieldOfView.elevations.empty());
  return "no sample is within the field of view" + options;
}

/// Reports how many cells have which answer.
void reportCounts(const Question& q, const std::vector<ViewshedCell>& cells, const PlacedGrid& grid,
                  Json json, Session& session) {
  const ViewshedArguments& a = q.arguments;
  const auto count = [&](ViewshedCell which) {
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (cells[i] == which && !(grid.georeference.repeatsFirstColumn && (i + 1) % grid.columns == 0))
        ++number;
    return number;
  };
  const std::uint64_t seen = count(ViewshedCell::seen), hidden = count(ViewshedCell::hidden),
                      unknown = count(ViewshedCell::unknown), undecided = count(ViewshedCell::undecided);
  if (seen + hidden + unknown + undecided == 0)
    session.warn({{WarningCode::omitted, whyNoSample(q)}}, !a.output.empty() ? a.output
                                                           : !a.png.empty()  ? a.png
                                                                             : a.polygons);
  json["seen"] = seen;
  json["hidden"] = hidden;
  json["unknown"] = unknown;
  json["undecided"] = undecided;
  json["outside"] = count(ViewshedCell::outside);
  if (!a.output.empty()) json["file"] = a.output;
  std::string text = fmt::format("{}: {} seen, {} hidden, {} unknown", a.output.empty() ? a.model : a.output,
                                 grouped(seen, "sample", "samples"), grouped(hidden), grouped(unknown));
  if (undecided > 0) text += fmt::format(", {} undecided", grouped(undecided));
  text += q.maxError.shareText(q.model.georeference.verticalUnit);
  text += "\n";
  if (json.contains("picture")) text += a.png + ": the same as a map\n";
  if (json.contains("polygons"))
    text += fmt::format("{}: {}\n", a.polygons,
                        grouped(json["polygons"]["count"].get<std::uint64_t>(), "polygon", "polygons"));
  session.say(text);
  session.answer(json);
}

/// Writes the raster, the picture and the polygons that are asked for: all of them appear or none does.
Status writeAnswer(const Question& q, const ViewshedMaker& maker, ViewshedAnswer& answer,
                   const PlacedGrid& grid, Json& json, Session& session) {
  const ViewshedArguments& a = q.arguments;
  ViewshedPicture& picture = answer.picture;
  OutputGroup group;
  if (!a.png.empty()) {
    ARETE_CHECK(writeViewshedPng(
        {a, q.model, maker, q.options, q.observers, grid, answer.cells, picture.values, q.maxError}));
    json["picture"] = a.png;
  }
  if (!a.output.empty())
    ARETE_CHECK(writeGeoTiff(a.output, grid.columns, grid.rows, picture.values, grid.georeference,
                             picture.options, session.context()));
  if (!a.polygons.empty()) {
    // Cells without an answer are in no polygon; the column that a raster around the Earth repeats is left
    // out.
    std::ranges::replace(picture.values, picture.options.nodata, std::nan(""));
    const std::uint32_t columns =
        grid.georeference.repeatsFirstColumn && grid.columns > 1 ? grid.columns - 1 : grid.columns;
    ARETE_TRY(const PolygonReport report,
              writePolygons(a.polygons, {columns, grid.rows, picture.values, grid.columns}, grid.georeference,
                            viewshedPolygonFields(a.mode, kPolygonLayer), a.existing, session.context()));
    json["polygons"] = {{"file", a.polygons}, {"layer", kPolygonLayer}, {"count", report.polygons}};
    if (!report.hasAreas)
      session.note(fmt::format("{}: areas are left out, since no CRS says what the ground is", a.polygons));
  }
  return group.commit();
}

/// The observers and their fields of view, in the order of their numbers.
Json sitesJson(const Question& q) {
  Json sites = Json::array();
  for (const auto& [observer, field] : q.observers) {
    const Vec2 place = q.model.toSource(observer.plan);
    sites.push_back({{"x", place.x},
                     {"y", place.y},
                     {"height", observer.height},
                     {"radius", std::isfinite(field.greatestMetres) ? Json(field.greatestMetres) : Json()},
                     {"minDistance", field.leastMetres},
                     {"fromAzimuth", field.fromAzimuth},
                     {"azimuthSpan", field.azimuthSpan},
                     {"elevation", {field.lowest, field.highest}}});
  }
  return sites;
}

Status answer(const Question& q, Session& session) {
  const ViewshedArguments& a = q.arguments;
  if (!q.model.isRaster)
    return failure(ErrorCode::usage, "a viewshed requires a raster; this model is made of points", a.model);
  ARETE_TRY(const auto maker, ViewshedMaker::make(q.model, q.earth, {}, session.context()));
  ARETE_TRY(auto grid, gridOf(q, session));
  Json json = {{"model", a.model},
               {"mode", std::string(toString(a.mode))},
               {"observers", q.observers.size()},
               {"sites", session.wantsAnswer() ? sitesJson(q) : Json()},
               {"targetHeight", q.options.targetHeight},
               {"earth", a.sight.earthName(q.model)},
               {"refraction", a.sight.refractionJson(q.model)},
               {"nodata", std::string(toString(a.sight.nodata))}};
  q.maxError.addTo(json);
  if (!a.like.empty()) json["like"] = a.like;
  auto made = q.isOfOne() ? answerOne(q, maker, grid, session.context(), json)
                          : answerMany(q, maker, session.context());
  // The sweep does not support every question: another value of the option does.
  if (!made && made.error().code == ErrorCode::unsupported && a.method == ViewshedMethod::sweep)
    return failure(ErrorCode::usage, made.error().message, "--method sweep");
  if (!made) return tl::unexpected(made.error());
  json["withoutLine"] = made->withoutLine;
  if (made->withoutLine > 0)
    session.warn(fmt::format("{} passes a pole or a seam of the CRS, and is no line on the map",
                             grouped(made->withoutLine, "sample is unknown: the shortest way to it",
                                     "samples are unknown: the shortest way to them")));
  grid.georeference.verticalUnit = made->picture.isHeight ? q.model.georeference.verticalUnit : "";
  ARETE_CHECK(writeAnswer(q, maker, *made, grid, json, session));
  reportCounts(q, made->cells, grid, std::move(json), session);
  return {};
}

Status runViewshed(const ViewshedArguments& a, Session& session) {
  ARETE_CHECK(a.check());
  ARETE_TRY(auto options, a.options());
  ARETE_TRY(const AmtFile file, openTerrain(a.model));
  ARETE_TRY(const TerrainModel outline, outlineOf(file, session.context()));
  ARETE_CHECK(
      checkGroundUnits(outline.georeference, {a.fieldOfView.greatestWithUnit, a.fieldOfView.leastWithUnit}));
  ARETE_TRY(options.targetHeight, lengthOf("--target-height", a.targetHeight, outline.georeference));
  const std::vector<std::string> inputs = {a.model, a.observers.file, a.like, outline.source};
  if (!a.output.empty()) ARETE_CHECK(checkOutput("--output", a.output, inputs));
  if (!a.polygons.empty()) ARETE_CHECK(checkOutput("--polygons", a.polygons, inputs, {a.output}));
  if (!a.png.empty()) ARETE_CHECK(checkOutput("--png", a.png, inputs, {a.output, a.polygons}));
  ARETE_TRY(const TerrainError maxError, terrainErrorOf(a.maxError, file, session));
  options.maxError = maxError.value;
  ARETE_TRY(const auto placed, placeObservers(a, options.field, outline, session));
  if (!a.isOfOne(placed.size()) && (a.mode == Mode::height || a.mode == Mode::horizon))
    return failure(ErrorCode::usage, fmt::format("requires one observer, not {}", placed.size()),
                   a.mode == Mode::height ? "--mode height" : "--mode horizon");
  ARETE_TRY(const auto earth, a.sight.makeEarth(outline, session));
  ARETE_TRY(const auto wanted, wantedFor(a, placed, *earth, outline, session.context()));
  ARETE_TRY(const TerrainModel model, readWanted(file, outline, wanted, session.context()));
  ARETE_TRY(const auto observers, sitesOf(placed, model));
  return answer({a, model, *earth, options, observers, maxError}, session);
}

}  // namespace

void addViewshedCommand(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<ViewshedArguments>();
  CLI::App* command = session.addCommand(
      app, "viewshed", "Compute what is visible from one or more places",
      "  arete viewshed dem.amt --observer 409050,3801450,10 --target-height 2 --radius 20000 -o seen.tif\n"
      "  arete viewshed dem.amt --observer 409050,3801450,10 --mode height -o least_height.tif\n"
      "  arete viewshed dem.amt --observers masts.gpkg --observer-height 30 --mode count -o count.tif\n"
      "  arete viewshed dem.amt --observer 409050,3801450,10 --polygons seen.gpkg\n"
      "  arete viewshed dem.amt --observer 409050,3801450,10 --radius 8000 --png seen.png\n"
      "\n"
      "A raster on the grid of the DEM, or of another raster (--like). seen: 255 seen, 0 hidden, 100 "
      "unknown\n"
      "(NODATA in between), 200 undecided (--max-error), 1 = NODATA: no sample, too far, out of the field "
      "of\n"
      "view. Every sample has the answer that arete los gives for it. count, server: 65533 unknown, 65534\n"
      "undecided, 65535 = NODATA. height: infinite where nothing would be seen, NODATA where it is unknown.",
      [arguments](Session& s) { return runViewshed(*arguments, s); });
  arguments->addTo(*command);
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// A row becomes a path if both of its ends have coordinates and a height; else it keeps the reason. Answers
// are per path, texts and columns per row.
#include "cli/sight/rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cli/arguments/arguments.h"
#include "cli/session/option_names.h"
#include "cli/sight/arguments.h"

namespace arete {
namespace {

Result<SightPath> pathOf(const std::array<SightSite, 2>& row, const GroundHeights& heights,
                         const std::array<std::string, 2>& typed) {
  constexpr const char* kEnds[2] = {"the first end", "the second end"};
  constexpr const char* kOptions[2] = {"--observer-height", "--target-height"};
  SightPath path;
  for (int end = 0; end < 2; ++end) {
    const SightSite& site = row[end];
    if (!std::isfinite(site.xy.x + site.xy.y) && !std::isfinite(site.stated.x + site.stated.y))
      return failure(ErrorCode::invalidData, "has no coordinates", kEnds[end]);
    if (!std::isfinite(site.xy.x + site.xy.y))
      return failure(ErrorCode::invalidData, "has a place that cannot be expressed in the DEM's CRS",
                     kEnds[end]);
    if (!site.height)
      return failure(ErrorCode::usage, fmt::format("has no height; {} sets one", kOptions[end]), kEnds[end]);
    auto found = demHeight({site.xy, site.height->height, site.height->kind}, heights);
    if (!found && !typed[end].empty()) found.error().culprit = typed[end];
    ARETE_TRY(const double height, std::move(found));
    (end == 0 ? path.from : path.to) = sightPlan(heights.model(), site.xy);
    (end == 0 ? path.fromHeight : path.toHeight) = height;
  }
  return path;
}

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.12g}", value) : std::string();
}

Json numberOrNull(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

}  // namespace

SightRows SightRows::of(const SightPairs& pairs, const GroundHeights& heights,
                        const std::array<std::string, 2>& typed) {
  SightRows all;
  all.rows.reserve(pairs.rows.size());
  // A row without a path keeps its place, so that texts and tables have an entry for every row of the file.
  for (const auto& row : pairs.rows) {
    auto path = pathOf(row, heights, typed);
    if (path) {
      all.rows.push_back({all.paths.size(), std::nullopt});
      all.paths.push_back(*path);
    } else {
      all.rows.push_back({0, std::move(path.error())});
    }
  }
  return all;
}

double depthBelowGround(Vec2 plan, double height, const GroundHeights& heights) {
  const auto ground = heights.at(heights.model().toSource(plan));
  if (!ground) return std::nan("");
  const double below = ground->height - height;
  // A place on the ground is there but for rounding.
  return below > 1e-9 * std::max(1.0, std::abs(ground->height)) ? below : 0;
}

SightMethod bestMethod(SightMethod asked, double maxError, std::size_t lines, const TerrainModel& model) {
  return asked == SightMethod::automatic ? methodFor(lines, maxError, model) : asked;
}

std::string SightCounts::text() const {
  std::string text =
      fmt::format("{} visible, {} blocked, {} unknown", grouped(visible), grouped(blocked), grouped(unknown));
  if (undecided > 0) text += fmt::format(", {} undecided", grouped(undecided));
  if (failed > 0) text += fmt::format(", {} without an answer", grouped(failed));
  return text;
}

const Error* SightResults::errorOf(std::size_t row) const {
  if (rows.rows[row].error) return &*rows.rows[row].error;
  const auto& answer = answers[rows.rows[row].path];
  return answer ? nullptr : &answer.error();
}

SightCounts SightResults::counts() const {
  SightCounts counts;
  // A row fails if it has no path, or if its path has no answer.
  for (std::size_t i = 0; i < rows.count(); ++i) {
    if (errorOf(i)) {
      ++counts.failed;
      continue;
    }
    switch (answerOf(i).sight.verdict) {
      case SightVerdict::visible:
        ++counts.visible;
        break;
      case SightVerdict::blocked:
        ++counts.blocked;
        break;
      case SightVerdict::unknown:
        ++counts.unknown;
        break;
      default:
        ++counts.undecided;
    }
  }
  return counts;
}

std::string SightResults::textOf(std::size_t row) const {
  const SightPathAnswer& a = answerOf(row);
  const std::string& unit = model.georeference.verticalUnit;
  const auto placeText = [&](const SightPlace& place) {
    const Vec2 xy = model.toSource(place.plan);
    return fmt::format("{:.10g},{:.10g}, {:.1f} m away", xy.x, xy.y, place.distance);
  };
  std::string text = fmt::format("{}{}\n", toString(a.sight.verdict), a.sight.isTouching ? ", touching" : "");
  text += fmt::format("distance     {:.3f} m\nazimuth      {:.6f} degrees\nelevation    {:.6f} degrees\n",
                      a.distanceMetres, a.azimuthDegrees, a.elevationDegrees);
  if (a.sight.clearance) {
    text +=
        fmt::format("clearance    {} at {}\n", withUnit(*a.sight.clearance, unit), placeText(a.sight.least));
    if (a.sight.clearanceWithin > 0)
      text += fmt::format("             within {}\n", withUnit(a.sight.clearanceWithin, unit));
  }
  // An obstruction without a terrain height is NODATA that counts as opaque.
  const std::string by = blockedBy.empty() ? std::string() : blockedBy[rows.rows[row].path];
  if (!by.empty()) text += fmt::format("blocked by   {}\n", by);
  if (a.sight.obstruction)
    text += fmt::format("obstruction  {} at {}\n",
                        !by.empty() && by != "terrain" && by != "nodata"
                            ? fmt::format("{} at {}", by, withUnit(a.sight.obstruction->terrainHeight, unit))
                        : std::isnan(a.sight.obstruction->terrainHeight)
                            ? "NODATA"
                            : "terrain of " + withUnit(a.sight.obstruction->terrainHeight, unit),
                        placeText(*a.sight.obstruction));
  if (a.sight.isObstructionLatest)
    text += "             of the approximate terrain; the first is there or nearer\n";
  if (a.sight.gapMetres > 0)
    text += fmt::format("no terrain   below {:.1f} m of the line\n", a.sight.gapMetres);
  if (a.fresnel)
    text += fmt::format("Fresnel zone {:.3f} of the first is clear ({} is required: {}), at {}\n",
                        a.fresnel->fraction, fresnel, isFresnelClear(a) ? "yes" : "no",
                        placeText(a.fresnel->place));
  else if (hasFresnel)
    text += "Fresnel zone no answer: an end is below the ground, or there is no terrain between the ends\n";
  return text;
}

Json SightResults::jsonOf(std::size_t row) const {
  const auto& [from, to] = pairs.rows[row];
  Json json = {{"from", {numberOrNull(from.stated.x), numberOrNull(from.stated.y)}},
               {"to", {numberOrNull(to.stated.x), numberOrNull(to.stated.y)}}};
  // A row without an answer still states its ends and the reason.
  if (const Error* error = errorOf(row)) {
    json["verdict"] = Json();
    json["error"] = withOptionNames(*error).describe();
    return json;
  }
  const SightPathAnswer& a = answerOf(row);
  const SightPath& path = rows.paths[rows.rows[row].path];
  const auto placeJson = [&](const SightPlace& place) {
    const Vec2 xy = model.toSource(place.plan);
    return Json{{"x", xy.x},
                {"y", xy.y},
                {"distance", place.distance},
                {"terrainHeight", numberOrNull(place.terrainHeight)},
                {"lineHeight", place.sightHeight}};
  };
  json["fromHeight"] = path.fromHeight;
  json["toHeight"] = path.toHeight;
  json["verdict"] = std::string(toString(a.sight.verdict));
  json["touching"] = a.sight.isTouching;
  json["distance"] = a.distanceMetres;
  json["azimuth"] = a.azimuthDegrees;
  json["elevation"] = a.elevationDegrees;
  json["clearance"] = a.sight.clearance ? Json(*a.sight.clearance) : Json();
  json["clearanceWithin"] = a.sight.clearanceWithin;
  json["least"] = a.sight.clearance ? placeJson(a.sight.least) : Json();
  json["obstruction"] = a.sight.obstruction ? placeJson(*a.sight.obstruction) : Json();
  if (a.sight.obstruction) json["obstruction"]["approximate"] = a.sight.isObstructionLatest;
  if (!blockedBy.empty()) {
    const std::string& by = blockedBy[rows.rows[row].path];
    json["blockedBy"] = by.empty() ? Json() : Json(by);
  }
  json["gap"] = a.sight.gapMetres;
  json["visited"] = a.sight.visited;
  if (hasFresnel) {
    json["fresnel"] = a.fresnel ? Json(a.fresnel->fraction) : Json();
    json["fresnelAt"] = a.fresnel ? placeJson(a.fresnel->place) : Json();
    json["fresnelClear"] = isFresnelClear(a);
  }
  return json;
}

PointAttributes SightResults::columns() const {
  using Kind = PointAttributes::Kind;
  PointAttributes table;
  // The options alone decide which columns there are; a row without an answer leaves most of them empty.
  for (const char* name : {"x1", "y1", "height1", "x2", "y2", "height2"})
    table.columns.push_back({name, Kind::real});
  table.columns.push_back({"verdict", Kind::text});
  for (const char* name :
       {"distance", "azimuth", "elevation", "clearance", "clearance_within", "obstruction_x", "obstruction_y",
        "obstruction_height", "obstruction_distance", "gap"})
    table.columns.push_back({name, Kind::real});
  if (!blockedBy.empty()) table.columns.push_back({"blocked_by", Kind::text});
  if (hasTolerance) table.columns.push_back({"obstruction_approximate", Kind::integer});
  table.columns.push_back({"visited", Kind::integer});
  if (hasFresnel) {
    table.columns.push_back({"fresnel", Kind::real});
    table.columns.push_back({"fresnel_clear", Kind::integer});
  }
  table.columns.push_back({"error", Kind::text});

  // Obstructions lie where the ends are stated.
  CrsTransform toStated;
  if (pairs.crsWkt != model.georeference.crsWkt)
    if (auto made = CrsTransform::between(model.georeference.crsWkt, pairs.crsWkt))
      toStated = std::move(*made);
  for (std::size_t i = 0; i < rows.count(); ++i) {
    const auto& [from, to] = pairs.rows[i];
    const Error* error = errorOf(i);
    const SightPath path = error ? SightPath{} : rows.paths[rows.rows[i].path];
    table.add(number(from.stated.x));
    table.add(number(from.stated.y));
    table.add(error ? "" : number(path.fromHeight));
    table.add(number(to.stated.x));
    table.add(number(to.stated.y));
    table.add(error ? "" : number(path.toHeight));
    if (error) {
      for (int k = 0; k < 12 + (blockedBy.empty() ? 0 : 1) + (hasTolerance ? 1 : 0) + (hasFresnel ? 2 : 0);
           ++k)
        table.add({});
      table.add(withOptionNames(*error).describe());
      continue;
    }
    const SightPathAnswer& a = answerOf(i);
    const auto& obstruction = a.sight.obstruction;
    const Vec2 xy =
        obstruction ? toStated(model.toSource(obstruction->plan)).value_or(Vec2{NAN, NAN}) : Vec2{};
    table.add(toString(a.sight.verdict));
    table.add(number(a.distanceMetres));
    table.add(number(a.azimuthDegrees));
    table.add(number(a.elevationDegrees));
    table.add(a.sight.clearance ? number(*a.sight.clearance) : "");
    table.add(a.sight.clearance ? number(a.sight.clearanceWithin) : "");
    table.add(obstruction ? number(xy.x) : "");
    table.add(obstruction ? number(xy.y) : "");
    table.add(obstruction ? number(obstruction->terrainHeight) : "");
    table.add(obstruction ? number(obstruction->distance) : "");
    table.add(number(a.sight.gapMetres));
    if (!blockedBy.empty()) table.add(blockedBy[rows.rows[i].path]);
    if (hasTolerance) table.add(obstruction ? a.sight.isObstructionLatest ? "1" : "0" : "");
    table.add(fmt::format("{}", a.sight.visited));
    if (hasFresnel) {
      table.add(a.fresnel ? number(a.fresnel->fraction) : "");
      table.add(isFresnelClear(a) ? "1" : "0");
    }
    table.add({});
  }
  return table;
}

std::vector<std::array<Vec2, 2>> SightResults::ends() const {
  std::vector<std::array<Vec2, 2>> all;
  all.reserve(pairs.rows.size());
  for (const auto& [from, to] : pairs.rows) all.push_back({from.stated, to.stated});
  return all;
}

}  // namespace arete

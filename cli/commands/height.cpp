// SPDX-License-Identifier: GPL-3.0-or-later
//
// The places, typed or of a file, say which part of the model is read; each is then located in its triangle.
#include "cli/commands/height.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cli/arguments/arguments.h"
#include "cli/arguments/place_hint.h"
#include "cli/arguments/terrain_error.h"
#include "cli/session/model_file.h"
#include "io/geo/crs/position_argument.h"
#include "io/geo/crs/transform.h"
#include "io/geo/table/height_table.h"
#include "io/geo/table/point_table.h"
#include "io/query/extract/batches.h"
#include "io/query/parts/asked_places.h"
#include "terrain/locate/ground_height.h"

namespace arete {
namespace {

struct HeightArguments {
  std::string model;
  std::vector<std::string> at;
  std::string points, layer, output;
  std::string maxError = "0";
  bool lonLat = false;
  ExistingFile existing = ExistingFile::keepsOtherLayers;
};

using Heights = std::vector<std::optional<GroundHeight>>;

/// The places of --at, as typed and in the DEM's CRS.
Result<PointTable> statedPlaces(const HeightArguments& arguments, const TerrainModel& model) {
  PointTable table;
  ARETE_TRY(const auto toDem, transformOfPlaces(arguments.lonLat, model));
  table.crsWkt = arguments.lonLat ? toDem.sourceWkt() : model.georeference.crsWkt;
  for (const std::string& text : arguments.at) {
    ARETE_TRY(const auto stated, readPlaceArgument("--at", text, CrsTransform()));
    ARETE_TRY(const auto place, readPlaceArgument("--at", text, toDem));
    table.stated.push_back(stated);
    table.positions.push_back(place);
  }
  return table;
}

/// The places of a file can lie a turn of longitude away from the DEM; they are moved by whole turns, as
/// typed ones are by their transform.
Result<PointTable> readPlaces(const HeightArguments& arguments, const TerrainModel& model, Session& session) {
  if (arguments.points.empty()) return statedPlaces(arguments, model);
  auto table = readPointTable(inputPath(arguments.points), model.georeference,
                              {.layer = arguments.layer, .lonLat = arguments.lonLat}, session.context());
  if (!table) return table;
  session.warn(table->warnings, arguments.points);
  LongitudeTurns(model).apply(table->positions);
  return table;
}

std::string textOf(const HeightArguments& arguments, const PointTable& table, const Heights& heights) {
  std::string text;
  if (!arguments.points.empty()) {
    forCsvLines(table, heights, [&](std::string_view line) { text += line; });
    return text;
  }
  for (std::size_t i = 0; i < heights.size(); ++i)
    text += fmt::format("{},{},{}\n", table.stated[i].x, table.stated[i].y,
                        heights[i] ? heightText(heights[i]->height) : "");
  return text;
}

Json numberOrNull(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

/// JSON has no NaN and no infinity, so a number that is not finite becomes null, as a missing height does.
Json jsonOf(const PointTable& table, const Heights& heights) {
  Json points = Json::array();
  for (std::size_t i = 0; i < heights.size(); ++i) {
    Json point = {{"x", numberOrNull(table.stated[i].x)}, {"y", numberOrNull(table.stated[i].y)}};
    if (!table.z.empty()) point["z"] = numberOrNull(table.z[i]);
    point["height"] = heights[i] ? Json(heights[i]->height) : Json();
    if (heights[i]) {
      point["below"] = heights[i]->below;
      point["above"] = heights[i]->above;
      point["nodesVisited"] = heights[i]->nodesVisited;
    }
    points.push_back(std::move(point));
  }
  return points;
}

/// What the first place without a height looks like, if not like a place on the map; empty: nothing else.
std::string hintOfPlaces(const PointTable& table, const Heights& heights, const TerrainModel& model) {
  for (std::size_t i = 0; i < heights.size(); ++i)
    if (!heights[i])
      if (std::string hint = degreesHint(table.positions[i], model); !hint.empty()) return hint;
  return {};
}

/// Errors: invalidData: no row has a position, or no place has a height.
Status checkFound(const HeightArguments& arguments, const PointTable& table, const Heights& heights,
                  std::size_t found, const TerrainModel& model) {
  const std::size_t places = heights.size();
  if (table.withoutPlace == places)
    return failure(ErrorCode::invalidData,
                   places == 1 ? std::string("has no position in its only row")
                               : fmt::format("has no position in any of its {} rows", grouped(places)),
                   arguments.points);
  if (found > 0) return {};
  const std::string where =
      places == 1 ? std::string("this place") : fmt::format("any of the {} places", grouped(places));
  if (const std::string hint = hintOfPlaces(table, heights, model); !hint.empty())
    return failure(
        ErrorCode::invalidData, fmt::format("{} has no terrain at {}: {}", arguments.model, where, hint),
        arguments.points.empty() ? "--at " + arguments.at.front() : "--points " + arguments.points);
  return failure(ErrorCode::invalidData,
                 fmt::format("has no terrain at {}; X,Y are coordinates of its CRS, or longitude,latitude "
                             "with --lonlat",
                             where),
                 arguments.model);
}

/// Says which columns of the file get other names, since ours have theirs.
void noteRenamed(const HeightArguments& arguments, const PointTable& table, const Session& session) {
  if (arguments.points.empty()) return;
  for (const auto& [own, here] : renamedColumns(table, arguments.output))
    session.note(fmt::format("the column {} of {} is {} in the answer, which has a column of that name", own,
                             arguments.points, here));
}

// What contradicts itself is refused before the model is opened, and the output is checked before the places
// are read.
Status runHeight(const HeightArguments& arguments, Session& session) {
  if (arguments.at.empty() == arguments.points.empty())
    return failure(ErrorCode::usage, "either --at or --points is required");
  if (!arguments.layer.empty() && arguments.points.empty())
    return failure(ErrorCode::usage, "requires --points", "--layer");
  if (!arguments.output.empty()) {
    const std::string culprit = fmt::format("--output {}", arguments.output);
    if (!isHeightTable(arguments.output))
      return failure(ErrorCode::usage, "a table of heights ends in .csv or .gpkg", culprit);
  }
  ARETE_TRY(const AmtFile file, openTerrain(arguments.model));
  ARETE_TRY(const TerrainModel outline, outlineOf(file, session.context()));
  ARETE_TRY(const TerrainError maxError, terrainErrorOf(arguments.maxError, file, session));
  if (!arguments.output.empty())
    if (Status output =
            checkOutput("--output", arguments.output, {arguments.model, arguments.points, outline.source});
        !output)
      return output;
  ARETE_TRY(const auto table, readPlaces(arguments, outline, session));
  // Only the parts of the model that hold the places are read. A place off the terrain has no height, which
  // is an answer and not an error unless all places are like that.
  std::vector<Vec2> plan;
  for (const Vec2 place : table.positions) plan.push_back(outline.toPlan(place));
  Heights heights(plan.size());
  ARETE_CHECK(answerInBatches(plan, [&](std::span<const std::uint32_t> batch) -> Status {
    std::vector<Vec2> places, inPlan;
    for (const std::uint32_t i : batch) {
      inPlan.push_back(plan[i]);
      places.push_back(table.positions[i]);
    }
    ARETE_TRY(const TerrainModel model,
              readWanted(file, outline, wantedAt(inPlan, outline), session.context()));
    ARETE_TRY(auto found, GroundHeights(model).at(places, maxError.value, session.context()));
    for (std::size_t k = 0; k < batch.size(); ++k) heights[batch[k]] = std::move(found[k]);
    return {};
  }));

  const auto found = static_cast<std::size_t>(
      std::count_if(heights.begin(), heights.end(), [](const auto& h) { return h.has_value(); }));
  Json json = {{"model", arguments.model}, {"verticalUnit", outline.georeference.verticalUnit}};
  maxError.addTo(json);
  json["places"] = heights.size();
  json["withoutPlace"] = table.withoutPlace;
  json["onTerrain"] = found;
  // The command fails where all heights would be empty, and then writes no table of them.
  if (!arguments.output.empty()) ARETE_CHECK(checkFound(arguments, table, heights, found, outline));
  noteRenamed(arguments, table, session);
  if (arguments.output.empty()) {
    session.say(textOf(arguments, table, heights));
    if (maxError.relief)
      session.note(fmt::format("heights within {}", maxError.text(outline.georeference.verticalUnit)));
    json["points"] = jsonOf(table, heights);
  } else {
    if (Status written =
            writeHeightTable(arguments.output, table, heights, session.context(), arguments.existing);
        !written)
      return written;
    session.say(fmt::format("{}: {} of {} a height{}\n", arguments.output, grouped(found),
                            grouped(heights.size(), "place has", "places have"),
                            maxError.shareText(outline.georeference.verticalUnit)));
    json["file"] = arguments.output;
  }
  session.answer(json);
  ARETE_CHECK(checkFound(arguments, table, heights, found, outline));
  if (table.withoutPlace > 0)
    session.warn(fmt::format("{} of {} no position, and so no height", grouped(table.withoutPlace),
                             grouped(heights.size(), "row has", "rows have")));
  if (const std::size_t off = heights.size() - found - table.withoutPlace; off > 0)
    session.warn(fmt::format("{} of {} no height: outside the DEM, or on NODATA{}", grouped(off),
                             grouped(heights.size(), "place has", "places have"),
                             behindSemicolon(hintOfPlaces(table, heights, outline))));
  return {};
}

}  // namespace

void addHeightCommand(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<HeightArguments>();
  CLI::App* command = session.addCommand(
      app, "height", "Compute the height of the terrain at places",
      "  arete height dem.amt --at 409050,3801450              409050,3801450,1815.74828193\n"
      "  arete height dem.amt --at -118.05,34.35 --lonlat\n"
      "  arete height dem.amt --points huts.gpkg -o huts_with_heights.gpkg\n"
      "  arete height dem.amt --points places.csv --max-error 2 -o heights.csv\n"
      "\n"
      "A place outside the DEM or on NODATA has an empty height. If no place has a height, the exit code is "
      "4.",
      [arguments](Session& s) { return runHeight(*arguments, s); });
  command->add_option("FILE.amt", arguments->model, "Multitriangulation")->required()->type_name("");
  CLI::Option* at = command
                        ->add_option("--at", arguments->at,
                                     "Place in the DEM's CRS; may be repeated. The answer is X,Y,height")
                        ->type_size(1)
                        ->expected(1)
                        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
                        ->type_name("X,Y");
  command
      ->add_option("--points", arguments->points,
                   "Places of a file: CSV or XYZ in the DEM's CRS, or a layer of points (any vector file)")
      ->type_name("FILE")
      ->excludes(at);
  command->add_option("--layer", arguments->layer, "Layer of points, where the file has several")
      ->type_name("NAME");
  command
      ->add_option("-o,--output", arguments->output,
                   "Write a table (.csv or .gpkg): the columns of the file, height and its bounds below, "
                   "above (default: CSV on stdout)")
      ->type_name("FILE");
  addOverwriteTo(*command, arguments->existing);
  addTerrainErrorTo(*command, arguments->maxError, "How far from full resolution a height may be", true);
  command->add_flag("--lonlat", arguments->lonLat, "X,Y are longitude, latitude in degrees (WGS 84)");
}

}  // namespace arete

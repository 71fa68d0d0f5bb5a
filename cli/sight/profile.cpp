// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every line, typed or of a file, becomes a way: vertices, and the heights of both ends where it is a line of
// sight. A way becomes one track over the terrain, the track a profile; text, JSON and chart are made of the
// profiles.
#include "cli/sight/profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cli/arguments/arguments.h"
#include "cli/arguments/place_hint.h"
#include "cli/arguments/terrain_error.h"
#include "cli/session/model_file.h"
#include "cli/sight/arguments.h"
#include "io/files/file_writer.h"
#include "io/files/text_scan.h"
#include "io/geo/crs/data_unit.h"
#include "io/geo/crs/position_argument.h"
#include "io/geo/crs/transform.h"
#include "io/geo/table/point_table.h"
#include "io/query/extract/batches.h"
#include "io/query/extract/region_reader.h"
#include "io/query/parts/asked_places.h"
#include "terrain/sight/fresnel.h"
#include "terrain/sight/paths.h"
#include "terrain/sight/profile.h"
#include "viewer/picture/profile_chart.h"

namespace arete {
namespace {

struct ProfileArguments {
  std::string model, along, layer, output, png;
  SightArguments sight;
  std::string maxError = "0";
  bool csv = false;
  double frequency = 0, fresnel = kUsualFresnel;
};

/// A line to take the profile along, in the DEM's CRS. Two positions with heights are a line of sight as
/// well.
struct Way {
  std::vector<Vec2> vertices;
  std::optional<std::array<PositionArgument, 2>> ends;
};

bool isFile(const std::string& text) {
  std::error_code ignored;
  return std::filesystem::exists(text, ignored) || text.rfind("/vsi", 0) == 0;
}

std::vector<std::string> splitAtColons(const std::string& text) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == ':')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

Result<Way> typedWay(const std::string& text, const CrsTransform& toDem, const DataUnit& unit) {
  Way way;
  const std::vector<std::string> parts = splitAtColons(text);
  if (parts.size() < 2)
    return failure(ErrorCode::usage, "is no file and no line: two or more places, X,Y:X,Y",
                   "--along " + text);
  std::vector<PositionArgument> positions;
  for (const std::string& part : parts) {
    if (std::count(part.begin(), part.end(), ',') == 2) {
      ARETE_TRY(const auto position, readPositionArgument("--along", part, toDem, &unit));
      positions.push_back(position);
      way.vertices.push_back(position.xy);
      continue;
    }
    ARETE_TRY(const auto place, readPlaceArgument("--along", part, toDem));
    way.vertices.push_back(place);
  }
  // Heights make a line of sight of exactly two places; on a longer line they are an error.
  if (positions.size() == 2 && parts.size() == 2)
    way.ends = {positions[0], positions[1]};
  else if (!positions.empty())
    return failure(ErrorCode::usage, "heights are for a line of sight of two places, X,Y,H:X,Y,H",
                   "--along " + text);
  return way;
}

bool isTextName(const std::string& path) {
  constexpr std::array<std::string_view, 4> kTexts = {"csv", "tsv", "txt", "xyz"};
  return std::ranges::count(kTexts, text::lowerExtension(path)) > 0;
}

/// The rows of a text of points, as the vertices of one line. Errors: as readPointTable(). invalidData:
/// one row, or a row without a place on the map.
Result<std::vector<Way>> wayOfRows(const ProfileArguments& a, const Georeference& dem,
                                   const LongitudeTurns& turns, Session& session) {
  ARETE_TRY(auto table, readPointTable(a.along, dem, {.lonLat = a.sight.lonLat}, session.context()));
  session.warn(table.warnings, a.along);
  turns.apply(table.positions);
  for (std::size_t i = 0; i < table.positions.size(); ++i)
    if (!std::isfinite(table.positions[i].x + table.positions[i].y))
      return failure(ErrorCode::invalidData, "has no place on the map of the DEM",
                     fmt::format("{}, row {}", a.along, i + 1));
  if (table.positions.size() < 2) return failure(ErrorCode::invalidData, "holds no line", a.along);
  session.note(fmt::format("{}: its {} are the vertices of one line", a.along,
                           grouped(table.positions.size(), "row", "rows")));
  return std::vector<Way>{{std::move(table.positions), std::nullopt}};
}

Result<std::vector<Way>> readWays(const ProfileArguments& a, const Georeference& dem,
                                  const LongitudeTurns& turns, const CrsTransform& toDem, Session& session) {
  if (!isFile(a.along)) {
    if (!a.layer.empty()) return failure(ErrorCode::usage, "requires --along FILE", "--layer");
    ARETE_TRY(auto way, typedWay(a.along, toDem, heightUnitOf(dem)));
    return std::vector<Way>{std::move(way)};
  }
  // A layer states its CRS, and its longitudes may be a whole turn away from the DEM's.
  auto found = readRegion(a.along, dem.crsWkt, {.layer = a.layer, .takesLines = true}, session.context());
  const bool isText = isTextName(a.along);
  if (!found && isText && a.layer.empty() && found.error().code == ErrorCode::unsupported)
    return wayOfRows(a, dem, turns, session);
  if (a.sight.lonLat && (found || !isText))
    return failure(ErrorCode::usage, "cannot be combined with --along FILE, which has a CRS of its own",
                   "--lonlat");
  if (!found && found.error().message.find("name one of them") != std::string::npos)
    found.error().message += " (--layer)";
  ARETE_TRY(auto read, std::move(found));
  session.warn(read.warnings, a.along);
  if (read.lines.empty()) return failure(ErrorCode::invalidData, "holds no line", a.along);
  std::vector<Way> ways;
  for (auto& line : read.lines) {
    turns.apply(line);
    ways.push_back({std::move(line), std::nullopt});
  }
  return ways;
}

/// Whether a typed line without terrain looks like longitudes and latitudes. Errors: invalidData.
Status checkDegrees(const ProfileArguments& a, const std::vector<Way>& ways, const TerrainModel& model) {
  if (a.sight.lonLat || (isFile(a.along) && !isTextName(a.along))) return {};
  for (const Vec2 vertex : ways.front().vertices)
    if (const std::string hint = degreesHint(vertex, model); !hint.empty())
      return failure(ErrorCode::invalidData, "lies outside the DEM: " + hint, "--along " + a.along);
  return {};
}

Result<SightTrack> trackOf(const Way& way, const SightEarth& earth, const TerrainModel& model) {
  std::vector<Vec2> places;
  for (const Vec2 vertex : way.vertices) places.push_back(sightPlan(model, vertex));
  return trackAlong(places, earth);
}

/// The profile of one way, and the line of sight over it.
struct Answer {
  Profile profile;
  std::optional<SightLine> line;
  SightPathAnswer path;
};

class ProfileTable {
 public:
  ProfileTable(const TerrainModel& model, const std::string& statedCrs, double wavelength)
      : model_(model), wavelength_(wavelength) {
    if (statedCrs != model.georeference.crsWkt)
      if (auto made = CrsTransform::between(model.georeference.crsWkt, statedCrs))
        toStated_ = std::move(*made);
  }

  std::string csv(const std::vector<Answer>& answers) const {
    const bool hasLine = answers.front().line.has_value();
    std::string text = "line,part,distance,x,y,height";
    if (hasLine) text += ",line_height,clearance";
    if (hasLine && wavelength_ > 0) text += ",fresnel_radius";
    text += '\n';
    for (std::size_t i = 0; i < answers.size(); ++i) {
      // A part ends where the next vertex is not joined to the one before it, as over NODATA.
      int part = 0;
      for (const ProfileVertex& v : answers[i].profile.vertices) {
        part += !v.isJoined;
        const Vec2 xy = placeOf(v);
        fmt::format_to(std::back_inserter(text), "{},{},{:.12g},{:.12g},{:.12g},{:.12g}", i + 1, part,
                       v.distance, xy.x, xy.y, v.height);
        if (const auto& line = answers[i].line) {
          const double z = line->height(v.distance);
          fmt::format_to(std::back_inserter(text), ",{:.12g},{:.12g}", z, z - v.height);
          if (wavelength_ > 0)
            fmt::format_to(std::back_inserter(text), ",{:.12g}", radiusAt(*line, v.distance));
        }
        text += '\n';
      }
    }
    return text;
  }

  Json json(const Answer& answer) const {
    Json vertices = Json::array();
    for (const ProfileVertex& v : answer.profile.vertices) {
      const Vec2 xy = placeOf(v);
      Json vertex = {
          {"distance", v.distance}, {"x", xy.x}, {"y", xy.y}, {"height", v.height}, {"joined", v.isJoined}};
      if (answer.line) vertex["lineHeight"] = answer.line->height(v.distance);
      if (answer.line && wavelength_ > 0) vertex["fresnelRadius"] = radiusAt(*answer.line, v.distance);
      vertices.push_back(std::move(vertex));
    }
    Json json = {{"length", answer.profile.length}, {"gap", answer.profile.gapMetres}};
    if (answer.line) {
      const SightAnswer& sight = answer.path.sight;
      json["verdict"] = std::string(toString(sight.verdict));
      json["azimuth"] = answer.path.azimuthDegrees;
      json["elevation"] = answer.path.elevationDegrees;
      json["clearance"] = sight.clearance ? Json(*sight.clearance) : Json();
      json["obstructionDistance"] = sight.obstruction ? Json(sight.obstruction->distance) : Json();
      if (wavelength_ > 0)
        json["fresnel"] = answer.path.fresnel ? Json(answer.path.fresnel->fraction) : Json();
    }
    json["vertices"] = std::move(vertices);
    return json;
  }

 private:
  Vec2 placeOf(const ProfileVertex& v) const {
    const Vec2 xy = model_.toSource(v.plan);
    return toStated_(xy).value_or(xy);
  }
  /// In the unit of heights.
  double radiusAt(const SightLine& line, double s) const {
    return fresnelRadius(wavelength_, s, line.length()) / line.heightUnitMetres();
  }

  const TerrainModel& model_;
  double wavelength_;
  CrsTransform toStated_;
};

Result<Answer> answerWay(const Way& way, const ProfileArguments& a, double maxError, const SightEarth& earth,
                         const Profiles& profiles) {
  const TerrainModel& model = profiles.heights().model();
  Answer answer;
  if (!way.ends) {
    ARETE_TRY(const auto track, trackOf(way, earth, model));
    answer.profile = profiles.along(track, maxError);
    return answer;
  }
  SightPath path{sightPlan(model, way.vertices[0]), sightPlan(model, way.vertices[1])};
  for (int end = 0; end < 2; ++end) {
    auto found = demHeight((*way.ends)[end], profiles.heights());
    if (!found) ARETE_CHECK(checkDegrees(a, {way}, model));
    ARETE_TRY(const double height, std::move(found));
    (end == 0 ? path.fromHeight : path.toHeight) = height;
  }
  ARETE_TRY(auto line, sightLine(path, earth, model));
  const auto engine = makeSightDescent(model);
  SightPathOptions options;
  options.sight.nodata = a.sight.nodata;
  options.frequencyMegahertz = a.frequency;
  auto seen = answerPath(path, earth, *engine, profiles, options);  // always of full resolution
  if (!seen) return tl::unexpected(seen.error());
  answer.profile = profiles.along(line.track(), maxError);
  answer.line = std::move(line);
  answer.path = *seen;
  return answer;
}

/// Says how much of the lines has no terrain below it.
void warnOfGaps(const std::vector<Answer>& answers, const Session& session) {
  double length = 0, gap = 0;
  for (const Answer& answer : answers) {
    length += answer.profile.length;
    gap += answer.profile.gapMetres;
  }
  // Less than a millimetre is the rounding of the ends.
  if (gap > 1e-3)
    session.warn(
        fmt::format("{:.6g} of {:.6g} m have no terrain below: outside the DEM, or on NODATA", gap, length));
}

/// The vertices of some ways.
std::vector<std::vector<Vec2>> linesOf(const std::vector<Way>& ways, std::span<const std::uint32_t> batch) {
  std::vector<std::vector<Vec2>> lines;
  for (const std::uint32_t i : batch) lines.push_back(ways[i].vertices);
  return lines;
}

/// Draws the ground at full resolution below a line of sight, whose answer is of that terrain; else the
/// profile as it is asked for.
Status drawPng(const ProfileArguments& a, const Answer& answer, double maxError, const Profiles& profiles,
               double wavelength) {
  const TerrainModel& model = profiles.heights().model();
  if (!(answer.profile.length > 0))
    return failure(ErrorCode::degenerate, "has no length: a picture of its profile would show nothing",
                   "--along " + a.along);
  ProfileChartOptions options;
  options.unit = model.georeference.verticalUnit;
  if (!model.georeference.crsWkt.empty()) options.unitMetres = model.georeference.verticalUnitMetres;
  std::optional<ProfileSight> sight;
  options.title = fmt::format("{}, {:.6g} km", std::filesystem::path(a.model).filename().string(),
                              answer.profile.length / 1000);
  if (answer.line) {
    const SightAnswer& s = answer.path.sight;
    sight.emplace(ProfileSight{*answer.line, s, wavelength, a.fresnel, answer.path.fresnel});
    options.title += fmt::format(": {}", toString(s.verdict));
    if (s.clearance) options.subtitle = "clearance " + withUnit(*s.clearance, options.unit);
    if (answer.path.fresnel)
      options.subtitle += fmt::format(", {:.2f} of the first Fresnel zone at {:g} MHz",
                                      answer.path.fresnel->fraction, a.frequency);
    if (a.sight.nodata != NodataSight::unknown)
      options.subtitle += fmt::format("; places without data: {}", toString(a.sight.nodata));
    if (a.sight.earthName(model) == "ellipsoid")
      options.subtitle += fmt::format("; effective Earth's radius R / (1 - {:.4g})", a.sight.refraction);
  } else if (maxError > 0) {
    options.subtitle = "terrain within " + withUnit(maxError, options.unit);
  }
  const bool isCoarse = answer.line && maxError > 0;
  ARETE_TRY(const auto canvas,
            drawProfile(isCoarse ? profiles.along(answer.line->track()) : answer.profile, sight, options));
  return canvas.savePng(a.png);
}

/// A part of the model, and the profiles over it.
struct PartAndProfiles {
  PartAndProfiles(TerrainModel part, bool hasGrid)
      : model(std::move(part)),
        profiles(model, hasGrid && model.isRaster ? std::make_shared<const SightGrid>(model) : nullptr) {}

  const TerrainModel model;
  const Profiles profiles;
};

Status runProfile(const ProfileArguments& a, Session& session) {
  if (!a.output.empty() && text::lowerExtension(a.output) != "csv")
    return failure(ErrorCode::usage,
                   text::lowerExtension(a.output) == "png"
                       ? "a profile is written as .csv; --png draws it as a picture"
                       : "a profile is written as .csv, and drawn by --png as .png",
                   "--output " + a.output);
  if (!a.png.empty() && text::lowerExtension(a.png) != "png")
    return failure(ErrorCode::usage, "a picture ends in .png", "--png " + a.png);
  ARETE_TRY(const AmtFile amt, openTerrain(a.model));
  // The outline places the lines, and the lines decide which terrain is read.
  ARETE_TRY(const TerrainModel outline, outlineOf(amt, session.context()));
  for (const auto& [option, path] : {std::pair{"--output", a.output}, {"--png", a.png}})
    if (!path.empty()) ARETE_CHECK(checkOutput(option, path, {a.model, a.along, outline.source}));
  const Georeference& dem = outline.georeference;
  ARETE_TRY(const auto toDem, transformOfPlaces(a.sight.lonLat, outline));
  ARETE_TRY(const auto ways, readWays(a, dem, LongitudeTurns(outline), toDem, session));
  if (a.frequency > 0 && !ways.front().ends)
    return failure(ErrorCode::usage, "requires a line of sight: --along X,Y,H:X,Y,H", "--frequency");
  if (a.sight.statesNodata() && !ways.front().ends)
    return failure(ErrorCode::usage, "requires a line of sight: --along X,Y,H:X,Y,H", "--nodata");
  if (!a.png.empty() && ways.size() > 1)
    return failure(ErrorCode::usage, fmt::format("draws one line, not {}", ways.size()), "--png");
  ARETE_TRY(const auto earth, a.sight.makeEarth(outline, session));
  ARETE_TRY(const TerrainError maxError, terrainErrorOf(a.maxError, amt, session));
  // A grid of the samples serves only profiles of full resolution, which Fresnel zones always need.
  const bool isFull = maxError.value == 0 || a.frequency > 0;
  const double wavelength = a.frequency > 0 ? wavelengthMetres(a.frequency) : 0;
  std::vector<Answer> answers(ways.size());
  std::vector<Vec2> places;
  for (const Way& way : ways) places.push_back(way.vertices.empty() ? Vec2{} : way.vertices.front());
  std::optional<PartAndProfiles> part;  // of the last batch: a picture is of the only one
  ARETE_CHECK(answerInBatches(places, [&](std::span<const std::uint32_t> batch) -> Status {
    part.reset();
    const RequiredError wanted = wantedAlong(linesOf(ways, batch), *earth, outline);
    ARETE_TRY(TerrainModel model, readWanted(amt, outline, wanted, session.context()));
    part.emplace(std::move(model), isFull);
    for (const std::uint32_t i : batch) {
      if (session.context().cancelled()) return failure(ErrorCode::interrupted, "the query was stopped");
      ARETE_TRY(answers[i], answerWay(ways[i], a, maxError.value, *earth, part->profiles));
    }
    return {};
  }));
  std::size_t vertices = 0;
  for (const Answer& answer : answers) vertices += answer.profile.vertices.size();
  if (vertices == 0) ARETE_CHECK(checkDegrees(a, ways, outline));
  if (vertices == 0)
    return failure(
        ErrorCode::invalidData,
        "has no terrain along the line; X,Y are coordinates of its CRS, or longitude,latitude with --lonlat",
        a.model);
  // Typed places keep the CRS that they were typed in; a file's places have become the DEM's.
  const ProfileTable table(outline, a.sight.lonLat && !isFile(a.along) ? toDem.sourceWkt() : dem.crsWkt,
                           wavelength);
  Json json = {{"model", a.model},
               {"verticalUnit", dem.verticalUnit},
               {"earth", a.sight.earthName(outline)},
               {"refraction", a.sight.refractionJson(outline)}};
  maxError.addTo(json);
  if (ways.front().ends) json["nodata"] = std::string(toString(a.sight.nodata));
  Json lines = Json::array();
  if (session.wantsAnswer())
    for (const Answer& answer : answers) lines.push_back(table.json(answer));
  json["lines"] = std::move(lines);
  if (!a.output.empty()) {
    ARETE_TRY(auto file, FileWriter::create(a.output));
    file.write(table.csv(answers));
    ARETE_CHECK(file.finish());
    session.say(fmt::format("{}: {} of {}{}\n", a.output, grouped(vertices, "vertex", "vertices"),
                            grouped(answers.size(), "line", "lines"), maxError.shareText(dem.verticalUnit)));
    json["file"] = a.output;
  }
  if (!a.png.empty()) {
    ARETE_CHECK(drawPng(a, answers.front(), maxError.value, part->profiles, wavelength));
    json["picture"] = a.png;
    session.say(fmt::format("{}: a profile of {:.6g} km\n", a.png, answers.front().profile.length / 1000));
  }
  warnOfGaps(answers, session);
  if (a.csv || (a.output.empty() && a.png.empty())) session.say(table.csv(answers));
  if (maxError.relief && a.output.empty())
    session.note(fmt::format("the profile is within {}", maxError.text(dem.verticalUnit)));
  session.answer(json);
  return {};
}

}  // namespace

void addProfileCommand(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<ProfileArguments>();
  CLI::App* command = session.addCommand(
      app, "profile", "Compute the heights of the terrain along a line",
      "  arete profile dem.amt --along 409050,3801450:411000,3795000 > profile.csv\n"
      "  arete profile dem.amt --along road.gpkg --max-error 1 -o road.csv\n"
      "  arete profile dem.amt --along 409050,3801450,10:411000,3795000,30 --frequency 2400 --png link.png\n"
      "\n"
      "Between two places the line is a geodesic. At full resolution the profile has a vertex at every edge "
      "that\n"
      "it crosses. Parts of a line are counted from 1; between them there is no terrain.",
      [arguments](Session& s) { return runProfile(*arguments, s); });
  command->add_option("FILE.amt", arguments->model, "Multitriangulation")->required()->type_name("");
  command
      ->add_option(
          "--along,--line", arguments->along,
          "Layer of lines, a text of one line's vertices (CSV, XYZ), or places; two places with heights, "
          "X,Y,H:X,Y,H, are a line of sight as well")
      ->required()
      ->type_name("FILE|X,Y:X,Y[:...]");
  command->add_option("--layer", arguments->layer, "Layer, where the file has several")->type_name("NAME");
  addTerrainErrorTo(*command, arguments->maxError, "Largest error of the profile", true);
  command->add_flag("--csv", arguments->csv, "Write CSV to stdout (default without --output and --png)");
  command->add_option("-o,--output", arguments->output, "CSV file to write")->type_name("FILE");
  command->add_option("--png", arguments->png, "Draw the profile, the line of sight and its Fresnel zone")
      ->type_name("FILE");
  arguments->sight.addLonLatTo(*command);
  arguments->sight.addNodataTo(*command);
  arguments->sight.addEarthTo(*command);
  const std::string radio = "Radio";
  CLI::Option* frequency = command
                               ->add_option("--frequency", arguments->frequency,
                                            "Frequency whose first Fresnel zone is computed and drawn")
                               ->check(megahertz())
                               ->type_name("MHZ")
                               ->group(radio);
  command
      ->add_option("--fresnel", arguments->fresnel,
                   "Part of the first Fresnel zone that must be clear, drawn inside it (default 0.6)")
      ->check(finiteAtLeast(0))
      ->needs(frequency)
      ->type_name("PART")
      ->group(radio);
}

}  // namespace arete

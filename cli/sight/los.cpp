// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every way to state the ends (two positions, a position and a file of sites, a file of pairs) becomes rows
// of SightPairs; each row becomes a path, or an error; answers go out in the order of the rows.
#include "cli/sight/los.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "cli/arguments/arguments.h"
#include "cli/arguments/place_hint.h"
#include "cli/arguments/terrain_error.h"
#include "cli/session/model_file.h"
#include "cli/session/option_names.h"
#include "cli/sight/arguments.h"
#include "cli/sight/los_answers.h"
#include "cli/sight/meshes_in_the_way.h"
#include "cli/sight/rows.h"
#include "io/files/file_writer.h"
#include "io/files/text_scan.h"
#include "io/geo/crs/data_unit.h"
#include "io/geo/crs/transform.h"
#include "io/geo/dem/clutter_raster.h"
#include "io/geo/table/line_table.h"
#include "io/geo/table/sight_pairs.h"
#include "io/query/parts/asked_places.h"
#include "io/query/scene/open_scene.h"
#include "terrain/sight/paths.h"

namespace arete {
namespace {

/// Whether a position is X,Y,H, and not X,Y.
bool statesHeight(const std::string& position) {
  return std::ranges::count(position, ',') != 1;
}

struct LosArguments {
  std::string model, from, to, pairs, points, layer, output, observerHeight, targetHeight, clutter;
  SightArguments sight;
  SightMethod method = SightMethod::automatic;
  std::string maxError = "0";
  std::string clutterFreeWithUnit;  // as checkGroundUnits() takes it
  double frequency = 0, fresnel = kUsualFresnel, clutterFree = 100;
  ExistingFile existing = ExistingFile::keepsOtherLayers;

  /// Whether --to is a place without a height.
  bool isTargetOnGround() const { return !to.empty() && !statesHeight(to) && targetHeight.empty(); }
};

bool isJson(const std::string& path) {
  return text::lowerExtension(path) == "json";
}

Status checkArguments(const LosArguments& a) {
  const auto usage = [](std::string sentence, std::string culprit = {}) {
    return failure(ErrorCode::usage, std::move(sentence), std::move(culprit));
  };
  // The ends come from pairs, from two positions, or from one position and a file of points.
  const int ends = !a.from.empty() + !a.to.empty();
  if (!a.pairs.empty() && (ends > 0 || !a.points.empty()))
    return usage("cannot be combined with --from, --to or --points", "--pairs");
  if (a.pairs.empty() && a.points.empty() && ends < 2)
    return usage("--from and --to are required, or --pairs, or --points and one of --from and --to");
  if (!a.points.empty() && ends != 1)
    return usage("requires either --from or --to, the other end of every line", "--points");
  if (!a.layer.empty() && a.pairs.empty() && a.points.empty())
    return usage("requires --pairs or --points", "--layer");
  for (const auto& [option, height, end] :
       {std::tuple{"--observer-height", a.observerHeight, a.from}, {"--target-height", a.targetHeight, a.to}})
    if (!height.empty() && a.pairs.empty() && a.points.empty() && statesHeight(end))
      return usage("requires --pairs or --points; the height in --from and --to is the H of X,Y,H", option);
  if (!a.output.empty() && !isLineTable(a.output) && !isJson(a.output))
    return usage("a table of lines of sight ends in .csv, .gpkg or .json", "--output " + a.output);
  if (!a.clutter.empty() && isAboveZero(a.maxError))
    return usage("cannot be combined with --max-error", "--clutter");
  return {};
}

/// Reads "X,Y,H" as a site. Its `stated` coordinates are those typed, its `xy` are in the DEM's CRS. "X,Y"
/// has no height, if `mayLackHeight`.
Result<SightSite> siteOf(const std::string& option, const std::string& text, const CrsTransform& toDem,
                         const DataUnit& unit, bool mayLackHeight) {
  if (mayLackHeight && !statesHeight(text)) {
    ARETE_TRY(const Vec2 stated, readPlaceArgument(option, text, CrsTransform()));
    ARETE_TRY(const Vec2 xy, readPlaceArgument(option, text, toDem));
    return SightSite{stated, xy, std::nullopt};
  }
  ARETE_TRY(const auto stated, readPositionArgument(option, text, CrsTransform(), &unit));
  ARETE_TRY(const auto position, readPositionArgument(option, text, toDem, &unit));
  return SightSite{stated.xy, position.xy, StatedHeight{position.height, position.kind}};
}

/// Warns of a typed end that looks like longitude and latitude on a map of lengths. An error where its height
/// is above the ground, which is not there.
Status checkPlaceOf(const std::string& option, const std::string& text, const SightSite& site, bool isLonLat,
                    const TerrainModel& model, const Session& session) {
  const std::string hint = isLonLat ? std::string() : degreesHint(site.stated, model);
  if (hint.empty()) return {};
  const std::string culprit = fmt::format("{} {}", option, text);
  if (site.height && site.height->kind == HeightKind::aboveGround)
    return failure(ErrorCode::invalidData, "lies outside the DEM: " + hint, culprit);
  session.warn(fmt::format("{} lies outside the DEM: {}", culprit, hint));
  return {};
}

/// Moves longitudes by whole turns to the DEM.
void turnLongitudes(SightPairs& pairs, const TerrainModel& model) {
  const LongitudeTurns turns(model);
  for (auto& row : pairs.rows)
    for (SightSite& site : row) site.xy = turns(site.xy);
}

Result<SightPairs> readRows(const LosArguments& a, const TerrainModel& model, Session& session) {
  const Georeference& dem = model.georeference;
  const PointTableOptions options{.layer = a.layer, .lonLat = a.sight.lonLat};
  if (!a.pairs.empty()) {
    auto pairs = readSightPairs(inputPath(a.pairs), dem, options, session.context());
    if (!pairs) return pairs;
    session.warn(pairs->warnings, a.pairs);
    turnLongitudes(*pairs, model);
    return pairs;
  }
  ARETE_TRY(const auto toDem, transformOfPlaces(a.sight.lonLat, model));
  std::optional<SightSite> from, to;
  for (const auto& [option, text, site] : {std::tuple{"--from", &a.from, &from}, {"--to", &a.to, &to}}) {
    if (text->empty()) continue;
    // An observer on the ground sees next to nothing, so its height must be stated; a target may be a place.
    const bool isTarget = site == &to;
    ARETE_TRY(auto read,
              siteOf(option, *text, toDem, heightUnitOf(dem), isTarget || !a.observerHeight.empty()));
    if (isTarget && a.isTargetOnGround()) read.height = StatedHeight{};
    ARETE_CHECK(checkPlaceOf(option, *text, read, a.sight.lonLat, model, session));
    *site = read;
  }
  if (a.points.empty()) {
    SightPairs one;
    one.crsWkt = a.sight.lonLat ? toDem.sourceWkt() : dem.crsWkt;
    one.rows.push_back({*from, *to});
    return one;
  }
  auto sites = readSightSites(inputPath(a.points), dem, options, session.context());
  if (!sites) return sites;
  session.warn(sites->warnings, a.points);
  turnLongitudes(*sites, model);
  // `stated` of the typed end becomes a place in the CRS of the sites, so that a table has one CRS.
  SightSite fixed = from ? *from : *to;
  if (sites->crsWkt != (a.sight.lonLat ? toDem.sourceWkt() : dem.crsWkt)) {
    const auto there = CrsTransform::between(dem.crsWkt, sites->crsWkt);
    const auto stated = there ? (*there)(fixed.xy) : std::nullopt;
    fixed.stated = stated.value_or(Vec2{std::nan(""), std::nan("")});
  }
  for (auto& row : sites->rows) row = from ? std::array{fixed, row[0]} : std::array{row[0], fixed};
  return sites;
}

/// What states each end, where that is an option.
std::array<std::string, 2> typedEnds(const LosArguments& a) {
  return {a.from.empty() ? "" : "--from " + a.from, a.to.empty() ? "" : "--to " + a.to};
}

/// Applies the heights of the options to ends that have none.
Status addUsualHeights(const LosArguments& a, const DataUnit& unit, SightPairs& pairs) {
  for (const auto& [end, option, text] :
       {std::tuple{0, "--observer-height", &a.observerHeight}, {1, "--target-height", &a.targetHeight}}) {
    if (text->empty()) continue;
    const auto height = readHeightText(*text, &unit);
    if (!height)
      return failure(height.error().code, height.error().message, fmt::format("{} {}", option, *text));
    for (auto& row : pairs.rows)
      if (!row[end].height) row[end].height = *height;
  }
  return {};
}

Result<SightPathOptions> optionsOf(const LosArguments& a, double maxError, const TerrainModel& model,
                                   Session& session) {
  SightPathOptions options;
  options.sight.nodata = a.sight.nodata;
  options.sight.maxError = maxError;
  options.frequencyMegahertz = a.frequency;
  if (a.clutter.empty()) return options;
  ARETE_TRY(auto clutter, readClutter(a.clutter, model, session.context()));
  options.clutter = std::move(clutter);
  options.clutter.freeMetres = a.clutterFree;
  return options;
}

Status reportOne(const LosArguments& a, const SightResults& results, Json json, Session& session) {
  // A single line has no table, so its error is the command's.
  if (const Error* error = results.errorOf(0)) return tl::unexpected(*error);
  json.update(results.jsonOf(0));
  json["targetOnGround"] = a.isTargetOnGround();
  session.say(results.textOf(0) +
              (a.isTargetOnGround() ? "target       on the ground, as --to states no height\n" : ""));
  session.answer(json);
  return {};
}

Status writeAnswers(const std::string& path, const LineTable& table, const Json& json, Session& session) {
  if (!isJson(path)) return writeLineTable(path, table, session.context());
  ARETE_TRY(auto file, FileWriter::create(path));
  file.write(json.dump(1) + "\n");
  return file.finish();
}

Status reportMany(const LosArguments& a, const SightResults& results, Json json, Session& session) {
  if (a.isTargetOnGround()) session.note("--to states no height: the target is on the ground");
  const std::size_t lines = results.rows.count();
  const SightCounts counts = results.counts();
  json["lines"] = lines;
  json["visible"] = counts.visible;
  json["blocked"] = counts.blocked;
  json["unknown"] = counts.unknown;
  json["undecided"] = counts.undecided;
  json["failed"] = counts.failed;
  const PointAttributes columns = results.columns();
  const auto ends = results.ends();
  const LineTable table{.layer = "sight",
                        .crsWkt = results.pairs.crsWkt,
                        .ends = ends,
                        .inputs = &results.pairs.attributes,
                        .results = &columns,
                        .existing = a.existing};
  // Every row is in the answer or in a .json file, never in both.
  if (a.output.empty() || isJson(a.output)) {
    Json all = Json::array();
    for (std::size_t i = 0; i < lines; ++i) all.push_back(results.jsonOf(i));
    json["answers"] = std::move(all);
  }
  if (a.output.empty()) {
    std::string text;
    forCsvLines(table, [&](std::string_view line) { text += line; });
    session.say(text);
  } else {
    ARETE_CHECK(writeAnswers(a.output, table, json, session));
    json.erase("answers");
    json["file"] = a.output;
    session.say(fmt::format("{}: {}: {}\n", a.output, grouped(lines, "line of sight", "lines of sight"),
                            counts.text()));
  }
  session.answer(json);
  // The command fails if every row does; otherwise failed rows are a warning.
  if (counts.failed == lines)
    return failure(ErrorCode::invalidData, fmt::format("no line of sight has both ends: {}",
                                                       withOptionNames(*results.errorOf(0)).describe()));
  if (counts.failed > 0)
    session.warn(fmt::format("{} of {} no answer; the column error says why", grouped(counts.failed),
                             grouped(lines, "line has", "lines have")));
  return {};
}

/// What is reported, and of what.
struct LosReport {
  const TerrainModel& model;  ///< its root is enough
  const SightPairs& pairs;
  const SightEarth& earth;
  const TerrainError& maxError;
  const OpenScene* scene = nullptr;  ///< whose meshes are in the way too
};
Status reportLos(const LosArguments& a, const LosReport& report, LosAnswers& answers, Session& session);

Status checkOutputOf(const LosArguments& a, const std::vector<std::string>& inputs) {
  return a.output.empty() ? Status{} : checkOutput("--output", a.output, inputs);
}

/// Over the first terrain of a scene, and through its meshes.
Status runLosOfScene(const LosArguments& a, Session& session) {
  if (isAboveZero(a.maxError))
    return failure(ErrorCode::usage,
                   "requires a model of terrain alone; a scene is answered at full resolution",
                   "--max-error");
  ARETE_TRY(auto file, readScene(a.model));
  std::vector<std::string> inputs = {a.model, a.pairs, a.points, a.clutter};
  for (const SceneObject& object : file.objects) inputs.push_back(object.file);
  ARETE_CHECK(checkOutputOf(a, inputs));
  ARETE_TRY(const OpenScene scene, openScene(std::move(file), session.context()));
  session.warn(scene.warnings, a.model);
  // Without terrain lines lead through the scene's space, and nothing else is known to be below them.
  TerrainModel nothing;
  nothing.isRaster = false;
  nothing.georeference.verticalUnit = "m";
  if (!scene.terrain && !scene.file.crs.empty())
    return failure(ErrorCode::invalidData,
                   "has a CRS and no terrain: lines of sight without terrain are in plain metres", a.model);
  const TerrainModel& model = scene.terrain ? *scene.terrainModel() : nothing;
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
    if (!scene.surfaceOf(i) && i != scene.terrain)
      session.warn(fmt::format("'{}' is further terrain, which lines of sight do not regard",
                               scene.file.objects[i].name));
  ARETE_CHECK(checkGroundUnits(model.georeference, {a.clutterFreeWithUnit}));
  ARETE_TRY(auto pairs, readRows(a, model, session));
  ARETE_CHECK(addUsualHeights(a, heightUnitOf(model.georeference), pairs));
  const TerrainError exact;
  ARETE_TRY(auto options, optionsOf(a, 0, model, session));
  if (!scene.terrain) {
    options.sight.nodata = NodataSight::clear;
    for (auto& row : pairs.rows)
      for (SightSite& site : row)
        if (site.height && site.height->kind == HeightKind::aboveGround)
          site.height->kind = HeightKind::seaLevel;  // z, from the scene's own zero
  }
  ARETE_TRY(const auto earth, a.sight.makeEarth(model, session));
  ARETE_TRY(auto answers,
            answerLines({pairs, typedEnds(a), options, *earth, a.method, a.model}, model, session.context()));
  return reportLos(a, {model, pairs, *earth, exact, &scene}, answers, session);
}

Status runLos(const LosArguments& a, Session& session) {
  ARETE_CHECK(checkArguments(a));
  if (isSceneFile(a.model)) return runLosOfScene(a, session);
  ARETE_TRY(const AmtFile file, openTerrain(a.model));
  ARETE_TRY(const TerrainModel outline, outlineOf(file, session.context()));
  ARETE_CHECK(checkGroundUnits(outline.georeference, {a.clutterFreeWithUnit}));
  ARETE_CHECK(checkOutputOf(a, {a.model, a.pairs, a.points, a.clutter, outline.source}));
  ARETE_TRY(auto pairs, readRows(a, outline, session));
  ARETE_CHECK(addUsualHeights(a, heightUnitOf(outline.georeference), pairs));
  ARETE_TRY(const TerrainError maxError, terrainErrorOf(a.maxError, file, session));
  ARETE_TRY(const auto options, optionsOf(a, maxError.value, outline, session));
  ARETE_TRY(const auto earth, a.sight.makeEarth(outline, session));
  ARETE_TRY(auto answers,
            answerLines({pairs, typedEnds(a), options, *earth, a.method, a.model}, file, outline, session));
  return reportLos(a, {outline, pairs, *earth, maxError}, answers, session);
}

Status reportLos(const LosArguments& a, const LosReport& report, LosAnswers& answered, Session& session) {
  const auto& [model, pairs, earth, maxError, scene] = report;
  const SightRows& rows = answered.rows;
  auto& answers = answered.answers;
  warnOfBuriedEnds(answered, model.georeference.verticalUnit, session);
  std::vector<std::string> blockedBy;
  if (scene) {
    ARETE_TRY(blockedBy, addMeshesInTheWay(*scene, model, rows.paths, earth, answers, session.context()));
  }
  const SightResults results{.pairs = pairs,
                             .rows = rows,
                             .answers = answers,
                             .model = model,
                             .hasFresnel = a.frequency > 0,
                             .hasTolerance = maxError.value > 0,
                             .fresnel = a.fresnel,
                             .blockedBy = blockedBy};
  Json json = {{"model", a.model},
               {"verticalUnit", model.georeference.verticalUnit},
               {"earth", a.sight.earthName(model)},
               {"refraction", a.sight.refractionJson(model)},
               {"nodata", std::string(toString(a.sight.nodata))}};
  maxError.addTo(json);
  json["method"] = std::string(toString(answered.method));
  if (maxError.relief)
    session.note(fmt::format("terrain within {}", maxError.text(model.georeference.verticalUnit)));
  const bool isOne = a.pairs.empty() && a.points.empty() && a.output.empty();
  return isOne ? reportOne(a, results, std::move(json), session)
               : reportMany(a, results, std::move(json), session);
}

}  // namespace

void addLosCommand(CLI::App& app, Session& session) {
  auto arguments = std::make_shared<LosArguments>();
  CLI::App* command = session.addCommand(
      app, "los", "Compute whether places see each other",
      "  arete los dem.amt --from 409050,3801450,10 --to 411000,3795000,1500msl\n"
      "  arete los dem.amt --from 409050,3801450,10 --to 411000,3795000      to the ground there\n"
      "  arete los dem.amt --from 8.55,46.6,30 --to 8.7,46.55,10 --lonlat --frequency 2400\n"
      "  arete los dem.amt --pairs links.gpkg -o answers.gpkg --observer-height 30 --target-height 10\n"
      "  arete los scene.json --pairs links.csv -o seen.gpkg     through buildings and masts\n"
      "  arete los dem.amt --from 409050,3801450,10 --points huts.gpkg --target-height 2 -o seen.csv\n"
      "\n"
      "The answer is that of full resolution. H is in the DEM's unit: above ground (agl), msl or ell.\n"
      "See docs/topics/visibility.md.",
      [arguments](Session& s) { return runLos(*arguments, s); });
  command
      ->add_option("FILE.amt", arguments->model,
                   "Multitriangulation, or a scene.json whose meshes are in the way too")
      ->required()
      ->type_name("");
  command->add_option("--from,--observer", arguments->from, "Position of the observer, in the DEM's CRS")
      ->type_name("X,Y,H");
  command
      ->add_option("--to,--target", arguments->to,
                   "Position of the target; without H it is on the ground, or at --target-height")
      ->type_name("X,Y[,H]");
  // The ends may be stated in several ways; checkArguments() refuses those that do not go together.
  command
      ->add_option(
          "--pairs", arguments->pairs,
          "Both ends from a file: a layer of lines, or a table with x1,y1,h1,x2,y2,h2; or x1,y1,h1 (or "
          "points), azimuth (degrees) and range (metres)")
      ->type_name("FILE");
  command
      ->add_option("--points", arguments->points,
                   "Other ends of the lines from --from, or to --to: CSV or a layer of points")
      ->type_name("FILE");
  command->add_option("--layer", arguments->layer, "Layer, where the file has several")->type_name("NAME");
  command
      ->add_option("--observer-height", arguments->observerHeight,
                   "Height of first ends without one in the file")
      ->type_name("H");
  command
      ->add_option("--target-height", arguments->targetHeight,
                   "Height of second ends without one in the file")
      ->type_name("H");
  command
      ->add_option(
          "-o,--output", arguments->output,
          "Write the answers (.csv, .gpkg or .json): the columns of the file, verdict, distance, azimuth, "
          "elevation, clearance, obstruction (default: CSV on stdout)")
      ->type_name("FILE");
  addOverwriteTo(*command, arguments->existing);
  arguments->sight.addLonLatTo(*command);
  arguments->sight.addNodataTo(*command);
  addTerrainErrorTo(*command, arguments->maxError,
                    "Stop refining at this error, so that answers may be undecided", false);
  command
      ->add_option("--method", arguments->method,
                   "Algorithm; all give the same answer: auto (default), descent, pyramid, scan, embree")
      ->transform(oneOf<SightMethod>({{"auto", SightMethod::automatic},
                                      {"descent", SightMethod::descent},
                                      {"pyramid", SightMethod::pyramid},
                                      {"scan", SightMethod::scan},
                                      {"embree", SightMethod::embree}}))
      ->type_name("METHOD");
  arguments->sight.addEarthTo(*command);
  // A part of the zone needs a frequency, and a free radius needs clutter: neither means anything alone.
  const std::string radio = "Radio";
  CLI::Option* frequency =
      command
          ->add_option("--frequency", arguments->frequency,
                       "Compute how much of the first Fresnel zone is clear at this frequency")
          ->check(megahertz())
          ->type_name("MHZ")
          ->group(radio);
  command
      ->add_option("--fresnel", arguments->fresnel,
                   "Part of the first Fresnel zone that must be clear (default 0.6)")
      ->check(finiteAtLeast(0))
      ->needs(frequency)
      ->type_name("PART")
      ->group(radio);
  CLI::Option* clutter =
      command
          ->add_option("--clutter", arguments->clutter,
                       "Clutter on the terrain: one height, or a raster of heights, in the DEM's unit")
          ->type_name("H|RASTER")
          ->group(radio);
  command
      ->add_option("--clutter-free", arguments->clutterFree,
                   "Radius around both ends without clutter, in metres or with a unit (default 100)")
      ->transform(groundLength("--clutter-free", arguments->clutterFreeWithUnit))
      ->check(finiteAtLeast(0))
      ->needs(clutter)
      ->type_name("D")
      ->group(radio);
}

}  // namespace arete

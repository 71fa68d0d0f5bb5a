// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every option of every command that takes a model of either kind, as CLI11 declares them: with a model of
// the other kind it is refused by name or answered. Nothing is ignored in silence. The commands run in this
// process.
#include "cli/arguments/option_kinds.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <sstream>

#include "cli/ball_fixture.h"
#include "cli/commands/program.h"
#include "cli/manual/declarations.h"
#include "full_run.h"
#include "io/geo/dem/raster_reader.h"

namespace arete::cli_test {
namespace {

using Words = std::vector<std::string>;

Words split(const std::string& text) {
  std::istringstream stream(text);
  Words words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

/// How an option is tried.
struct Trial {
  std::string words;                           ///< the option and a plausible value
  std::string with = "";                       ///< what it needs beside it, or has an effect on
  std::optional<std::string> ofSurface{};      ///< other words for a surface
  std::optional<std::string> withOfSurface{};  ///< other words beside it for a surface
};

using Trials = std::map<std::string, Trial>;

/// A command on a model of each kind; "$" stands for a name that no other run has.
struct Tried {
  std::string onTerrain, onSurface;
  Trials trials;
  /// Options without an effect that shows here, and why.
  std::map<std::string, std::string> unseen = {};
};

const Trials kReading = {{"--band", {"--band 1"}},          {"--layer", {"--layer x"}},
                         {"--z-field", {"--z-field z"}},    {"--same-place", {"--same-place mean"}},
                         {"--nodata", {"--nodata -9999"}},  {"--vertical-unit", {"--vertical-unit m"}},
                         {"--positive", {"--positive up"}}, {"--crs", {"--crs EPSG:32611"}}};

Trials withReading(Trials trials, const std::string& with = "") {
  for (auto [option, trial] : kReading) {
    trial.with = with;
    trials.try_emplace(option, trial);
  }
  return trials;
}

const std::map<std::string, Tried>& triedCommands() {
  static const std::map<std::string, Tried> tried = {
      {"build",
       {"build dem.tif -o $.amt", "build ball.obj -o $.amt",
        withReading({{"--as", {"--as surface", "", "--as terrain --same-place max"}},
                     {"--packed", {"--packed"}},
                     {"--paged", {"--paged"}},
                     {"--position-bits", {"--position-bits 12", "--packed"}},
                     {"--drop-attributes", {"--drop-attributes texcoord"}},
                     {"--attributes", {"--attributes"}},
                     {"--shape", {"--shape fidelity"}},
                     {"--ratio", {"--ratio 3"}},
                     {"--max-degree", {"--max-degree 6"}},
                     {"--min-aspect", {"--min-aspect 0.1", "--shape fidelity"}},
                     {"--rim-tolerance", {"--rim-tolerance 1"}},
                     {"--features", {"--features 3"}},
                     {"--feature-persistence", {"--feature-persistence 5%"}},
                     {"--no-features", {"--no-features"}},
                     {"--fixed", {"--fixed peaks.csv"}},
                     {"--crease-angle", {"--crease-angle 30"}},
                     {"--keep-borders", {"--keep-borders"}},
                     {"--displacement", {"--displacement"}}})}},
      {"info", {"info dem.amt", "info ball.amt", {{"--curve", {"--curve 2"}}, {"--at", {"--at 1%,2%"}}}}},
      {"extract",
       {"extract dem.amt -o $.ply",
        "extract ball.amt -o $.ply",
        {{"--format", {"--format obj", "--max-error 2%"}},
         {"--packed", {"--packed", "--format glb --max-error 2%"}},
         {"--position-bits", {"--position-bits 12", "--packed --format glb --max-error 2%"}},
         {"--levels", {"--levels", "--format glb --max-error 1%,2%"}},
         {"--flip-v", {"--flip-v", "--max-error 2%"}},
         {"--overwrite", {"--overwrite", "--max-error 2%"}},
         {"--to-crs", {"--to-crs EPSG:3857", "--max-error 2%"}},
         {"--metric", {"--metric", "--max-error 2%"}},
         {"--max-error", {"--max-error 5%", "--max-triangles 100%"}},
         {"--max-triangles", {"--max-triangles 50%", "--max-error 0"}},
         {"--method", {"--method saturated", "--max-error 1%", {}, "--max-error 1% --region 0,0,1,0.3"}},
         {"--fit", {"--fit error", "--max-error 2%", "--fit rms"}},
         {"--region", {"--region BOX", "--max-error 2%", "--region 0,0,1,0.3"}},
         {"--region-crs",
          {"--region-crs EPSG:4326", "--max-error 2% --region BOX", {}, "--max-error 2% --region 0,0,1,0.3"}},
         {"--distance",
          {"--distance 2", "--max-error 2% --region BOX", {}, "--max-error 2% --region 0,0,1,0.3"}},
         {"--outside-error",
          {"--outside-error 1%", "--max-error 0.2% --region BOX", {}, "--max-error 0.2% --region 0,0,1,0.3"}},
         {"--focus", {"--focus PLACE --error-growth 1", "--max-error 2%", "--focus 1,0,0 --error-growth 1"}},
         {"--error-growth",
          {"--error-growth 1", "--max-error 2% --focus PLACE", {}, "--max-error 2% --focus 1,0,0"}},
         {"--camera", {"--camera PLACE,50agl", "--max-triangles 50%", "--camera 3,0,0,0,0,0"}},
         {"--look", {"--look 90,-5", "--camera PLACE,50agl", {}, "--camera 3,0,0,0,0,0"}},
         {"--fov", {"--fov 5", "--camera PLACE,50agl", {}, "--camera 3,0,0,0,0,0"}},
         {"--parallel-height",
          {"--parallel-height 1000", "--camera PLACE,50agl", {}, "--camera 3,0,0,0,0,0"}},
         {"--viewport", {"--viewport 40x30", "--camera PLACE,50agl", {}, "--camera 3,0,0,0,0,0"}},
         {"--pixel-error", {"--pixel-error 40", "--camera PLACE,50agl", {}, "--camera 3,0,0,0,0,0"}},
         {"--lonlat", {"--lonlat", "--camera PLACE,50agl", {}, "--camera 3,0,0,0,0,0"}},
         {"--deadline", {"--deadline 1e6", "--max-error 2%"}},
         {"--order", {"--order depth", "--max-triangles 50%"}},
         {"--certificate", {"--certificate $.json", "--max-error 2%"}},
         {"--error-raster", {"--error-raster $e.tif", "--max-error 2%"}},
         {"--map", {"--map $.csv", "--max-error 2%"}},
         {"--drop-parts", {"--drop-parts 1%", "--max-error 2%"}},
         {"--drop-attributes", {"--drop-attributes texcoord", "--max-error 2%"}},
         {"--attribute-error", {"--attribute-error uv:0.1", "--max-error 2%"}},
         {"--importance", {"--importance heat", "--max-error 2%"}},
         {"--normals", {"--normals smooth", "--format glb --max-error 2%"}},
         {"--crease-angle", {"--crease-angle 30 --normals smooth", "--format glb --max-error 2%"}},
         {"--both-ways", {"--both-ways", "--max-error 2%"}},
         {"--no-displacement", {"--no-displacement", "--max-error 2%"}}},
        {{"--overwrite", "geopackage_test.cpp sees what becomes of other layers"},
         {"--error-growth", "it is required with --focus"},
         {"--deadline", "surface_query_test.cpp ends before it"}}}},
      {"validate",
       {"validate dem.amt",
        "validate ball.amt",
        withReading({{"--fronts", {"--fronts 2"}},
                     {"--seed", {"--seed 2"}},
                     {"--full", {"--full"}},
                     {"--against", {"--against dem.tif"}}},
                    "--against dem.tif"),
        {{"--full", "all triangles of a model as small are checked without it"}}}},
      {"convert",
       {"convert dem.amt -o $.amt",
        "convert ball.amt -o $.amt",
        {{"--packed", {"--packed"}},
         {"--paged", {"--paged"}},
         {"--position-bits", {"--position-bits 12", "--packed"}},
         {"--flip-v", {"--flip-v"}},
         {"--format", {"--format ply"}},
         {"--overwrite", {"--overwrite"}},
         {"--crs", {"--crs EPSG:32611"}},
         {"--drop-attributes", {"--drop-attributes texcoord"}},
         {"--normals", {"--normals flat"}},
         {"--crease-angle", {"--crease-angle 30 --normals smooth"}},
         {"--up", {"--up y"}},
         {"--unit", {"--unit mm"}},
         {"--to-crs", {"--to-crs utm"}},
         {"--metric", {"--metric"}}},
        {{"--overwrite", "an .amt is replaced with or without it"}}}},
      {"measure",
       {"measure tin.ply dem.tif", "measure small.ply ball.amt --samples 50",
        withReading({{"--expect", {"--expect 1000"}},
                     {"--allow-covered-nodata", {"--allow-covered-nodata"}},
                     {"--tin-crs", {"--tin-crs EPSG:32611"}},
                     {"--region", {"--region BOX"}},
                     {"--region-crs", {"--region-crs EPSG:4326", "--region BOX"}},
                     {"--distance", {"--distance 2", "--region BOX"}},
                     {"--error-raster", {"--error-raster $e.tif"}},
                     {"--as", {"--as points"}},
                     {"--both-ways", {"--both-ways"}},
                     {"--samples", {"--samples 60", "", ""}},
                     {"--seed", {"--seed 2"}},
                     {"--attributes", {"--attributes"}},
                     {"--expect-attribute", {"--expect-attribute uv:9"}},
                     {"--error-mesh", {"--error-mesh $.ply"}}})}},
      {"view",
       {"view dem.amt --headless --screenshot $.png --size 48x32",
        "view ball.amt --headless --screenshot $.png --size 48x32",
        {{"--camera", {"--camera PLACE,50agl", "", "--camera 3,0,0,0,0,0"}},
         {"--lonlat", {"--lonlat", "--camera PLACE,50agl"}},
         {"--home", {"--home south"}},
         {"--path", {"--path flight.json", "", "--path turn.json"}},
         {"--round", {"--round"}},
         {"--up", {"--up y"}},
         {"--turn", {"--turn 30,20,10"}},
         {"--beside", {"--beside dem.amt", "", "--beside ball.amt"}},
         {"--distances", {"--distances", "", "--distances --beside ball.amt"}},
         {"--parallel", {"--parallel"}},
         {"--parallel-height", {"--parallel-height 3"}},
         {"--without", {"--without materials"}},
         {"--shading", {"--shading flat"}},
         {"--light", {"--light sky"}},
         {"--sides", {"--sides front"}},
         {"--pixel-error", {"--pixel-error 20"}},
         {"--max-triangles", {"--max-triangles 60%", "--pixel-error 0.001"}},
         {"--cut", {"--cut processor"}},
         {"--frame-time", {""}},
         {"--deadline", {"--deadline 20", "--cut processor"}},
         {"--no-geomorph", {"--no-geomorph"}},
         {"--page-memory", {""}},
         {"--page-budget", {""}},
         {"--color", {"--color error"}},
         {"--ramp", {"--ramp grey"}},
         {"--ramp-mode", {"--ramp-mode nearest"}},
         {"--range", {"--range 0,1000"}},
         {"--sea-level", {"--sea-level 100"}},
         {"--drape", {"--drape dem.tif"}},
         {"--layer", {"--layer a.gpkg"}},
         {"--drape-bands", {"--drape-bands 1", "--drape dem.tif"}},
         {"--contours", {"--contours 1"}},
         {"--sun", {"--sun 90,10"}},
         {"--ground-memory", {"--ground-memory 64"}},
         {"--haze", {"--haze 1"}},
         {"--exaggeration", {"--exaggeration 3"}},
         {"--curvature", {"--curvature"}},
         {"--show", {"--show axes"}},
         {"--wireframe", {"--wireframe"}},
         {"--unshaded", {"--unshaded"}},
         {"--no-decorations", {"--no-decorations"}},
         {"--headless", {""}},
         {"--size", {""}},
         {"--samples", {"--samples 1"}},
         {"--screenshot", {""}},
         {"--frames", {"--frames $", "--round"}},
         {"--fps", {"--fps 0.5", "--round --frames $"}},
         {"--film", {"--film $.mp4", "--round --frames $"}},
         {"--figures", {"--figures $.json", "--round --frames $"}}},
        {{"--round", "it asks for frames"},
         {"--frame-time", "it is for the window"},
         {"--page-memory", "it is for files in pages"},
         {"--page-budget", "it is for flights over files in pages"},
         {"--sides", "of a closed ball no inside is seen"},
         {"--without", "the ball has none of these"},
         {"--frames", "view_test.cpp draws flights, which take seconds"},
         {"--fps", "the same"},
         {"--film", "the same"},
         {"--figures", "the same"}}}},
  };
  return tried;
}

/// Commands that no surface is given to: they refuse the file by its name, whatever the options.
const std::map<std::string, std::string> kOfTerrainAlone = {
    {"height", "height ball.amt --at 0,0"},
    {"los", "los ball.amt --from 0,0,1 --to 1,1,1"},
    {"profile", "profile ball.amt --along 0,0:1,1"},
    {"viewshed", "viewshed ball.amt --observer 0,0,1 -o $.tif"}};
/// Commands that take no model.
const std::set<std::string> kWithoutModel = {
    "", "mesh", "mesh info", "mesh repair", "mesh crop", "mesh decimate", "mesh place", "demo", "manual"};

/// The kind that the help of an option begins with.
std::optional<ModelKind> kindInHelp(const CLI::Option& option) {
  const std::string text = option.get_description();
  if (text.starts_with("Of terrain: ") || text.starts_with("Against a DEM: ")) return ModelKind::terrain;
  if (text.starts_with("Of a surface: ") || text.starts_with("Against a mesh: ")) return ModelKind::surface;
  return std::nullopt;
}

class OptionsOfBothKinds : public Balls {
 protected:
  void SetUp() override {
    Balls::SetUp();
    before_ = fs::current_path();
    fs::current_path(folder_ / "here");
    makeRaster("dem.tif", "fractal", 30, 30);
    declareProgram(program_, session_);
    for (const DeclaredCommand& command : declaredCommands(program_))
      commands_[command.joined(" ")] = command.app;
    const RasterHeightfield field = readRaster(path("dem.tif"))->heightfield;
    const Vec2 low = field.georeference.toSource(5, 20), high = field.georeference.toSource(20, 5),
               middle = field.georeference.toSource(15.3, 15.4);
    box_ = fmt::format("{},{},{},{}", low.x, low.y, high.x, high.y);
    place_ = fmt::format("{},{}", middle.x, middle.y);
    for (const auto& [name, at, height] :
         {std::tuple{"flight.json", middle, 3000.0}, {"turn.json", Vec2{0, -3}, 0.0}}) {
      Json key = {{"x", at.x}, {"y", at.y}, {"height", height}, {"azimuth", 5}, {"pitch", 0}}, other = key;
      if (height > 0) key["pitch"] = other["pitch"] = -90;
      other["azimuth"] = 40;
      write(name, Json{{"frames", {key, other}}, {"duration", 1}}.dump());
    }
    for (const char* line :
         {"build dem.tif -o dem.amt", "build ball.obj -o ball.amt",
          "extract dem.amt -o tin.ply --max-error 2%", "extract ball.amt -o small.ply --max-error 2%"})
      ASSERT_EQ(call(line).code, 0) << line;
  }
  void TearDown() override {
    fs::current_path(before_);
    Balls::TearDown();
  }

  /// Runs a command in this process.
  Outcome call(const std::string& line) {
    const std::string tag = fmt::format("run{}x", ++runs_);
    Words words = split("arete " + line);
    for (std::string& word : words) {
      replace(word, "$", tag);
      replace(word, "BOX", box_);
      replace(word, "PLACE", place_);
    }
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const auto code = static_cast<int>(runProgram(static_cast<int>(words.size()), argv.data()));
    Outcome outcome{code, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
    replace(outcome.out, tag, "$");
    // What is written, and nothing that depends on the day.
    std::string made;
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator("."))
      if (entry.path().filename().string().starts_with(tag) && entry.is_regular_file())
        names.insert(entry.path().filename().string());
    for (const std::string& name : names) made += name.substr(tag.size()) + "\n" + read(name);
    replace(made, tag, "$");
    written_ = made;
    return outcome;
  }

  /// What a run has written: its files, or what it says where it writes no file.
  std::string answerOf(const Outcome& outcome) const { return written_.empty() ? outcome.out : written_; }

  const std::string& answerWithout(const std::string& base) {
    const auto [known, isNew] = answers_.try_emplace(base);
    if (isNew) {
      const Outcome outcome = call(base);
      EXPECT_EQ(outcome.code, 0) << base << "\n" << outcome.err;
      known->second = answerOf(outcome);
    }
    return known->second;
  }

  /// Tries every option of a command on both kinds.
  void tryAll(const std::string& name) {
    const Tried& tried = triedCommands().at(name);
    for (const CLI::Option* option : commands_.at(name)->get_options()) {
      const std::string text = option->get_name();
      if (option->get_group().empty() || option->get_group() == "Output" || option->get_positional() ||
          option->get_required() || text == "--output" || text == "--help" || text == "--help-all")
        continue;
      SCOPED_TRACE(name + " " + text);
      const auto found = tried.trials.find(text);
      if (found == tried.trials.end()) {
        ADD_FAILURE() << "a plausible value must be stated here for a new option";
        continue;
      }
      for (const ModelKind kind : {ModelKind::terrain, ModelKind::surface})
        tryOne(tried, *option, found->second, kind, !tried.unseen.contains(text));
    }
  }

  void tryOne(const Tried& tried, const CLI::Option& option, const Trial& trial, ModelKind kind,
              bool showsEffects) {
    const bool isSurface = kind == ModelKind::surface;
    const std::string with = isSurface ? trial.withOfSurface.value_or(trial.with) : trial.with,
                      words = isSurface ? trial.ofSurface.value_or(trial.words) : trial.words;
    if (words.empty()) return;  // every run states it
    const std::string base = fmt::format("{} {}", isSurface ? tried.onSurface : tried.onTerrain, with);
    const std::optional<ModelKind> only = kindInHelp(option);
    if (!only && !showsEffects) return;
    if (!draws_ && base.starts_with("view") && (!only || *only == kind)) return;
    const Outcome outcome = call(base + " " + words);
    const std::string answer = answerOf(outcome);
    const auto names = [&](const std::string& sentence) {
      for (const std::string& word : split(with + " " + words))
        if (word.starts_with("--") && sentence.find(word) != std::string::npos) return true;
      return false;
    };
    const bool isRefusedForItsKind =
        outcome.code == 2 && (outcome.err.find(": is for ") != std::string::npos ||
                              outcome.err.find(": requires a DEM, ") != std::string::npos ||
                              outcome.err.find(": requires another mesh, ") != std::string::npos);
    if (only && *only != kind) {
      EXPECT_TRUE(isRefusedForItsKind && names(outcome.err)) << base << " " << words << "\n" << outcome.err;
      return;
    }
    if (only) {
      EXPECT_FALSE(isRefusedForItsKind) << base << " " << words << "\n" << outcome.err;
      return;
    }
    if (outcome.code == 2) {
      EXPECT_NE(outcome.err.find(option.get_name()), std::string::npos) << outcome.err;
      return;
    }
    ASSERT_EQ(outcome.code, 0) << base << " " << words << "\n" << outcome.err;
    EXPECT_TRUE(answer != answerWithout(base)) << base << " " << words << ": the option has no effect";
  }

  CLI::App program_;
  Session session_;
  std::map<std::string, const CLI::App*> commands_;
  std::map<std::string, std::string> answers_;  // by command
  std::string box_, place_, written_;
  fs::path before_;
  int runs_ = 0;
  bool draws_ = false;  // for view

 private:
  static void replace(std::string& text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
      text.replace(at, from.size(), to);
  }
};

TEST_F(OptionsOfBothKinds, EveryCommandIsTriedOrTakesOneKindOfFileAlone) {
  for (const auto& [name, app] : commands_)
    EXPECT_EQ(triedCommands().count(name) + kOfTerrainAlone.count(name) + kWithoutModel.count(name), 1u)
        << name;
  for (const auto& [name, line] : kOfTerrainAlone) {
    const Outcome outcome = call(line);
    EXPECT_NE(outcome.code, 0) << line;
    EXPECT_NE(outcome.err.find("ball.amt: is of a surface"), std::string::npos) << outcome.err;
  }
}

TEST_F(OptionsOfBothKinds, ValuesForTheOtherKindAreRefusedByName) {
  const auto refused = [&](const std::string& line, const std::string& culprit) {
    const Outcome outcome = call(line + " " + culprit);
    EXPECT_EQ(outcome.code, 2) << line << " " << culprit;
    EXPECT_NE(outcome.err.find(culprit + ": is for "), std::string::npos) << outcome.err;
  };
  refused("extract dem.amt -o $.ply --max-error 2%", "--fit rms");
  for (const char* word : {"triangles", "error", "unbiased"})
    refused("extract ball.amt -o $.ply --max-error 2%", fmt::format("--fit {}", word));
  refused("view dem.amt --headless --screenshot $.png", "--color material");
  for (const char* word : {"height", "slope", "aspect"})
    refused("view ball.amt --headless --screenshot $.png", fmt::format("--color {}", word));
}

TEST_F(OptionsOfBothKinds, WhatEveryCommandTakesIsForBoth) {
  for (const auto& [name, tried] : triedCommands()) {
    if (name == "view") continue;
    for (const std::string& base : {tried.onTerrain, tried.onSurface}) {
      Words words = split(
          base +
          " --json --quiet --progress --threads 2 --no-huge-pages --memory 2G --cache kept:1MB --confined");
      if (name == "extract") words.insert(words.end(), {"--max-error", "2%"});
      const Outcome outcome = run(words);  // --confined is for the whole process
      EXPECT_EQ(outcome.code, 0) << base << "\n" << outcome.err;
      EXPECT_FALSE(outcome.json().is_discarded()) << base << "\n" << outcome.out;
    }
  }
}

TEST_F(OptionsOfBothKinds, ATurnAroundASurfaceAsksForFrames) {
  for (const char* how : {"", " --headless --screenshot $.png"}) {
    const Outcome refused = call(fmt::format("view ball.amt --round{}", how));
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.err.find("--round: requires --frames"), std::string::npos) << refused.err;
  }
}

TEST_F(OptionsOfBothKinds, HowTheSourceIsReadNeedsASource) {
  const Outcome refused = call("validate dem.amt --band 1");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--band requires --against"), std::string::npos) << refused.err;
}

TEST(OptionKindsOfACommand, HelpBeginsWithTheKind) {
  CLI::App app;
  OptionKinds kinds;
  bool flag = false;
  const auto text = [&](const char* name, const char* description) {
    return kinds.ofTerrain(app.add_flag(name, flag, description))->get_description();
  };
  EXPECT_EQ(text("--a", "Place of a camera"), "Of terrain: place of a camera");
  EXPECT_EQ(text("--b", "GeoTIFF to write"), "Of terrain: GeoTIFF to write");
  EXPECT_EQ(text("--c", "CRS of the region"), "Of terrain: CRS of the region");
  EXPECT_EQ(text("--d", "X,Y are longitude and latitude"), "Of terrain: X,Y are longitude and latitude");
  EXPECT_EQ(kinds.ofSurfaces(app.add_flag("--e", flag, "All borders"))->get_description(),
            "Of a surface: all borders");
  EXPECT_TRUE(kinds.refuseOther(ModelKind::surface));
  app.parse(std::vector<std::string>{"--b"});
  EXPECT_TRUE(kinds.refuseOther(ModelKind::terrain));
  const Status refused = kinds.refuseOther(ModelKind::surface, "or not");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().describe(), "--b: is for terrain, and the file is of a surface (or not)");
}

TEST_F(OptionsOfBothKinds, OfBuildAreAnsweredOrRefused) {
  tryAll("build");
}
TEST_F(OptionsOfBothKinds, OfInfoAreAnsweredOrRefused) {
  tryAll("info");
}
TEST_F(OptionsOfBothKinds, OfExtractAreAnsweredOrRefused) {
  tryAll("extract");
}
TEST_F(OptionsOfBothKinds, OfValidateAreAnsweredOrRefused) {
  tryAll("validate");
}
TEST_F(OptionsOfBothKinds, OfConvertAreAnsweredOrRefused) {
  tryAll("convert");
}
TEST_F(OptionsOfBothKinds, OfMeasureAreAnsweredOrRefused) {
  tryAll("measure");
}
TEST_F(OptionsOfBothKinds, OfViewAreAnsweredOrRefused) {
  // Each picture takes a tenth of a second.
  draws_ = test::isFull() && call("view dem.amt --headless --screenshot $.png --size 8x8").code == 0;
  tryAll("view");
}

}  // namespace
}  // namespace arete::cli_test

// SPDX-License-Identifier: GPL-3.0-or-later
// The options that set the resolution of a TIN.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cli/cli_fixture.h"
#include "io/geo/dem/raster_reader.h"

namespace arete::cli_test {
namespace {

using Criteria = Cli;

/// Where the terrain of makeRaster() lies.
std::string place(const RasterHeightfield& field, double column, double row, const std::string& height) {
  const Vec2 p = field.georeference.toSource(column, row);
  return fmt::format("{},{}{}", p.x, p.y, height);
}

TEST_F(Criteria, ServesACameraAPlaceABudgetAndADeadline) {
  makeRaster("dem.tif", "fractal", 90, 70);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const RasterHeightfield field = readRaster(path("dem.tif"))->heightfield;
  const std::string camera = "--camera=" + place(field, 5, 60, ",20agl");
  const auto triangles = [&](const std::vector<std::string>& options) {
    std::vector<std::string> arguments = {"extract", "dem.amt", "-o", "t.ply", "--json"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.json()["exports"][0];
  };
  const Json fine = triangles({camera, "--look", "45,-10", "--pixel-error", "0.5"});
  const Json coarse = triangles({camera, "--look", "45,-10", "--pixel-error", "20"});
  EXPECT_GT(fine["triangles"], coarse["triangles"]);
  const Json inOne = triangles({camera + ",45,-10,60", "--pixel-error", "0.5"});
  EXPECT_EQ(fine["triangles"], inOne["triangles"]) << "the camera in one option";
  EXPECT_LE(fine["pixels"], 0.5);
  EXPECT_LE(coarse["pixels"], 20);
  const Json budget = triangles({camera, "--max-triangles", "1500", "--order", "two-queues"});
  EXPECT_LE(budget["triangles"], 1500);
  EXPECT_EQ(budget["complete"], false);
  const Json focus =
      triangles({"--max-error", "0.1", "--focus=" + place(field, 30, 30, ""), "--error-growth", "1"});
  EXPECT_LT(focus["triangles"], triangles({"--max-error", "0.1"})["triangles"]);
  const Json soon = triangles({"--max-error", "0", "--deadline", "1e6", "--order", "depth"});
  EXPECT_EQ(soon["triangles"], triangles({"--max-error", "0"})["triangles"]);
  EXPECT_EQ(soon["complete"], true);
}

TEST_F(Criteria, RefusesCriteriaThatContradictEachOther) {
  makeRaster("dem.tif", "fractal", 20, 20);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const auto refused = [&](const std::vector<std::string>& options, const std::string& names) {
    std::vector<std::string> arguments = {"extract", "dem.amt", "-o", "t.ply"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(names), std::string::npos) << outcome.err;
    EXPECT_FALSE(exists("t.ply"));
  };
  refused({}, "--deadline");
  refused({"--max-error", "1", "--camera", "1,2,3"}, "--camera");
  refused({"--camera=0,0,3msl,4,5", "--look", "6,7"}, "--look 6,7");
  refused({"--camera=0,0,3msl,4,5,60", "--fov", "50"}, "--fov");
  refused({"--max-error", "1", "--focus", "1,2"}, "--error-growth");
  refused({"--max-error", "1", "--distance", "4"}, "--region");
  refused({"--max-error", "1", "--order", "depth"}, "--order");
  refused({"--max-error", "1", "--deadline", "5", "--method", "saturated"}, "--deadline");
  refused({"--max-triangles", "500", "--order", "two-queues"}, "--camera");
  refused({"--max-error", "1", "--outside-error", "5"}, "--outside-error");
  refused({"--max-error", "1", "--lonlat"}, "--lonlat");
  refused({"--pixel-error", "1", "--max-error", "1"}, "--camera");
  EXPECT_EQ(run({"extract", "dem.amt", "-o", "t.ply", "--camera=-99999999,2,3"}).code, 4)
      << "above no terrain";
  EXPECT_EQ(run({"extract", "dem.amt", "-o", "t.tif", "--deadline", "5"}).code, 2) << "cannot be repeated";
}

TEST_F(Criteria, WhatComesFirstOfAnErrorAndABudgetEndsTheCut) {
  makeRaster("dem.tif", "fractal", 60, 50);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const auto one = [&](std::vector<std::string> options, const std::string& name = "t.ply") {
    options.insert(options.begin(), {"extract", "dem.amt", "-o", name, "--json"});
    const Outcome outcome = run(options);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.json()["exports"][0];
  };
  const Json alone = one({"--max-error", "2"});
  EXPECT_FALSE(alone.contains("endedBy"));
  const int needed = alone["triangles"];
  for (const std::vector<std::string>& more :
       {std::vector<std::string>{}, {"--method", "saturated"}, {"--fit", "triangles"}, {"--fit", "error"}}) {
    SCOPED_TRACE(more.empty() ? "" : more.back());
    std::vector<std::string> words = {"--max-error", "2", "--max-triangles", "100%"};
    words.insert(words.end(), more.begin(), more.end());
    const Json complete = one(words);
    EXPECT_EQ(complete["endedBy"], "maxError");
    EXPECT_LE(complete["promisedError"], 2);
    words[3] = std::to_string(needed / 3);
    const Json budget = one(words, "b.ply");
    EXPECT_EQ(budget["endedBy"], "maxTriangles");
    EXPECT_LE(budget["triangles"], needed / 3);
    EXPECT_GT(budget["promisedError"], 2);
    EXPECT_EQ(run({"measure", "b.ply", "dem.tif", "--expect", budget["promisedError"].dump(), "-q"}).code, 0);
  }
  // A format that rounds: the promise of a complete cut is the tolerance all the same.
  const Json rounded = one({"--max-error", "2", "--max-triangles", "100%"}, "t.stl");
  EXPECT_EQ(rounded["promisedError"], 2);
  EXPECT_EQ(run({"measure", "t.stl", "dem.tif", "--expect", "2", "-q"}).code, 0);
}

TEST_F(Criteria, TakesListsAndPercentagesOfTheWhole) {
  makeRaster("dem.tif", "fractal", 40, 30);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const RasterHeightfield field = readRaster(path("dem.tif"))->heightfield;
  double lowest = field.heights[0], highest = lowest;
  for (const double z : field.heights) {
    lowest = std::min(lowest, z);
    highest = std::max(highest, z);
  }
  const Json info = run({"info", "dem.amt", "--json", "--at", "10%"}).json();
  EXPECT_DOUBLE_EQ(info["relief"], highest - lowest);
  EXPECT_DOUBLE_EQ(info["curve"][0]["maxError"], (highest - lowest) / 10);
  const Json answer = run({"extract", "dem.amt", "-o", "t.ply", "--json", "--max-error", "5%,20 %",
                           "--max-triangles", "400,50%"})
                          .json();
  EXPECT_DOUBLE_EQ(answer["relief"], highest - lowest);
  ASSERT_EQ(answer["exports"].size(), 4u);
  EXPECT_DOUBLE_EQ(answer["exports"][0]["maxError"], (highest - lowest) / 20);
  EXPECT_EQ(answer["exports"][1]["maxTriangles"], info["finestTriangles"].get<int>() / 2);
  EXPECT_EQ(answer["exports"][3]["file"], "t_20%_50%.ply");
  const Outcome text = run({"extract", "dem.amt", "-o", "u.ply", "--max-error", "5%"});
  EXPECT_NE(text.out.find("% of the relief)"), std::string::npos) << text.out;
  EXPECT_EQ(run({"measure", "u.ply", "dem.tif", "--expect", "5%", "-q"}).code, 0);
  EXPECT_EQ(run({"measure", "u.ply", "dem.tif", "--expect", "0.01%", "-q"}).code, 5);
  const auto refused = [&](std::vector<std::string> options, const std::string& names) {
    options.insert(options.begin(), {"extract", "dem.amt", "-o", "no.ply"});
    const Outcome outcome = run(options);
    EXPECT_EQ(outcome.code, 2) << names;
    EXPECT_NE(outcome.err.find(names), std::string::npos) << outcome.err;
    EXPECT_FALSE(exists("no.ply"));
  };
  refused({"--max-triangles", "400,400"}, "has 400 twice");
  refused({"--max-triangles", "1.5"}, "not a whole number");
  refused({"--max-triangles", "0"}, "must be from 1");
  refused({"--max-triangles", "0.0001%"}, "less than one triangle");
  refused({"--max-triangles", "-5%"}, "below zero");
  refused({"--max-error", "5%,5%"}, "has 5% twice");
  refused({"--max-error", "inf%"}, "no share");
  refused({"--max-error", "5%", "--outside-error", "1%", "--region", "0,0,1e7,1e7"}, "--outside-error");
}

TEST_F(Criteria, TakesOnlyWholePixels) {
  makeRaster("dem.tif", "fractal", 20, 20);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const Outcome outcome =
      run({"extract", "dem.amt", "-o", "tin.ply", "--camera", "500100,5199900,100", "--viewport", "10.5x3"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_NE(outcome.err.find("--viewport 10.5x3: must be whole pixels"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace arete::cli_test

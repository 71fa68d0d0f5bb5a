// SPDX-License-Identifier: GPL-3.0-or-later
// A surface from a mesh to its levels of detail, as a user meets it.
#include <cmath>
#include <map>
#include <sstream>

#include "cli/ball_fixture.h"

namespace arete::cli_test {
namespace {

class SurfaceCommands : public Balls {};

TEST_F(SurfaceCommands, BuildInfoValidateAndExtract) {
  write("ball.mtl", "newmtl skin\nKd 1 0.5 0.25\nmap_Kd skin.png\n");
  write("skin.png", "\x89PNG\r\n\x1a\n not a real picture");
  const Outcome built = run({"build", "ball.obj", "-o", "ball.amt", "--json"});
  ASSERT_EQ(built.code, 0) << built.err;
  EXPECT_EQ(built.json()["kind"], "surface");
  EXPECT_EQ(run({"validate", "ball.amt"}).code, 0);
  const Json info = run({"info", "ball.amt", "--json"}).json();
  EXPECT_EQ(info["kind"], "surface");
  EXPECT_EQ(info["finestTriangles"], built.json()["finestTriangles"]);

  const Outcome two = run({"extract", "ball.amt", "-o", "out.obj", "--max-error", "1%,5%", "--json"});
  ASSERT_EQ(two.code, 0) << two.err;
  const double diagonal = two.json()["diagonal"];
  for (const auto& [file, share] : {std::pair{"out_1%.obj", 0.01}, std::pair{"out_5%.obj", 0.05}}) {
    ASSERT_TRUE(exists(file)) << file;
    const Outcome measured = run({"measure", file, "ball.obj", "--samples", "20000", "--json"});
    ASSERT_EQ(measured.code, 0) << measured.err;
    EXPECT_LE(measured.json()["fromSecond"]["maximum"].get<double>(), share * diagonal);
    const Json mesh = run({"mesh", "info", file, "--json"}).json();
    EXPECT_EQ(mesh["components"].size(), 1u);
    EXPECT_GT(mesh["seamEdges"], 0);
  }
  EXPECT_LT(two.json()["exports"][1]["triangles"], two.json()["exports"][0]["triangles"]);
  EXPECT_TRUE(exists("skin.png"));
}

TEST_F(SurfaceCommands, ABuildForetellsTheSizeOfTheFile) {
  write("large.obj", ball(60, 40));
  for (const bool isPacked : {false, true}) {
    std::vector<std::string> words = {"build", "large.obj", "-o", "large.amt", "--json"};
    if (isPacked) words.emplace_back("--packed");
    const Outcome outcome = run(words);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const double expected = outcome.json()["expectedBytes"][isPacked ? "packed" : "plain"];
    const double bytes = outcome.json()["bytes"];
    EXPECT_LT(std::abs(std::log(expected / bytes)), std::log(2.5)) << expected << " of " << bytes;
  }
}

TEST_F(SurfaceCommands, AFitLeavesLessOfTheDistanceAndKeepsTheTolerance) {
  std::string shape;  // without a texture, whose seam would stay
  std::istringstream lines(ball(24, 14));
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("v ") && !line.starts_with("f ")) continue;
    for (std::size_t at = 0; line[0] == 'f' && (at = line.find('/', at)) != std::string::npos;)
      line.erase(at, line.find_first_of(" \n", at) - at);
    shape += line + "\n";
  }
  write("shape.obj", shape);
  ASSERT_EQ(run({"build", "shape.obj", "-o", "shape.amt"}).code, 0);
  std::map<std::string, Json> both;
  for (const std::string fit : {"", "rms"}) {
    std::vector<std::string> words = {"extract",         "shape.amt", "-o",    "cut" + fit + ".ply",
                                      "--max-triangles", "120",       "--json"};
    if (!fit.empty()) words.insert(words.end(), {"--fit", fit});
    const Outcome cut = run(words);
    ASSERT_EQ(cut.code, 0) << cut.err;
    both[fit] = run({"measure", "cut" + fit + ".ply", "shape.obj", "--samples", "20000", "--json"}).json();
    EXPECT_LE(both[fit]["fromSecond"]["maximum"].get<double>(),
              cut.json()["exports"][0]["error"].get<double>());
  }
  EXPECT_LT(both["rms"]["fromSecond"]["rms"].get<double>(),
            0.75 * both[""]["fromSecond"]["rms"].get<double>());
  const Outcome kept =
      run({"extract", "shape.amt", "-o", "kept.ply", "--max-error", "0.05", "--fit", "rms", "--json"});
  ASSERT_EQ(kept.code, 0) << kept.err;
  EXPECT_LE(kept.json()["exports"][0]["error"].get<double>(), 0.05);
  EXPECT_LE(run({"measure", "kept.ply", "shape.obj", "--samples", "20000", "--json"})
                .json()["fromSecond"]["maximum"]
                .get<double>(),
            0.05);
}

TEST_F(SurfaceCommands, PackedFilesAnswerAsPlainOnesDo) {
  ASSERT_EQ(run({"build", "ball.obj", "-o", "plain.amt"}).code, 0);
  ASSERT_EQ(run({"build", "ball.obj", "-o", "packed.amt", "--packed"}).code, 0);
  const Outcome converted = run({"convert", "plain.amt", "-o", "too.amt", "--packed", "--json"});
  ASSERT_EQ(converted.code, 0) << converted.err;
  EXPECT_TRUE(converted.json()["isPacked"].get<bool>());
  EXPECT_EQ(read("packed.amt"), read("too.amt"));
  EXPECT_EQ(run({"validate", "packed.amt", "--full"}).code, 0);
  EXPECT_NE(run({"info", "packed.amt"}).out.find("a surface, packed"), std::string::npos);
  std::map<std::string, Json> answers;
  for (const std::string model : {"plain", "packed"}) {
    const Outcome cut = run({"extract", model + ".amt", "-o", model + ".ply", "--max-error", "2%", "--json"});
    ASSERT_EQ(cut.code, 0) << cut.err;
    answers[model] = cut.json()["exports"][0];
    for (const char* const key : {"file", "output", "seconds"}) answers[model].erase(key);
    // The finest surfaces are one.
    const Json apart = run({"measure", model + ".amt", "ball.obj", "--samples", "20000", "--json"}).json();
    EXPECT_LT(apart["fromFirst"]["maximum"].get<double>(), 1e-6);
    EXPECT_LT(apart["fromSecond"]["maximum"].get<double>(), 1e-6);
  }
  EXPECT_EQ(answers["plain"]["triangles"], answers["packed"]["triangles"]);
  const Json apart = run({"measure", "plain.ply", "packed.ply", "--samples", "20000", "--json"}).json();
  EXPECT_LT(apart["fromFirst"]["maximum"].get<double>(), 1e-9);
  EXPECT_LT(apart["fromSecond"]["maximum"].get<double>(), 1e-9);
}

TEST_F(SurfaceCommands, RoundedPositionsTakeFewerBytesAndAreSaid) {
  ASSERT_EQ(run({"build", "ball.obj", "-o", "packed.amt", "--packed"}).code, 0);
  ASSERT_EQ(run({"build", "ball.obj", "-o", "rounded.amt", "--packed", "--position-bits", "12"}).code, 0);
  EXPECT_LT(read("rounded.amt").size(), read("packed.amt").size());
  const Json info = run({"info", "rounded.amt", "--json"}).json();
  const double moved = info["positionError"];
  EXPECT_GT(moved, 0);
  EXPECT_LT(moved, 4.0 / 4096);
  EXPECT_EQ(run({"validate", "rounded.amt", "--full"}).code, 0);
  const Json cut =
      run({"extract", "rounded.amt", "-o", "cut.ply", "--max-error", "0.02", "--json"}).json()["exports"][0];
  const Json apart = run({"measure", "cut.ply", "ball.obj", "--samples", "20000", "--json"}).json();
  EXPECT_LE(apart["fromSecond"]["maximum"].get<double>(), cut["error"].get<double>());
  EXPECT_NE(run({"build", "ball.obj", "-o", "x.amt", "--position-bits", "12"}).err.find("requires --packed"),
            std::string::npos);
  EXPECT_EQ(run({"build", "ball.obj", "-o", "x.amt", "--packed", "--position-bits", "7"}).code, 2);
}

TEST_F(SurfaceCommands, DisplacedCutsAreNearerAtTheSameErrorUntilSwitchedOff) {
  ASSERT_EQ(run({"build", "ball.obj", "-o", "plain.amt"}).code, 0);
  const Outcome built = run({"build", "ball.obj", "-o", "ball.amt", "--displacement"});
  ASSERT_EQ(built.code, 0) << built.err;
  EXPECT_NE(built.out.find("displacement"), std::string::npos);
  ASSERT_EQ(run({"convert", "ball.amt", "-o", "packed.amt", "--packed"}).code, 0);
  for (const char* const model : {"ball.amt", "packed.amt"}) {
    EXPECT_EQ(run({"validate", model, "--full"}).code, 0);
    EXPECT_TRUE(run({"info", model, "--json"}).json()["displacement"].get<bool>());
  }
  EXPECT_FALSE(run({"info", "plain.amt", "--json"}).json()["displacement"].get<bool>());
  struct Extracted {
    Json said;
    double rms;
  };
  const auto extracted = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"extract", "-o", "x.ply", "--max-triangles", "60", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome cut = run(words);
    EXPECT_EQ(cut.code, 0) << cut.err;
    const Json apart = run({"measure", "x.ply", "ball.obj", "--samples", "20000", "--json"}).json();
    const Json said = cut.json()["exports"][0];
    EXPECT_LE(apart["fromSecond"]["maximum"].get<double>(), said["error"].get<double>() * (1 + 1e-6));
    return Extracted{said, apart["fromSecond"]["rms"].get<double>()};
  };
  const Extracted displaced = extracted({"ball.amt"}), packed = extracted({"packed.amt"}),
                  off = extracted({"ball.amt", "--no-displacement"}), plain = extracted({"plain.amt"}),
                  fitted = extracted({"ball.amt", "--fit", "rms"});
  EXPECT_TRUE(displaced.said["displaced"].get<bool>());
  EXPECT_FALSE(off.said["displaced"].get<bool>());
  EXPECT_FALSE(fitted.said["displaced"].get<bool>()) << "a fit places them itself";
  EXPECT_EQ(displaced.said["error"], off.said["error"]);
  EXPECT_LT(displaced.rms, 0.8 * off.rms);
  EXPECT_NEAR(packed.rms, displaced.rms, 1e-9);
  EXPECT_EQ(off.rms, plain.rms);
}

TEST_F(SurfaceCommands, ABudgetIsKeptOrRefusedWithTheLeastCountAndWhy) {
  ASSERT_EQ(run({"build", "ball.obj", "-o", "ball.amt"}).code, 0);
  const Outcome kept = run({"extract", "ball.amt", "-o", "out.ply", "--max-triangles", "100", "--json"});
  ASSERT_EQ(kept.code, 0) << kept.err;
  EXPECT_LE(kept.json()["exports"][0]["triangles"], 100);
  EXPECT_GE(kept.json()["exports"][0]["triangles"], 90);
  const Outcome refused = run({"extract", "ball.amt", "-o", "none.ply", "--max-triangles", "3"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("1 component, seams"), std::string::npos) << refused.err;
  EXPECT_FALSE(exists("none.ply"));
}

TEST_F(SurfaceCommands, WhatComesFirstOfAnErrorAndABudgetEndsTheCut) {
  ASSERT_EQ(run({"build", "ball.obj", "-o", "ball.amt"}).code, 0);
  const auto exports = [&](const std::string& errors, const std::string& budgets) {
    const Outcome outcome = run({"extract", "ball.amt", "-o", "out.ply", "--max-error", errors,
                                 "--max-triangles", budgets, "--json"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.json()["exports"];
  };
  const Json alone = run({"extract", "ball.amt", "-o", "out.ply", "--max-error", "2%", "--json"}).json();
  const int needed = alone["exports"][0]["triangles"];
  ASSERT_GT(needed, 40);
  const Json enough = exports("2%", std::to_string(needed))[0];
  EXPECT_EQ(enough["endedBy"], "maxError");
  EXPECT_EQ(enough["triangles"], needed);
  EXPECT_EQ(enough["complete"], true);
  EXPECT_LE(enough["errorPercent"], 2);
  const Json tooFew = exports("2%", std::to_string(needed - 2))[0];
  EXPECT_EQ(tooFew["endedBy"], "maxTriangles");
  EXPECT_LT(tooFew["triangles"], needed);
  EXPECT_EQ(tooFew["complete"], false);
  EXPECT_GT(tooFew["errorPercent"], 2);

  const Json product = exports("1%,2%", "40,100%");
  ASSERT_EQ(product.size(), 4u);
  std::set<std::string> names;
  for (const Json& each : product) names.insert(each["file"].get<std::string>());
  EXPECT_EQ(names,
            (std::set<std::string>{"out_1%_40.ply", "out_1%_100%.ply", "out_2%_40.ply", "out_2%_100%.ply"}));
  for (const std::string& name : names) EXPECT_TRUE(exists(name)) << name;
  EXPECT_EQ(run({"extract", "ball.amt", "-o", "f.ply", "--max-error", "2%", "--max-triangles", "40", "--fit",
                 "rms"})
                .code,
            0);
  const Json decimated = run({"mesh", "decimate", "ball.obj", "-o", "d.ply", "--max-error", "0.0001%",
                              "--max-triangles", "60", "--json"})
                             .json();
  EXPECT_EQ(decimated["endedBy"], "maxTriangles");
  const Outcome text =
      run({"extract", "ball.amt", "-o", "t.ply", "--max-error", "2%", "--max-triangles", "40"});
  EXPECT_NE(text.out.find("ended by --max-triangles"), std::string::npos) << text.out;
}

TEST_F(SurfaceCommands, InfoTakesTheErrorsThatAreStated) {
  ASSERT_EQ(run({"build", "ball.obj", "-o", "ball.amt"}).code, 0);
  const Json info = run({"info", "ball.amt", "--at", "1%,0.05", "--json"}).json();
  ASSERT_EQ(info["curve"].size(), 2u);
  EXPECT_DOUBLE_EQ(info["curve"][0]["maxError"], info["diagonal"].get<double>() / 100);
  EXPECT_EQ(info["curve"][1]["maxError"], 0.05);
  EXPECT_EQ(run({"info", "ball.amt", "--at", "x"}).code, 2);
}

TEST_F(SurfaceCommands, TheMapNamesAnInputOfEveryVertexAndAnOutputOfEveryFace) {
  ASSERT_EQ(run({"build", "ball.obj", "-o", "ball.amt"}).code, 0);
  const Outcome made =
      run({"extract", "ball.amt", "-o", "out.obj", "--max-triangles", "80", "--map", "map.csv", "--json"});
  ASSERT_EQ(made.code, 0) << made.err;
  std::istringstream map(read("map.csv")), in(read("ball.obj")), out(read("out.obj"));
  const auto places = [](std::istringstream& text) {
    std::vector<std::array<double, 3>> found;
    for (std::string line; std::getline(text, line);) {
      std::array<double, 3> p{};
      if (std::sscanf(line.c_str(), "v %lf %lf %lf", &p[0], &p[1], &p[2]) == 3) found.push_back(p);
    }
    return found;
  };
  const auto from = places(in), to = places(out);
  std::map<std::string, int> rows;
  std::string line;
  std::getline(map, line);
  EXPECT_EQ(line, "what,output,input");
  std::set<std::size_t> faces;
  while (std::getline(map, line)) {
    char what[8];
    std::size_t output = 0, input = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%7[a-z],%zu,%zu", what, &output, &input), 3) << line;
    ++rows[what];
    if (std::string(what) == "vertex")
      EXPECT_EQ(to.at(output), from.at(input));
    else
      faces.insert(input);
  }
  EXPECT_EQ(rows["vertex"], made.json()["exports"][0]["vertices"]);
  EXPECT_EQ(faces.size(), 24u * 15) << "polygons of the file";
}

TEST_F(SurfaceCommands, RegionsAndCamerasTakeDetailWhereItIsWanted) {
  ASSERT_EQ(run({"build", "ball.obj", "-o", "ball.amt"}).code, 0);
  const auto trianglesOf = [&](std::vector<std::string> more, const char* name) {
    std::vector<std::string> words = {"extract", "ball.amt", "-o", name, "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome made = run(words);
    EXPECT_EQ(made.code, 0) << made.err;
    return made.code == 0 ? made.json()["exports"][0]["triangles"].get<int>() : 0;
  };
  const int everywhere = trianglesOf({"--max-error", "0.2%"}, "all.ply");
  const int box =
      trianglesOf({"--max-error", "0.2%", "--region", "0,0,0,2,2,2", "--outside-error", "4%"}, "box.ply");
  const int ball = trianglesOf({"--max-error", "0.2%", "--region", "1,0,0,0.4"}, "part.ply");
  EXPECT_LT(box, everywhere * 2 / 3);
  EXPECT_LT(ball, box);
  // A camera sees one side.
  const int seen = trianglesOf({"--camera", "3,0,0,0,0,0,40", "--pixel-error", "2"}, "seen.ply");
  const int away = trianglesOf({"--camera", "3,0,0,9,0,0,40", "--pixel-error", "2"}, "away.ply");
  EXPECT_LT(away, seen / 2);
  EXPECT_LE(trianglesOf({"--camera", "3,0,0,0,0,0", "--max-triangles", "60"}, "few.ply"), 60);
}

TEST_F(SurfaceCommands, AModelIsMeasuredAsItsFinestSurface) {
  ASSERT_EQ(run({"build", "ball.obj", "-o", "ball.amt"}).code, 0);
  ASSERT_EQ(run({"extract", "ball.amt", "-o", "small.ply", "--max-error", "3%"}).code, 0);
  const Outcome mesh = run({"measure", "small.ply", "ball.obj", "--samples", "20000", "--json"}),
                model = run({"measure", "small.ply", "ball.amt", "--samples", "20000", "--json"});
  ASSERT_EQ(model.code, 0) << model.err;
  EXPECT_NEAR(model.json()["fromSecond"]["maximum"].get<double>(),
              mesh.json()["fromSecond"]["maximum"].get<double>(), 1e-6);
  EXPECT_EQ(run({"measure", "ball.amt", "ball.obj", "--expect", "1e-6"}).code, 0);
  const Json both =
      run({"extract", "ball.amt", "-o", "small.ply", "--max-error", "3%", "--both-ways", "--json"}).json();
  const Json measured = mesh.json()["fromFirst"];
  EXPECT_GE(both["exports"][0]["otherWay"].get<double>(), measured["maximum"].get<double>());
  EXPECT_LE(both["exports"][0]["otherWay"].get<double>(), 1.01 * measured["atMost"].get<double>());
}

TEST_F(SurfaceCommands, ARegionMayBeAClosedMeshInAFile) {
  ASSERT_EQ(run({"build", "ball.obj", "-o", "ball.amt"}).code, 0);
  // The box 0,0,0,2,2,2 as a mesh.
  write(
      "part.off",
      "OFF\n8 6 0\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n0 0 2\n2 0 2\n2 2 2\n0 2 2\n4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n"
      "4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
  const auto made = [&](const std::string& region, const std::string& name) {
    const Outcome cut = run({"extract", "ball.amt", "-o", name, "--max-error", "0.2%", "--region", region,
                             "--outside-error", "4%"});
    EXPECT_EQ(cut.code, 0) << cut.err;
    return read(name);
  };
  EXPECT_EQ(made("part.off", "mesh.ply"), made("0,0,0,2,2,2", "box.ply"));
  write("open.off", "OFF\n3 1 0\n0 0 0\n2 0 0\n2 2 0\n3 0 1 2\n");
  const Outcome open =
      run({"extract", "ball.amt", "-o", "none.ply", "--max-error", "1%", "--region", "open.off"});
  EXPECT_NE(open.code, 0);
  EXPECT_NE(open.err.find("open.off: is not closed"), std::string::npos) << open.err;
  EXPECT_FALSE(exists("none.ply"));
}

TEST_F(SurfaceCommands, SmallPartsAreLeftOutCountedAndTheirDistanceIsSaid) {
  // The ball and two crumbs: 0.3 across, at 2 from the ball's middle and inside of it.
  std::string text = ball(24, 14);
  const int vertices = 2 + 14 * 24;
  for (const double x : {3.0, 0.0})
    for (const char* p : {"0 0 0", "0.1 0 0", "0 0.1 0", "0 0 0.1"}) {
      double a = 0, b = 0, c = 0;
      std::sscanf(p, "%lf %lf %lf", &a, &b, &c);
      text += "v " + std::to_string(x + a) + " " + std::to_string(b) + " " + std::to_string(c) + "\n";
    }
  for (const int first : {vertices + 1, vertices + 5})
    for (const auto& f : {std::array{0, 2, 1}, std::array{0, 1, 3}, std::array{0, 3, 2}, std::array{1, 2, 3}})
      text += "f " + std::to_string(first + f[0]) + " " + std::to_string(first + f[1]) + " " +
              std::to_string(first + f[2]) + "\n";
  write("crumbs.obj", text);
  ASSERT_EQ(run({"build", "crumbs.obj", "-o", "crumbs.amt"}).code, 0);
  const Outcome made = run({"extract", "crumbs.amt", "-o", "out.ply", "--max-error", "1%", "--drop-parts",
                            "0.2", "--map", "map.csv", "--json"});
  ASSERT_EQ(made.code, 0) << made.err;
  const Json said = made.json()["exports"][0];
  EXPECT_EQ(said["dropped"]["components"], 2);
  EXPECT_EQ(said["dropped"]["faces"], 8);
  EXPECT_NEAR(said["dropped"]["distance"].get<double>(), 2.1, 0.02);
  EXPECT_LE(said["error"].get<double>(), 0.01 * made.json()["diagonal"].get<double>());
  EXPECT_EQ(run({"mesh", "info", "out.ply", "--json"}).json()["components"].size(), 1u);
  std::istringstream map(read("map.csv"));
  int mapped = 0;
  for (std::string line; std::getline(map, line);) {
    int output = 0, input = 0;
    if (std::sscanf(line.c_str(), "vertex,%d,%d", &output, &input) == 2) {
      EXPECT_LT(input, vertices);
    }
    mapped += line.starts_with("face,") ? 1 : 0;
  }
  EXPECT_EQ(mapped, 24 * 2 + 2 * 24 * 13) << "two triangles a quad";
  // Their triangles are not counted against a budget.
  const Outcome budget = run(
      {"extract", "crumbs.amt", "-o", "few.ply", "--max-triangles", "100", "--drop-parts", "5%", "--json"});
  ASSERT_EQ(budget.code, 0) << budget.err;
  EXPECT_LE(budget.json()["exports"][0]["triangles"], 100);
  EXPECT_GE(budget.json()["exports"][0]["triangles"], 96);
  const Outcome all =
      run({"extract", "crumbs.amt", "-o", "none.ply", "--max-error", "1%", "--drop-parts", "1000"});
  EXPECT_EQ(all.code, 2);
  EXPECT_NE(all.err.find("leaves nothing"), std::string::npos) << all.err;
}

TEST_F(SurfaceCommands, AreDrawnWithoutAScreen) {
  ASSERT_EQ(run({"build", "ball.obj", "-o", "ball.amt", "--displacement"}).code, 0);
  const Outcome shot = run({"view", "ball.amt", "--headless", "--screenshot", "view.png", "--size", "200x120",
                            "--camera", "3,0,0,0,0,0,40", "--json"});
  if (shot.err.find("no OpenGL 4.5 context") != std::string::npos) GTEST_SKIP() << shot.err;
  ASSERT_EQ(shot.code, 0) << shot.err;
  EXPECT_TRUE(exists("view.png"));
  const Json said = shot.json()["screenshot"];
  EXPECT_GT(said["figures"]["triangles"], 10);
  EXPECT_EQ(said["figures"]["showsSurface"], true);
  EXPECT_NEAR(said["camera"]["eye"][0].get<double>(), 3, 1e-9);
  EXPECT_EQ(said["camera"]["fov"], 40);
  const Outcome turn = run({"view", "ball.amt", "--headless", "--round", "--frames", "frames", "--fps", "0.5",
                            "--size", "80x60", "--figures", "figures.json"});
  ASSERT_EQ(turn.code, 0) << turn.err;
  EXPECT_EQ(readJson("figures.json")["frames"].size(), 4u);
  EXPECT_TRUE(exists("frames/frame_00003.png"));
  // Key frames count from the middle of the surface.
  const Json key = {{"x", 0}, {"y", -3}, {"height", 0}, {"azimuth", 0}, {"pitch", 0}};
  Json other = key;
  other["y"] = -5;
  write("flight.json", Json{{"frames", {key, other}}, {"duration", 1}}.dump());
  const Outcome flown = run({"view", "ball.amt", "--path", "flight.json", "--frames", "flown", "--fps", "2",
                             "--size", "80x60", "--json"});
  ASSERT_EQ(flown.code, 0) << flown.err;
  EXPECT_EQ(flown.json()["frames"].size(), 3u);
  EXPECT_NEAR(flown.json()["frames"][0]["camera"]["eye"][1].get<double>(), -3, 1e-2);
  EXPECT_EQ(flown.json()["frames"][2]["showsSurface"], true);
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--contours", "1"},
                                               {"--color", "slope"},
                                               {"--curvature"},
                                               {"--deadline", "5"}}) {
    std::vector<std::string> words = {"view", "ball.amt", "--headless", "--screenshot", "no.png"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome refused = run(words);
    EXPECT_EQ(refused.code, 2) << more[0];
    EXPECT_NE(refused.err.find(more[0]), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find("is for terrain"), std::string::npos) << refused.err;
  }
  const Outcome few =
      run({"view", "ball.amt", "--headless", "--screenshot", "no.png", "--max-triangles", "2"});
  EXPECT_EQ(few.code, 2);
  EXPECT_NE(few.err.find("--max-triangles 2"), std::string::npos) << few.err;
  EXPECT_FALSE(exists("no.png"));
}

TEST_F(SurfaceCommands, WhatIsForTerrainIsRefusedByName) {
  ASSERT_EQ(run({"build", "ball.obj", "-o", "ball.amt"}).code, 0);
  makeRaster("dem.tif", "fractal", 9, 9);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt"}).code, 0);
  const auto refused = [&](const std::vector<std::string>& words, const std::string& because) {
    const Outcome outcome = run(words);
    EXPECT_NE(outcome.code, 0) << words[0];
    EXPECT_NE(outcome.err.find(because), std::string::npos) << outcome.err;
  };
  refused({"height", "ball.amt", "--at", "0,0"}, "is of a surface");
  refused({"los", "ball.amt", "--from", "0,0,1", "--to", "1,1,1"}, "is of a surface");
  refused({"extract", "ball.amt", "-o", "x.ply", "--max-error", "1", "--region", "0,0,1"}, "a ball x,y,z,r");
  refused({"extract", "ball.amt", "-o", "x.ply", "--max-error", "1", "--fit", "triangles"}, "--fit");
  refused({"extract", "dem.amt", "-o", "x.ply", "--max-error", "1", "--fit", "rms"}, "--fit rms");
  refused({"extract", "ball.amt", "-o", "x.ply", "--camera", "9,0,0,0,0,0", "--fit", "rms"}, "--camera");
  refused({"extract", "dem.amt", "-o", "x.ply", "--max-error", "1", "--map", "m.csv"}, "--map");
  refused({"extract", "dem.amt", "-o", "x.ply", "--max-error", "1", "--drop-parts", "1"}, "--drop-parts");
  refused({"view", "dem.amt", "--headless", "--screenshot", "x.png", "--up", "y"}, "--up");
  refused({"view", "dem.amt", "--headless", "--screenshot", "x.png", "--color", "material"},
          "--color material");
  refused({"build", "dem.tif", "-o", "y.amt", "--position-bits", "16", "--packed"}, "--position-bits");
  refused({"convert", "dem.amt", "-o", "y.amt", "--position-bits", "16", "--packed"}, "--position-bits");
  refused({"convert", "ball.obj", "-o", "y.ply", "--position-bits", "16"}, "--position-bits");
  refused({"build", "dem.tif", "-o", "y.amt", "--keep-borders"}, "--keep-borders");
  refused({"build", "dem.tif", "-o", "y.amt", "--displacement"}, "--displacement");
  refused({"extract", "dem.amt", "-o", "x.ply", "--max-error", "1", "--no-displacement"},
          "--no-displacement");
}

}  // namespace
}  // namespace arete::cli_test

// SPDX-License-Identifier: GPL-3.0-or-later
// arete view as a user without a screen meets it.
#include <array>
#include <set>
#include <tuple>

#include "cli/cli_fixture.h"
#include "io/geo/gdal/support.h"

namespace arete::cli_test {
namespace {

class ViewCommand : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    makeRaster("dem.tif", "fractal", 60, 50);
    ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt", "-q"}).code, 0);
  }
  /// What is said when the machine has no OpenGL at all.
  static bool isWithoutOpenGl(const Outcome& o) {
    return o.err.find("no OpenGL 4.5 context") != std::string::npos;
  }
};

TEST_F(ViewCommand, DrawsAPictureWithoutAScreen) {
  const Outcome shot =
      run({"view", "dem.amt", "--headless", "--screenshot", "view.png", "--size", "200x120", "--json"});
  if (isWithoutOpenGl(shot)) GTEST_SKIP() << shot.err;
  ASSERT_EQ(shot.code, 0) << shot.err;
  EXPECT_TRUE(exists("view.png"));
  EXPECT_GT(shot.json()["screenshot"]["figures"]["triangles"], 100);
  EXPECT_EQ(shot.json()["screenshot"]["figures"]["pixelError"], 1.0);
}

TEST_F(ViewCommand, ContoursAndHazeTakeUnits) {
  const Outcome built =
      run({"build", "dem.tif", "-o", "feet.amt", "--vertical-unit", "ft", "--crs", "EPSG:32611"});
  ASSERT_EQ(built.code, 0) << built.err;
  const auto picture = [&](const std::string& name, const std::string& contours, const std::string& haze) {
    const Outcome shot = run({"view", "feet.amt", "--headless", "--screenshot", name, "--size", "120x80",
                              "--contours", contours, "--haze", haze});
    EXPECT_TRUE(shot.code == 0 || isWithoutOpenGl(shot)) << shot.err;
    return read(name);
  };
  const std::string plain = picture("plain.png", "50", "40");
  EXPECT_EQ(picture("stated.png", "15.24m", "40000m"), plain);
  EXPECT_EQ(picture("feet.png", "50ft", "40km"), plain);
  const Outcome refused =
      run({"view", "feet.amt", "--headless", "--screenshot", "x.png", "--contours", "5M"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("mm, cm, m, km"), std::string::npos) << refused.err;
}

TEST_F(ViewCommand, DrawsHeightsInTheColoursOfARampToTheByte) {
  // Classes a hundred metres wide, seen from above without light: the picture has their colours and the
  // sky's.
  write("classes.txt",
        "INTERPOLATION:DISCRETE\n100,250,10,20,255,low\n200,20,240,30,255,\ninf,30,40,230,255,high\n");
  const auto shoot = [&](std::vector<std::string> more) {
    std::vector<std::string> words = {"view",      "dem.amt", "--headless",      "--screenshot", "ramp.png",
                                      "--size",    "120x100", "--home",          "above",        "--unshaded",
                                      "--samples", "1",       "--no-decorations"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  };
  const Outcome shot = shoot({"--ramp", "classes.txt"});
  if (isWithoutOpenGl(shot)) GTEST_SKIP() << shot.err;
  ASSERT_EQ(shot.code, 0) << shot.err;
  const GdalDatasetPtr png = openGdal(path("ramp.png"), GDAL_OF_RASTER);
  ASSERT_TRUE(png);
  std::vector<std::uint8_t> rgb(3 * 120 * 100);
  ASSERT_EQ(
      png->RasterIO(GF_Read, 0, 0, 120, 100, rgb.data(), 120, 100, GDT_Byte, 3, nullptr, 3, 360, 1, nullptr),
      CE_None);
  std::set<std::array<int, 3>> colors;
  for (int y = 30; y < 70; ++y)
    for (int x = 45; x < 75; ++x) {
      const std::uint8_t* p = &rgb[std::size_t(3 * (y * 120 + x))];
      colors.insert({p[0], p[1], p[2]});
    }
  for (const auto& c : colors)
    EXPECT_TRUE((c == std::array{250, 10, 20}) || (c == std::array{20, 240, 30}) ||
                (c == std::array{30, 40, 230}))
        << c[0] << " " << c[1] << " " << c[2];
  const Outcome refused = shoot({"--ramp", "classes.txt", "--sea-level", "0"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("--sea-level"), std::string::npos) << refused.err;
  write("bad.txt", "0 red\n100 rot\n");
  const Outcome bad = shoot({"--ramp", "bad.txt"});
  EXPECT_EQ(bad.code, 4) << bad.err;
  EXPECT_NE(bad.err.find("bad.txt: line 2"), std::string::npos) << bad.err;
}

TEST_F(ViewCommand, ShowsEachMarkByItselfAndRefusesOthersByName) {
  const auto shoot = [&](const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> words = {"view", "dem.amt", "--screenshot", name, "--size", "160x120"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  };
  const Outcome first = shoot("plain.png", {});
  if (isWithoutOpenGl(first)) GTEST_SKIP() << first.err;
  ASSERT_EQ(first.code, 0) << first.err;
  std::set<std::string> pictures = {read("plain.png")};
  for (const char* marks : {"axes", "grid", "orbit", "axes,grid,orbit"}) {
    const Outcome shot = shoot("marked.png", {"--show", marks});
    ASSERT_EQ(shot.code, 0) << shot.err;
    EXPECT_TRUE(pictures.insert(read("marked.png")).second) << marks;
    fs::remove(path("marked.png"));
  }
  const Outcome refused = shoot("x.png", {"--show", "axes,grit"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.err.find("axes, grid, orbit"), std::string::npos) << refused.err;
  const Outcome film = run({"view", "dem.amt", "--round", "--frames", "film", "--show", "orbit"});
  EXPECT_EQ(film.code, 2);
  EXPECT_NE(film.err.find("--show orbit"), std::string::npos) << film.err;
}

TEST_F(ViewCommand, ATerrainAtALevelByHandSaysWhatThePictureKeeps) {
  write("scene.json", R"({"objects": [{"name": "ground", "file": "dem.amt", "level": {"triangles": 200}}]})");
  const auto shoot = [&](const char* pixels) {
    return run({"view", "scene.json", "--screenshot", "level.png", "--size", "160x120", "--json",
                "--pixel-error", pixels});
  };
  const Outcome one = shoot("1");
  if (isWithoutOpenGl(one)) GTEST_SKIP() << one.err;
  ASSERT_EQ(one.code, 0) << one.err;
  const auto figures = one.json()["screenshot"]["figures"];
  EXPECT_LE(figures["triangles"].get<int>(), 200);
  EXPECT_GT(figures["pixelError"].get<double>(), 0);
  const auto other = shoot("20").json()["screenshot"]["figures"];
  EXPECT_EQ(other["triangles"], figures["triangles"]) << "no tolerance counts";
  EXPECT_EQ(other["pixelError"], figures["pixelError"]);
}

TEST_F(ViewCommand, APictureOfTheSkyAloneIsWarnedOf) {
  const auto shoot = [&](const char* camera) {
    return run({"view", "dem.amt", "--headless", "--screenshot", "sky.png", "--size", "64x64", "--json",
                "--camera", camera});
  };
  const Outcome up = shoot("0,0,100msl,0,80");
  if (isWithoutOpenGl(up)) GTEST_SKIP() << up.err;
  ASSERT_EQ(up.code, 0) << up.err;
  EXPECT_NE(up.err.find("the picture shows nothing of the terrain"), std::string::npos) << up.err;
  EXPECT_EQ(up.json()["screenshot"]["figures"]["showsTerrain"], false);
}

TEST_F(ViewCommand, ABudgetThatCannotBeKeptIsWarnedOf) {
  const Outcome shot = run(
      {"view", "dem.amt", "--headless", "--screenshot", "x.png", "--size", "64x64", "--max-triangles", "1"});
  if (isWithoutOpenGl(shot)) GTEST_SKIP() << shot.err;
  EXPECT_EQ(shot.code, 0) << shot.err;
  EXPECT_NE(shot.err.find("--max-triangles 1: from there the coarsest cut has"), std::string::npos)
      << shot.err;
}

TEST_F(ViewCommand, ABudgetInPercentIsOfTheFinestTriangles) {
  const int finest = run({"info", "dem.amt", "--json"}).json()["finestTriangles"].get<int>();
  const auto shoot = [&](const std::string& budget) {
    return run({"view", "dem.amt", "--headless", "--screenshot", "x.png", "--size", "64x64", "--json",
                "--cut", "processor", "--pixel-error", "0.001", "--max-triangles", budget});
  };
  const Outcome share = shoot("50%");
  if (isWithoutOpenGl(share)) GTEST_SKIP() << share.err;
  ASSERT_EQ(share.code, 0) << share.err;
  const Json inPercent = share.json(), inNumbers = shoot(std::to_string(finest / 2)).json();
  EXPECT_EQ(inPercent["maxTriangles"], finest / 2);
  EXPECT_EQ(inPercent["finestTriangles"], finest);
  EXPECT_EQ(inPercent["screenshot"]["figures"]["triangles"], inNumbers["screenshot"]["figures"]["triangles"]);
  for (const char* wrong : {"0", "1.5", "0%", "-3%", "10%,20%", "x"})
    EXPECT_EQ(shoot(wrong).code, 2) << wrong;
}

TEST_F(ViewCommand, ARoundFlightGivesFramesAndTheirFigures) {
  const Outcome film = run({"view", "dem.amt", "--headless", "--round", "--frames", "frames", "--fps", "0.1",
                            "--size", "160x90", "--figures", "figures.json", "--cut", "processor"});
  if (isWithoutOpenGl(film)) GTEST_SKIP() << film.err;
  ASSERT_EQ(film.code, 0) << film.err;
  const Json figures = readJson("figures.json");
  ASSERT_EQ(figures["frames"].size(), 6u);  // a closed flight ends where it begins
  for (const Json& frame : figures["frames"]) {
    EXPECT_TRUE(exists(frame["file"]));
    for (const char* key : {"seconds", "triangles", "pixelError", "cutMilliseconds", "drawMilliseconds"})
      EXPECT_TRUE(frame[key].is_number()) << key;
  }
}

TEST_F(ViewCommand, AFlightFromAFileIsFlown) {
  const Json camera =
      run({"view", "dem.amt", "--headless", "--screenshot", "x.png", "--size", "64x64", "--json"})
          .json()["screenshot"]["camera"];
  if (camera.is_null()) GTEST_SKIP() << "no OpenGL here";
  Json key = camera, other = camera;
  other["azimuth"] = 40;
  write("flight.json", Json{{"frames", {key, other}}, {"duration", 1}}.dump());
  const Outcome film = run({"view", "dem.amt", "--headless", "--path", "flight.json", "--frames", "frames",
                            "--fps", "2", "--size", "64x64"});
  ASSERT_EQ(film.code, 0) << film.err;
  EXPECT_TRUE(exists("frames/frame_00002.png"));
}

TEST_F(ViewCommand, NothingIsWrittenOverWhatTheSameCommandWrites) {
  for (const auto& [option, file] : {std::pair{"--screenshot", "frames/frame_00000.png"},
                                     {"--screenshot", "frames/../frames/frame_00000.png"},
                                     {"--figures", "twice.png"}}) {
    std::vector<std::string> arguments = {"view",     "dem.amt", "--headless", "--round",
                                          "--frames", "frames",  "--fps",      "0.1"};
    if (std::string(option) == "--figures") arguments.insert(arguments.end(), {"--screenshot", "twice.png"});
    arguments.insert(arguments.end(), {option, file});
    const Outcome o = run(arguments);
    EXPECT_EQ(o.code, 2) << o.err;
    EXPECT_NE(o.err.find(std::string(option) + " " + file + ": is written by this command already"),
              std::string::npos)
        << o.err;
  }
}

TEST_F(ViewCommand, AFilmThatCannotBeMadeIsRefusedBeforeItIsDrawn) {
  const char* path = std::getenv("PATH");
  const std::string kept = path ? path : "";
  setenv("PATH", "/nonexistent", 1);
  const Outcome without = run(
      {"view", "dem.amt", "--headless", "--round", "--frames", "frames", "--fps", "0.1", "--film", "a.mp4"});
  const Outcome picture = run(
      {"view", "dem.amt", "--headless", "--round", "--frames", "frames", "--fps", "0.1", "--film", "a.gif"});
  setenv("PATH", kept.c_str(), 1);
  EXPECT_EQ(without.code, 3) << without.err;
  EXPECT_NE(without.err.find("--film a.mp4: a film needs ffmpeg"), std::string::npos) << without.err;
  EXPECT_EQ(picture.code, 2) << picture.err;
  EXPECT_NE(picture.err.find("--film a.gif: a film ends in .mp4"), std::string::npos) << picture.err;
  EXPECT_FALSE(exists("frames"));
}

TEST_F(ViewCommand, AFlightUnderTheGroundIsWarnedOf) {
  const Json camera = run({"view", "dem.amt", "--headless", "--screenshot", "x.png", "--size", "64x64",
                           "--home", "above", "--json"})
                          .json()["screenshot"]["camera"];
  if (camera.is_null()) GTEST_SKIP() << "no OpenGL here";
  Json key = camera, other = camera;
  key["height"] = other["height"] = -1e6;
  other["azimuth"] = 40;
  write("flight.json", Json{{"frames", {key, other}}, {"duration", 1}}.dump());
  const Outcome film = run({"view", "dem.amt", "--headless", "--path", "flight.json", "--frames", "frames",
                            "--fps", "1", "--size", "64x64"});
  ASSERT_EQ(film.code, 0) << film.err;
  EXPECT_NE(film.err.find("the camera stands under the ground in 2 of 2 frames"), std::string::npos)
      << film.err;
}

TEST_F(ViewCommand, SaysWhatIsWrongInASentence) {
  write("one.json", R"({"frames":[{"x":1,"y":2,"height":3,"azimuth":0,"pitch":0}],"duration":3})");
  write("equal.json", R"({"frames":[{"x":1,"y":2,"height":3,"azimuth":0,"pitch":0},
                                    {"x":1,"y":2,"height":3,"azimuth":0,"pitch":0}],"duration":3})");
  write("broken.json", "{");
  const std::string two =
      R"("frames":[{"x":1,"y":2,"height":3,"azimuth":0,"pitch":0},{"x":1,"y":2,"height":3,"azimuth":9,"pitch":0}])";
  write("endless.json", "{" + two + R"(,"duration":1e300})");
  write("both.json", "{" + two + R"(,"duration":3,"speed":4})");
  struct Case {
    std::vector<std::string> arguments;
    int code;
    std::string says;
  };
  const std::vector<Case> cases = {
      {{"--output", "a.png"},
       2,
       "--output a.png: does not exist here: --screenshot FILE.png writes a picture"},
      {{"--headless"}, 2, "--screenshot FILE.png"},
      {{"--headless", "--screenshot", "a.jpg"}, 2, ".png"},
      {{"--headless", "--screenshot", "a.png", "--size", "12"}, 2, "WIDTHxHEIGHT"},
      {{"--headless", "--screenshot", "a.png", "--sun", "10"}, 2, "AZIMUTH,ELEVATION"},
      {{"--headless", "--screenshot", "a.png", "--camera", "1,2"}, 2, "--camera"},
      {{"--headless", "--screenshot", "a.png", "--pixel-error", "0"}, 2, "--pixel-error"},
      {{"--headless", "--screenshot", "no/where/a.png"}, 3, "no/where"},
      {{"--headless", "--screenshot", "a.png", "--deadline", "5"}, 2, "--cut processor"},
      {{"--headless", "--screenshot", "a.png", "--figures", "f.json"},
       2,
       "--figures: requires --frames FOLDER or --film"},
      {{"--headless", "--screenshot", "a.png", "--fps", "3"}, 2, "--fps"},
      {{"--headless", "--round", "--frames", "g", "--fps", "1e9"}, 2, "--fps"},
      {{"--headless", "--screenshot", "a.png", "--frame-time", "5"}, 2, "--frame-time"},
      {{"--headless", "--screenshot", "a.png", "--home", "above", "--camera", "1,2,3"}, 2, "--home"},
      {{"--headless", "--round", "--frames", "g", "--home", "above"},
       2,
       "--home above: requires --screenshot"},
      {{"--headless", "--round", "--frames", "g", "--camera", "1,2,3"},
       2,
       "--camera 1,2,3: requires --screenshot"},
      {{"--headless", "--screenshot", "a.png", "--lonlat"}, 2, "--camera"},
      {{"--headless", "--frames", "h", "--path", "endless.json"}, 2, "endless.json, flight: "},
      {{"--headless", "--screenshot", "a.png", "--exaggeration", "1e300"}, 2, "--exaggeration: must be"},
      {{"--headless", "--frames", "h", "--path", "both.json"}, 4, "leave one out"},
      {{"--headless", "--frames", "f"}, 2, "--path FLIGHT.json or --round"},
      {{"--headless", "--screenshot", "a.png", "--film", "a.mp4"},
       2,
       "--film a.mp4: requires --path FLIGHT.json or --round"},
      {{"--headless", "--frames", "f", "--path", "one.json"}, 4, "one.json"},
      {{"--headless", "--frames", "f", "--path", "equal.json"}, 4, "key frame 2"},
      {{"--headless", "--frames", "f", "--path", "broken.json"}, 4, "broken.json"},
      {{"--headless", "--frames", "f", "--path", "none.json"}, 3, "none.json"},
  };
  for (const Case& c : cases) {
    std::vector<std::string> arguments = {"view", "dem.amt"};
    arguments.insert(arguments.end(), c.arguments.begin(), c.arguments.end());
    const Outcome o = run(arguments);
    EXPECT_EQ(o.code, c.code) << c.says << ": " << o.err;
    EXPECT_NE(o.err.find(c.says), std::string::npos) << o.err;
    EXPECT_EQ(o.out, "");
  }
  for (const char* folder : {"f", "g", "h"}) EXPECT_FALSE(exists(folder)) << folder;
}

TEST_F(ViewCommand, AMachineWithoutOpenGlGetsASentence) {
  setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent", 1);
  const char* display = std::getenv("DISPLAY");
  const std::string kept = display ? display : "";
  unsetenv("DISPLAY");
  const Outcome o = run({"view", "dem.amt", "--headless", "--screenshot", "a.png"});
  unsetenv("__EGL_VENDOR_LIBRARY_FILENAMES");
  if (display) setenv("DISPLAY", kept.c_str(), 1);
  EXPECT_EQ(o.code, 3) << o.err;
  EXPECT_NE(o.err.find("no OpenGL 4.5 context can be had"), std::string::npos) << o.err;
  EXPECT_FALSE(exists("a.png"));
}

TEST_F(ViewCommand, APictureNeedsNoWordForNoWindow) {
  const Outcome outcome = run({"view", "dem.amt", "--screenshot", "x.png", "--size", "64x64"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(exists("x.png"));
  EXPECT_EQ(
      run({"view", "dem.amt", "--round", "--frames", "f", "--fps", "0.1", "--size", "64x64", "-q"}).code, 0);
  EXPECT_TRUE(exists("f/frame_00000.png"));
}

TEST_F(ViewCommand, AFilmAloneLeavesNoPictures) {
  const auto before = files();
  const Outcome film =
      run({"view", "dem.amt", "--round", "--film", "a.mp4", "--fps", "0.1", "--size", "64x64", "--json"});
  if (film.err.find("a film needs ffmpeg") != std::string::npos) {
    EXPECT_EQ(files(), before);
    GTEST_SKIP() << "ffmpeg is not installed";
  }
  ASSERT_EQ(film.code, 0) << film.err;
  auto expected = before;
  expected.insert("a.mp4");
  EXPECT_EQ(files(), expected);
  EXPECT_FALSE(film.json()["frames"][0].contains("file"));
}

TEST_F(ViewCommand, OpensADemAMeshAndPointsAsBuildTakesThem) {
  write("hill.obj", "v 0 0 1\nv 10 0 2\nv 10 10 3\nv 0 10 4\nv 5 5 9\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n");
  write("points.csv", "x,y,z\n0,0,1\n10,0,2\n10,10,3\n0,10,4\n5,5,9\n");
  const auto shoot = [&](const std::string& input, const std::string& picture) {
    return run({"view", input, "--screenshot", picture, "--size", "160x120", "--json"});
  };
  const Outcome built = shoot("dem.amt", "built.png"), direct = shoot("dem.tif", "direct.png");
  if (isWithoutOpenGl(built)) GTEST_SKIP() << built.err;
  ASSERT_EQ(direct.code, 0) << direct.err;
  EXPECT_EQ(read("direct.png"), read("built.png")) << "the same model, the same picture";
  EXPECT_EQ(direct.json()["kind"], "terrain");
  const Outcome mesh = shoot("hill.obj", "mesh.png"), points = shoot("points.csv", "points.png");
  ASSERT_EQ(mesh.code, 0) << mesh.err;
  EXPECT_EQ(mesh.json()["kind"], "surface");
  EXPECT_EQ(mesh.json()["screenshot"]["figures"]["triangles"], 4);
  ASSERT_EQ(points.code, 0) << points.err;
  EXPECT_EQ(points.json()["kind"], "terrain");
  EXPECT_FALSE(exists("hill.amt"));
  EXPECT_FALSE(exists("points.amt"));
}

TEST_F(ViewCommand, ColoursASurfaceByWhatItsAttributesAreOffByOrSaysWhyNot) {
  std::string obj;
  for (int y = 0; y <= 8; ++y)
    for (int x = 0; x <= 8; ++x)
      obj += "v " + std::to_string(x) + " " + std::to_string(y) + " 0\nvt " + std::to_string(x * x / 64.0) +
             " " + std::to_string((x * y) % 5 / 5.0) + "\n";
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) {
      obj += "f";
      for (const int i : {y * 9 + x + 1, y * 9 + x + 2, y * 9 + x + 11, y * 9 + x + 10})
        obj += " " + std::to_string(i) + "/" + std::to_string(i);
      obj += "\n";
    }
  write("sheet.obj", obj);
  ASSERT_EQ(run({"build", "sheet.obj", "-o", "sheet.amt", "--attributes"}).code, 0);
  ASSERT_EQ(run({"build", "sheet.obj", "-o", "bare.amt"}).code, 0);
  const auto shoot = [&](const std::string& file, const std::string& color) {
    return run(
        {"view", file, "--screenshot", "a.png", "--size", "120x90", "--pixel-error", "8", "--color", color});
  };
  std::set<std::string> pictures;
  for (const std::string color : {"material", "stretch", "error:uv", "error:texcoord"}) {
    const Outcome shot = shoot("sheet.amt", color);
    if (isWithoutOpenGl(shot)) GTEST_SKIP() << shot.err;
    ASSERT_EQ(shot.code, 0) << color << shot.err;
    pictures.insert(read("a.png"));
  }
  EXPECT_EQ(pictures.size(), 3u) << "uv is what the file calls texcoord";
  for (const auto& [file, color, said] :
       {std::tuple{"sheet.amt", "error:color", "the model states no such errors; it has error:uv"},
        std::tuple{"bare.amt", "error:uv", "build it with its attributes (--attributes)"},
        std::tuple{"bare.amt", "error:", "must be one of"},
        std::tuple{"dem.amt", "error:uv", "is for surfaces"},
        std::tuple{"sheet.amt", "charts", "no seams"}}) {
    const Outcome refused = shoot(file, color);
    EXPECT_EQ(refused.code, 2) << file << color;
    EXPECT_NE(refused.err.find(said), std::string::npos) << refused.err;
  }
}

TEST_F(ViewCommand, OfATinThatWasExtractedDrawsItsOwnTriangles) {
  ASSERT_EQ(run({"extract", "dem.amt", "-o", "tin.ply", "--max-error", "3", "-q"}).code, 0);
  const Json mesh = run({"mesh", "info", "tin.ply", "--json"}).json();
  const Outcome shot = run({"view", "tin.ply", "--screenshot", "tin.png", "--size", "160x120", "--json",
                            "--pixel-error", "0.001"});
  if (isWithoutOpenGl(shot)) GTEST_SKIP() << shot.err;
  ASSERT_EQ(shot.code, 0) << shot.err;
  EXPECT_EQ(shot.json()["screenshot"]["figures"]["triangles"], mesh["triangles"]) << mesh.dump(1);
}

TEST_F(ViewCommand, RefusesWhatItCannotOpenWithTheReasonOfTheReader) {
  write("letter.txt", "dear friend\n");
  write("broken.amt", "no model");
  write("hill.obj", "v 0 0 1\nv 10 0 2\nv 10 10 3\nf 1 2 3\n");
  for (const char* name : {"letter.txt", "broken.amt", "missing.tif"}) {
    const Outcome refused = run({"view", name, "--screenshot", "x.png"});
    EXPECT_NE(refused.code, 0) << name;
    EXPECT_NE(refused.err.find(name), std::string::npos) << refused.err;
  }
  const Outcome slopes = run({"view", "hill.obj", "--screenshot", "x.png", "--contours", "5"});
  EXPECT_EQ(slopes.code, 2);
  EXPECT_NE(slopes.err.find("--contours"), std::string::npos) << slopes.err;
}

}  // namespace
}  // namespace arete::cli_test

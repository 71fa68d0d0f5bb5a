// SPDX-License-Identifier: GPL-3.0-or-later
//
// What scene.json may say, what it is refused for, and where objects then stand.
#include "io/query/scene/scene_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "io/query/scene/open_scene.h"
#include "io/written_amt.h"
#include "terrain/model/camera.h"

namespace arete {
namespace {

using test::TemporaryFolder;

void putScene(const std::string& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// A pyramid of height 5 on a square of 2 by 4, whose corner is at 10,20,0.
constexpr const char* kPyramidMast =
    "v 10 20 0\nv 12 20 0\nv 12 24 0\nv 10 24 0\nv 11 22 5\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nf 1 3 2\nf 1 "
    "4 3\n";
/// A slope that rises by 1 a metre eastwards, of samples at 1005, 1015, ... and 1995, ...
constexpr const char* kSlope =
    "ncols 5\nnrows 5\nxllcorner 1000\nyllcorner 1950\ncellsize 10\n"
    "0 10 20 30 40\n0 10 20 30 40\n0 10 20 30 40\n0 10 20 30 40\n0 10 20 30 40\n";

class Scenes : public testing::Test {
 protected:
  void SetUp() override {
    putScene(folder_.file("mast.obj"), kPyramidMast);
    putScene(folder_.file("dem.asc"), kSlope);
  }
  Result<SceneFile> read(const std::string& text) {
    putScene(folder_.file("scene.json"), text);
    return readScene(folder_.file("scene.json"));
  }
  Result<OpenScene> open(const std::string& objects, const std::string& more = {}) {
    auto file = read("{" + more + "\"objects\": [" + objects + "]}");
    if (!file) return tl::unexpected(file.error());
    return openScene(*std::move(file));
  }
  std::string refusal(const std::string& objects, const std::string& more = {}) {
    const auto opened = open(objects, more);
    return opened ? "opened" : opened.error().describe();
  }
  TemporaryFolder folder_;
};

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

TEST_F(Scenes, AnInstanceHasWhatItsObjectStatesButForWhatItStatesItself) {
  const auto scene =
      read(R"({"objects": [{"name": "tree", "file": "mast.obj", "at": [1, 2], "above": 3, "scale": 5,
    "turn": [10, 0, 0], "instances": [{}, {"at": [7, 8, 9]}, {"lonlat": [8, 47], "scale": 2},
                                      {"name": "oak", "above": 1, "turn": [0, 0, 0], "level": {"triangles": 9}}]}]})");
  ASSERT_TRUE(scene) << scene.error().describe();
  ASSERT_EQ(scene->objects.size(), 4u);
  const auto& o = scene->objects;
  EXPECT_EQ(o[0].name, "tree 1");
  EXPECT_EQ(o[0].above, 3);
  EXPECT_EQ(o[0].scale, 5);
  EXPECT_EQ(o[1].name, "tree 2");
  EXPECT_EQ(o[1].place->xy, (Vec2{7, 8}));
  EXPECT_EQ(o[1].place->height, 9);
  EXPECT_EQ(o[1].above, 0) << "a place of its own has a height of its own";
  EXPECT_EQ(o[1].turn.heading, 10);
  EXPECT_TRUE(o[2].place->isLonLat);
  EXPECT_EQ(o[2].scale, 2);
  EXPECT_EQ(o[3].name, "oak");
  EXPECT_EQ(o[3].place->xy, (Vec2{1, 2}));
  EXPECT_EQ(o[3].above, 1);
  EXPECT_EQ(o[3].turn, Turn{});
  EXPECT_EQ(o[3].level.triangles, 9u);
  EXPECT_SAYS(refusal(R"({"file": "mast.obj", "instances": [{}, {"file": "b.obj"}]})"),
              "objects[0]: instances[1]");
  EXPECT_SAYS(refusal(R"({"file": "mast.obj", "instances": {}})"), "instances: must be a list");
}

TEST_F(Scenes, LevelsByHandAreOfTerrainToo) {
  const auto scene = open(R"({"name": "ground", "file": "dem.asc", "level": {"triangles": 50}})");
  ASSERT_TRUE(scene) << scene.error().describe();
  EXPECT_EQ(scene->file.objects[0].level.triangles, 50u);
}

TEST_F(Scenes, ReadsEveryKey) {
  const auto scene = read(
      R"({"$schema": "x", "crs": "EPSG:32611", "objects": [
        {"name": "a", "file": "sub/../mast.obj", "at": [1, 2, 3], "above": -4, "turn": [10, 20, 30],
         "scale": 0.3048, "up": "y", "anchor": "base", "tolerance": 2, "level": {"error": 0.5}, "visible": false},
        {"file": "mast.obj", "lonlat": [-118, 34.5], "level": {"triangles": 500}},
        {"file": "mast.obj"}]})");
  ASSERT_TRUE(scene) << scene.error().describe();
  const SceneObject& a = scene->objects[0];
  EXPECT_EQ(scene->crs, "EPSG:32611");
  EXPECT_EQ(a.file, folder_.file("mast.obj"));
  EXPECT_EQ(a.place->xy.y, 2);
  EXPECT_EQ(a.place->height, 3);
  EXPECT_EQ(a.above, -4);
  EXPECT_EQ(a.turn, (Turn{10, 20, 30}));
  EXPECT_EQ(a.scale, 0.3048);
  EXPECT_EQ(a.up, "y");
  EXPECT_EQ(a.anchor, SceneObject::Anchor::base);
  EXPECT_EQ(a.tolerance, 2);
  EXPECT_EQ(a.level.error, 0.5);
  EXPECT_FALSE(a.isVisible);
  EXPECT_TRUE(scene->objects[1].place->isLonLat);
  EXPECT_FALSE(scene->objects[1].place->height);
  EXPECT_EQ(scene->objects[1].level.triangles, 500u);
  EXPECT_EQ(scene->objects[1].name, "mast");
  EXPECT_EQ(scene->objects[2].name, "mast 2");
  EXPECT_FALSE(scene->objects[2].place);
}

TEST_F(Scenes, EveryMistakeIsNamedByItsObjectAndKey) {
  const std::vector<std::pair<std::string, std::string>> mistakes = {
      {R"({"file": "mast.obj", "att": [1, 2]})", "objects[0]: has the unknown key 'att'"},
      {R"({"name": "mast"})", "objects[0] 'mast': has no file"},
      {R"({"name": "m", "file": 3})", "objects[0] 'm': file: must be a text"},
      {R"({"name": "m", "file": "mast.obj", "at": [1]})", "objects[0] 'm': at: must be a list of 2 or 3"},
      {R"({"name": "m", "file": "mast.obj", "at": [1, "2"]})", "'m': at: must be a list"},
      {R"({"name": "m", "file": "mast.obj", "at": [1, null]})", "'m': at: must be a list"},
      {R"({"name": "m", "file": "mast.obj", "at": [1, 2], "lonlat": [1, 2]})", "'m': at: cannot be combined"},
      {R"({"name": "m", "file": "mast.obj", "lonlat": [47, 147]})", "'m': lonlat: 47,147 is no longitude"},
      {R"({"name": "m", "file": "mast.obj", "turn": [1, 2]})", "'m': turn: must be a list of 3"},
      {R"({"name": "m", "file": "mast.obj", "scale": 0})", "'m': scale: must be above 0"},
      {R"({"name": "m", "file": "mast.obj", "scale": -1})", "'m': scale: must be above 0"},
      {R"({"name": "m", "file": "mast.obj", "scale": NaN})", "is not a scene in JSON"},
      {R"({"name": "m", "file": "mast.obj", "scale": 1e999})", "is not a scene in JSON"},
      {R"({"name": "m", "file": "mast.obj", "scale": true})", "'m': scale: must be a number"},
      {R"({"name": "m", "file": "mast.obj", "scale": 1, "scale": 2})", "states the key 'scale' twice"},
      {R"({"name": "m", "file": "mast.obj", "up": "x"})", "'m': up: must be"},
      {R"({"name": "m", "file": "mast.obj", "anchor": "top"})", "'m': anchor: must be"},
      {R"({"name": "m", "file": "mast.obj", "tolerance": 0})", "'m': tolerance: must be above 0"},
      {R"({"name": "m", "file": "mast.obj", "level": 3})", "'m': level: must be {"},
      {R"({"name": "m", "file": "mast.obj", "level": {"error": 1, "triangles": 2}})",
       "'m': level: must be {"},
      {R"({"name": "m", "file": "mast.obj", "level": {"error": -1}})",
       "'m': level: error: must be 0 or more"},
      {R"({"name": "m", "file": "mast.obj", "level": {"triangles": 1.5}})", "'m': level: triangles: must be"},
      {R"({"name": "m", "file": "mast.obj", "visible": 1})", "'m': visible: must be true or false"},
      {R"({"name": "m", "file": "mast.obj"}, {"name": "m", "file": "b.obj"})",
       "objects[1] 'm': name: objects[0]"},
      {R"({"name": "m", "file": "none.obj"})", "objects[0] 'm': file: "},
      {R"(3)", "objects[0]: must be an object"},
      {"", "objects: must be a list of at least one object"},
      {R"({"file": "dem.asc", "name": "ground", "at": [1, 2]})", "'ground': is terrain"},
      {R"({"file": "dem.asc"}, {"name": "m", "file": "mast.obj"})", "objects[1] 'm': is a mesh on terrain"},
      {R"({"file": "dem.asc"}, {"name": "m", "file": "mast.obj", "at": [5, 5]})",
       "objects[1] 'm': at: has no terrain below it"},
      {R"({"file": "dem.asc"}, {"name": "m", "file": "mast.obj", "lonlat": [5, 5]})",
       "objects[1] 'm': lonlat: needs a CRS"},
  };
  for (const auto& [objects, part] : mistakes) EXPECT_SAYS(refusal(objects), part);
  EXPECT_SAYS(refusal(R"({"file": "mast.obj"})", R"("crs": "EPSG:99999999", )"), "scene.json: crs");
  EXPECT_SAYS(refusal(R"({"file": "mast.obj"})", R"("units": "m", )"), "unknown key 'units'");
  EXPECT_FALSE(read("[]"));
  EXPECT_FALSE(readScene(folder_.file("no.json")));
}

void expectStands(const Vec3& a, const Vec3& b, double within = 1e-9) {
  EXPECT_NEAR(a.x, b.x, within);
  EXPECT_NEAR(a.y, b.y, within);
  EXPECT_NEAR(a.z, b.z, within);
}

TEST_F(Scenes, ObjectsStandOnTheGroundOrAtTheirHeightAndTurnClockwise) {
  const auto scene = open(
      R"({"file": "dem.asc"},
         {"name": "ground", "file": "mast.obj", "at": [1020, 1980]},
         {"name": "high", "file": "./mast.obj", "at": [1020, 1980, 100], "above": 7, "scale": 2, "turn": [90, 0, 0]},
         {"name": "foot", "file": "mast.obj", "at": [1020, 1980], "anchor": "base", "turn": [90, 0, 0], "scale": 2},
         {"name": "lying", "file": "mast.obj", "at": [1020, 1980, 0], "up": "y"})");
  ASSERT_TRUE(scene) << scene.error().describe();
  EXPECT_EQ(scene->models.size(), 2u) << "one file under two names";
  const TerrainModel& terrain = *scene->terrainModel();
  // East is x and north is y of the scene's space, whatever the order of the raster's rows.
  const auto there = [&](double x, double y, double z) {
    return scene->metricOf(metricPosition({x, y}, z, terrain));
  };
  expectStands(there(1021, 1982, 3) - there(1020, 1980, 0), {1, 2, 3});
  const auto at = [&](std::size_t i, const Vec3& file) {
    return scene->objects[i].placement(uprightPosition(file, scene->objects[i].isYUp));
  };
  // The slope is 15 high at 1020: its samples are at 1015 and 1025.
  expectStands(at(1, {0, 0, 0}), there(1020, 1980, 15));
  expectStands(at(1, {11, 22, 5}), there(1031, 2002, 20));
  expectStands(at(2, {0, 1, 0}), there(1022, 1980, 107));  // its front, north, leads east
  expectStands(at(2, {1, 0, 1}), there(1020, 1978, 109));
  expectStands(at(3, {11, 22, 0}), there(1020, 1980, 15));
  expectStands(at(3, {11, 22, 5}), there(1020, 1980, 25));
  expectStands(at(4, {0, 2, 0}), there(1020, 1980, 2));
}

// A degree of longitude at 60 degrees is half as long as at the equator.
TEST_F(Scenes, FurtherTerrainWhoseMapUnitsHaveAnotherLengthIsRefused) {
  const auto put = [&](const char* name, double south) {
    putScene(folder_.file(std::string(name) + ".asc"),
             fmt::format("ncols 3\nnrows 3\nxllcorner 10\nyllcorner {}\ncellsize 0.01\n"
                         "0 1 2\n0 1 2\n0 1 2\n",
                         south));
    putScene(folder_.file(std::string(name) + ".prj"),
             "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],"
             "PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]]");
  };
  put("equator", 0), put("beside", 0.5), put("north", 60);
  EXPECT_EQ(refusal(R"({"file": "equator.asc"}, {"file": "beside.asc"})"), "opened");
  EXPECT_SAYS(refusal(R"({"file": "equator.asc"}, {"file": "north.asc"})"), "map units that differ by 50 %");
}

TEST_F(Scenes, AMeshOnAMapOfItsOwnIsRemarkedOn) {
  putScene(folder_.file("far.obj"), "v 500000 5200000 0\nv 500001 5200000 0\nv 500000 5200001 3\nf 1 2 3\n");
  const auto far = open(R"({"file": "far.obj", "at": [1, 2]}, {"file": "mast.obj", "at": [1, 2]})");
  ASSERT_TRUE(far);
  ASSERT_EQ(far->warnings.size(), 1u);
  EXPECT_EQ(far->warnings[0].sentence.find("objects[0]"), 0u);
  EXPECT_SAYS(far->warnings[0].sentence, "objects[0] 'far': its coordinates are 5.22e+06 units from 0,0,0");
  const auto based = open(R"({"file": "far.obj", "at": [1, 2], "anchor": "base"})");
  ASSERT_TRUE(based);
  EXPECT_TRUE(based->warnings.empty());
}

TEST_F(Scenes, ThousandsOfInstancesShareOneModel) {
  std::string objects;
  for (int i = 0; i < 20000; ++i)
    objects +=
        fmt::format(R"({}{{"file": "mast.obj", "at": [{}, {}]}})", i == 0 ? "" : ",", i % 300, i / 300);
  const auto scene = open(objects);
  ASSERT_TRUE(scene) << scene.error().describe();
  EXPECT_EQ(scene->models.size(), 1u);
  EXPECT_EQ(scene->objects.size(), 20000u);
  EXPECT_EQ(scene->file.objects[19999].name, "mast 20000");
  expectStands(scene->objects[301].placement({0, 0, 0}), {1, 1, 0});
}

}  // namespace
}  // namespace arete

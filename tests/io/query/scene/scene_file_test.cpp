// SPDX-License-Identifier: GPL-3.0-or-later
//
// What scenes state, and each way to state it wrongly with the sentence that names it.
#include "io/query/scene/scene_file.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "datasets/families.h"
#include "io/query/scene/open_scene.h"
#include "io/written_amt.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

using test::TemporaryFolder;

TEST(SceneFile, StatesObjectsPlacesAndInstances) {
  const auto scene = readSceneText(R"({"crs": "EPSG:25832", "comment": "two masts", "objects": [
    {"file": "dem.amt"},
    {"name": "mast", "file": "../mast.glb", "up": "y", "anchor": "base", "scale": 0.3048, "tolerance": 2,
     "instances": [{"at": [1, 2]}, {"at": [3, 4, 5], "turn": [10, 20, 30], "scale": 2, "name": "tall"},
                   {"lonlat": [8.5, 47.5], "above": 3, "level": {"triangles": 40}, "visible": false}]},
    {"file": "dem.ply", "at": [0, 0], "level": {"error": 0.5}}]})",
                                   "folder/scene.json");
  ASSERT_TRUE(scene) << scene.error().describe();
  ASSERT_EQ(scene->objects.size(), 5u);
  EXPECT_EQ(scene->crs, "EPSG:25832");
  EXPECT_EQ(scene->objects[0].name, "dem");
  EXPECT_EQ(scene->objects[0].file, "folder/dem.amt");
  EXPECT_FALSE(scene->objects[0].hasPlace);
  const StatedObject& first = scene->objects[1];
  EXPECT_EQ(first.name, "mast 1");
  EXPECT_EQ(first.file, "mast.glb");
  EXPECT_EQ(first.place, (Vec2{1, 2}));
  EXPECT_FALSE(first.height);
  EXPECT_EQ(first.scale, 0.3048);
  EXPECT_EQ(first.toleranceFactor, 2);
  EXPECT_EQ(first.anchor, StatedObject::Anchor::base);
  const StatedObject& tall = scene->objects[2];
  EXPECT_EQ(tall.name, "tall");
  EXPECT_EQ(tall.height, 5);
  EXPECT_EQ(tall.turn, (Turn{10, 20, 30}));
  EXPECT_EQ(tall.scale, 2);
  const StatedObject& third = scene->objects[3];
  EXPECT_TRUE(third.isLonLat);
  EXPECT_EQ(third.above, 3);
  EXPECT_EQ(third.levelTriangles, 40u);
  EXPECT_FALSE(third.isShown);
  EXPECT_EQ(scene->objects[4].name, "dem 2") << "two files of one stem";
  EXPECT_EQ(scene->objects[4].levelError, 0.5);
}

TEST(SceneFile, WhatIsWrongIsNamedWithItsObject) {
  const auto refusal = [](const std::string& object) {
    const auto scene =
        readSceneText(fmt::format(R"({{"objects": [{{"file": "a.amt"}}, {}]}})", object), "s.json");
    return scene ? "" : scene.error().describe();
  };
  for (const auto& [object, words] : std::vector<std::pair<std::string, std::string>>{
           {R"({"at": [1, 2]})", "objects[1]: its file is missing"},
           {R"({"file": "m.obj", "name": "m", "at": [1]})",
            "objects[1] \"m\": its at must be 2 or 3 numbers"},
           {R"({"file": "m.obj", "at": [1, "2"]})", "its at is string, not a number"},
           {R"({"file": "m.obj", "at": [1, null]})", "its at is null, not a number"},
           {R"({"file": "m.obj", "at": [1, 2], "lonlat": [1, 2]})", "exclude each other"},
           {R"({"file": "m.obj", "lonlat": [1, 91]})", "latitude beyond 90"},
           {R"({"file": "m.obj", "at": [1, 2, 3], "above": 4})", "its place states a height"},
           {R"({"file": "m.obj", "at": [1, 2], "scale": 0})", "its scale must be above 0"},
           {R"({"file": "m.obj", "at": [1, 2], "scale": -1})", "its scale must be above 0"},
           {R"({"file": "m.obj", "at": [1, 2], "turn": 90})", "its turn must be 3 numbers"},
           {R"({"file": "m.obj", "at": [1, 2], "trun": [1, 2, 3]})", "knows no \"trun\""},
           {R"({"file": "m.obj", "at": [1, 2], "up": "x"})", "its up must be"},
           {R"({"file": "m.obj", "at": [1, 2], "level": {"error": -1}})", "an error below 0"},
           {R"({"file": "m.obj", "at": [1, 2], "level": {"triangles": 1.5}})", "no whole number"},
           {R"({"file": "m.obj", "at": [1, 2], "level": 3})", "its level must be"},
           {R"({"file": "m.obj", "at": [1, 2], "visible": 1})", "its visible must be true or false"},
           {R"({"file": "m.obj", "instances": []})", "its instances must be a list"},
           {R"({"file": "m.obj", "instances": [{"at": [1, 2]}, {"file": "n.obj"}]})",
            "instances[1]: knows no \"file\""},
           {R"({"file": "m.obj", "name": "a"}, {"file": "n.obj", "name": "a"})",
            "two objects have the name \"a\""},
           {R"([])", "objects[1] is array, not an object"},
           {R"({"file": "m.obj", "at": [1, 1e999]})", "number too large"},
       })
    EXPECT_NE(refusal(object).find(words), std::string::npos) << object << ": " << refusal(object);
  for (const char* text : {"", "[]", "{}", R"({"objects": []})", R"({"objects": {}})", R"({"frames": []})",
                           R"({"objects": [{"file": "a.amt", "at": [1, NaN]}]})"})
    EXPECT_FALSE(readSceneText(text, "s.json")) << text;
}

TEST(SceneFile, AHundredThousandInstancesAreReadAndNamed) {
  std::string text = R"({"objects": [{"file": "tree.glb", "instances": [)";
  for (int i = 0; i < 100000; ++i) text += fmt::format("{}{{\"at\": [{}, 2]}}", i > 0 ? "," : "", i);
  const auto scene = readSceneText(text + "]}]}", "s.json");
  ASSERT_TRUE(scene) << scene.error().describe();
  ASSERT_EQ(scene->objects.size(), 100000u);
  EXPECT_EQ(scene->objects.back().name, "tree 100000");
}

class OpenedScene : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder_.file("dem.asc"))
        << "ncols 4\nnrows 3\nxllcorner 1000\nyllcorner 2000\ncellsize 10\n"
           "NODATA_value -9999\n1 2 3 4\n2 9 4 5\n3 4 5 6\n";
    std::ofstream(folder_.file("box.obj"))
        << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  }
  Result<SceneRead> open(const std::string& objects) {
    const auto file = readSceneText("{\"objects\": [" + objects + "]}", folder_.file("s.json"));
    EXPECT_TRUE(file) << file.error().describe();
    return openScene(*file);
  }
  std::string refusal(const std::string& objects) {
    const auto read = open(objects);
    return read ? "" : read.error().describe();
  }
  const TemporaryFolder folder_;
};

TEST_F(OpenedScene, OpensEachFileOnceAndFindsTheGround) {
  std::filesystem::create_symlink(folder_.file("box.obj"), folder_.file("same.obj"));
  const auto read = open(R"({"file": "dem.asc"}, {"file": "box.obj", "at": [1015, 2015], "above": 2},
                            {"file": "./box.obj", "at": [1005, 2005, 70]}, {"file": "same.obj", "at": [1025, 2005]})");
  ASSERT_TRUE(read) << read.error().describe();
  const OpenScene& scene = read->scene;
  EXPECT_EQ(scene.models.size(), 2u);
  ASSERT_NE(scene.terrain(), nullptr);
  EXPECT_EQ(scene.objects[1].model, scene.objects[3].model);
  EXPECT_EQ(scene.objects[1].height, 11) << "9 there, and 2 above";
  EXPECT_EQ(scene.objects[2].height, 70);
  EXPECT_EQ(scene.objects[3].height, 5);
}

TEST_F(OpenedScene, RefusesWhatHasNoPlaceOrNoGround) {
  const auto says = [](const std::string& text, const char* words) {
    EXPECT_NE(text.find(words), std::string::npos) << text;
  };
  says(refusal(R"({"file": "dem.asc"}, {"file": "box.obj", "name": "b"})"), "it has no place");
  says(refusal(R"({"file": "dem.asc"}, {"file": "box.obj", "name": "b", "at": [0, 0]})"),
       "there is none at 0, 0");
  says(refusal(R"({"file": "dem.asc", "at": [1, 2]})"), "which lies where its coordinates say");
  says(refusal(R"({"file": "box.obj", "lonlat": [8, 47]})"), "need a terrain with a CRS");
  says(refusal(R"({"file": "none.obj", "name": "b", "at": [0, 0]})"), "\"b\", ");
  says(refusal(R"({"file": "dem.asc"}, {"file": "box.obj", "name": "b", "lonlat": [8, 47]})"), "\"b\"");
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
// arete los through the meshes of a scene: a tower on the plain with a wall.
#include <string>
#include <vector>

#include "cli/sight_fixture.h"

namespace arete::cli_test {
namespace {

class LosOfScene : public SightCommands {
 protected:
  void SetUp() override {
    SightCommands::SetUp();
    makeModel();
    // 10 by 10 m, 30 m high.
    write("tower.obj",
          "v -5 -5 0\nv 5 -5 0\nv 5 5 0\nv -5 5 0\nv -5 -5 30\nv 5 -5 30\nv 5 5 30\nv -5 5 30\n"
          "f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 7 8\nf 4 3 2 1\n");
    write(
        "scene.json",
        R"({"objects": [{"file": "dem.amt"}, {"name": "tower", "file": "tower.obj", "at": [1200, 1895]}]})");
  }
  Json ask(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = {"los", "scene.json", "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments).json();
  }
};

TEST_F(LosOfScene, NamesWhatIsFirstInTheWay) {
  const Json tower = ask({"--from", "1105,1895,20", "--to", "1505,1895,20"});
  EXPECT_EQ(tower["verdict"], "blocked");
  EXPECT_EQ(tower["blockedBy"], "tower") << "the wall at 1305 is behind it";
  EXPECT_NEAR(tower["obstruction"]["distance"].get<double>(), 90, 1e-6);
  EXPECT_NEAR(tower["obstruction"]["x"].get<double>(), 1195, 1e-6);
  EXPECT_NEAR(tower["obstruction"]["lineHeight"].get<double>(), 120, 1e-6);
  EXPECT_NEAR(tower["clearance"].get<double>(), -10, 1e-9) << "of the terrain alone";
  const Json wall = ask({"--from", "1505,1895,20", "--to", "1105,1895,20"});
  EXPECT_EQ(wall["blockedBy"], "terrain");
  EXPECT_NEAR(wall["obstruction"]["distance"].get<double>(), 200 - 10.0 / 3, 1e-6);
  const Json beside = ask({"--from", "1105,1911,20", "--to", "1285,1911,20"});
  EXPECT_EQ(beside["verdict"], "visible");
  EXPECT_TRUE(beside["blockedBy"].is_null());
  // Its top vertex is seen, and from there the plain.
  EXPECT_EQ(ask({"--from", "1105,1890,20", "--to", "1195,1890,30"})["verdict"], "visible");
  EXPECT_EQ(ask({"--from", "1205,1890,30", "--to", "1285,1890,1"})["verdict"], "visible");
  const Outcome text = run({"los", "scene.json", "--from", "1105,1895,20", "--to", "1285,1895,20"});
  EXPECT_NE(text.out.find("blocked by   tower\nobstruction  tower at 120 m at "), std::string::npos)
      << text.out;
}

TEST_F(LosOfScene, TablesHaveAColumnOfWhatBlocks) {
  write("pairs.csv",
        "x1,y1,h1,x2,y2,h2\n1105,1895,20,1285,1895,20\n1105,1911,20,1285,1911,20\n1285,1995,20,1505,1995,20\n"
        "1,1,1,2,2,2\n");
  const Outcome table = run({"los", "scene.json", "--pairs", "pairs.csv", "-o", "seen.csv"});
  ASSERT_EQ(table.code, 0) << table.err;
  const auto lines = linesOf(read("seen.csv"));
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_NE(lines[0].find(",gap,blocked_by,visited,error"), std::string::npos) << lines[0];
  EXPECT_NE(lines[1].find(",tower,"), std::string::npos) << lines[1];
  EXPECT_NE(lines[2].find("visible"), std::string::npos) << lines[2];
  EXPECT_NE(lines[3].find(",terrain,"), std::string::npos) << lines[3];
  ASSERT_EQ(run({"los", "dem.amt", "--pairs", "pairs.csv", "-o", "bare.csv"}).code, 0);
  EXPECT_EQ(read("bare.csv").find("blocked_by"), std::string::npos);
}

TEST_F(LosOfScene, AMeshBlocksOverAVoidToo) {
  write(
      "scene.json",
      R"({"objects": [{"file": "dem.amt"}, {"name": "pier", "file": "tower.obj", "at": [1305, 1640, 100]}]})");
  const std::vector<std::string> line = {"--from", "1105,1640,20", "--to", "1505,1640,20"};
  EXPECT_EQ(ask(line)["verdict"], "blocked");
  EXPECT_EQ(ask(line)["blockedBy"], "pier");
  write("scene.json", R"({"objects": [{"file": "dem.amt"}]})");
  EXPECT_EQ(ask(line)["verdict"], "unknown");
}

TEST_F(LosOfScene, WithoutTerrainLinesAreInMetresOfTheScene) {
  write("scene.json", R"({"objects": [{"name": "a", "file": "tower.obj"},
                                      {"name": "b", "file": "tower.obj", "at": [100, 0, 20], "scale": 2}]})");
  const Json low = ask({"--from", "-50,0,10", "--to", "150,0,10"});
  EXPECT_EQ(low["blockedBy"], "a");
  EXPECT_NEAR(low["obstruction"]["distance"].get<double>(), 45, 1e-6);
  const Json high = ask({"--from", "-50,0,40", "--to", "150,0,40"});
  EXPECT_EQ(high["blockedBy"], "b");
  EXPECT_NEAR(high["obstruction"]["x"].get<double>(), 90, 1e-6);
  EXPECT_EQ(ask({"--from", "-50,0,90", "--to", "150,0,90"})["verdict"], "visible");
  EXPECT_EQ(ask({"--from", "20,-50,10", "--to", "20,50,10"})["verdict"], "visible");
}

TEST_F(LosOfScene, WhatASceneCannotAnswerIsRefused) {
  refused({"los", "scene.json", "--from", "1105,1895,20", "--to", "1505,1895,20", "--max-error", "1"}, 2,
          "--max-error");
  write("bad.json", R"({"objects": [{"file": "dem.amt"}, {"file": "tower.obj", "at": [1, 1]}]})");
  refused({"los", "bad.json", "--from", "1105,1895,20", "--to", "1505,1895,20"}, 4, "objects[1] 'tower': at");
  write("bare.json", R"({"crs": "EPSG:32632", "objects": [{"file": "tower.obj"}]})");
  refused({"los", "bare.json", "--from", "1,1,1", "--to", "2,2,2"}, 4, "no terrain");
  refused({"los", "none.json", "--from", "1,1,1", "--to", "2,2,2"}, 3, "none.json");
}

TEST_F(LosOfScene, InfoNamesObjectsAndFiles) {
  const Json json = run({"info", "scene.json", "--json"}).json();
  EXPECT_EQ(json["terrain"], "dem");
  EXPECT_EQ(json["objects"][1]["name"], "tower");
  EXPECT_EQ(json["objects"][1]["triangles"], 12);
  EXPECT_EQ(json["files"].size(), 2u);
  const Outcome text = run({"info", "scene.json"});
  EXPECT_NE(text.out.find("scene.json: 2 objects of 2 files"), std::string::npos) << text.out;
  EXPECT_NE(text.out.find("1200,1895 on the ground"), std::string::npos) << text.out;
  refused({"info", "scene.json", "--at", "1"}, 2, "--at");
}

}  // namespace
}  // namespace arete::cli_test

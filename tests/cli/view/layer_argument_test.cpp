// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/view/layer_argument.h"

#include <gtest/gtest.h>

#include "cli/cli_fixture.h"

namespace arete::cli_test {
namespace {

TEST(LayerArgument, TakesKeysBehindTheFile) {
  const auto layer = LayerArgument::of(
      "a,b/roads 2.gpkg,name=main, side,label=ref,color=#0a5,width=3.5,opacity=0.25,height=own,title=Ways",
      0);
  ASSERT_TRUE(layer) << layer.error().describe();
  EXPECT_EQ(layer->file, "a,b/roads 2.gpkg");
  EXPECT_EQ(layer->read.layer, "main, side") << "a comma that begins no key is a part of the value";
  EXPECT_EQ(layer->read.label, "ref");
  EXPECT_EQ(layer->style.color, (Rgb{0x00, 0xaa, 0x55}));
  EXPECT_EQ(layer->style.width, 3.5);
  EXPECT_EQ(layer->style.opacity, 0.25);
  EXPECT_TRUE(layer->ground.floats);
  EXPECT_EQ(layer->title, "Ways");
}

TEST(LayerArgument, LayersWithoutAColourDiffer) {
  EXPECT_FALSE(LayerArgument::of("a.gpkg", 0)->style.color == LayerArgument::of("a.gpkg", 1)->style.color);
}

TEST(LayerArgument, RefusesWhatItDoesNotKnow) {
  for (const auto& [text, part] : std::vector<std::pair<const char*, const char*>>{
           {"a.gpkg,colour=red", "'colour' is unknown; known are name, label"},
           {"a.gpkg,color=red", "#d62828"},
           {"a.gpkg,color=#12345", "#d62828"},
           {"a.gpkg,width=0", "pixels"},
           {"a.gpkg,width=nan", "pixels"},
           {"a.gpkg,opacity=1.5", "0 to 1"},
           {"a.gpkg,opacity=", "needs a value"},
           {"a.gpkg,width=2,width=3", "twice"},
           {"a.gpkg,height=5", "ground, or own"},
           {",width=2", "name of a file first"}}) {
    const auto layer = LayerArgument::of(text, 0);
    ASSERT_FALSE(layer) << text;
    EXPECT_EQ(layer.error().code, ErrorCode::usage) << text;
    EXPECT_NE(layer.error().describe().find(part), std::string::npos) << layer.error().describe();
    EXPECT_NE(layer.error().culprit.find(text), std::string::npos) << "of several layers, which";
  }
}

class ViewLayers : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    makeRaster("dem.tif", "fractal", 60, 50);
    ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt", "-q"}).code, 0);
  }
  Outcome shoot(const std::string& name, std::vector<std::string> more) {
    std::vector<std::string> words = {"view",    "dem.amt", "--screenshot", name,    "--size",
                                      "160x100", "--home",  "above",        "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
};

TEST_F(ViewLayers, AreDrawnInScreenshotsAndCounted) {
  const Outcome plain = shoot("plain.png", {});
  if (plain.err.find("no OpenGL 4.5 context") != std::string::npos) GTEST_SKIP() << plain.err;
  ASSERT_EQ(plain.code, 0) << plain.err;
  write("points, old.csv", "x,y,what\n500900,5199300,A\n500600,5199000,B\n1,1,C\n");
  write("way.csv", "id,WKT\n1,\"LINESTRING (500100 5199900, 501500 5198700)\"\n");
  const Outcome both = shoot("both.png", {"--layer", "points, old.csv,label=what,title=Posts", "--layer",
                                          "way.csv,color=#0000ff,width=4", "--layer", "way.csv,opacity=0.5"});
  ASSERT_EQ(both.code, 0) << both.err;
  const auto layers = both.json()["layers"];
  ASSERT_EQ(layers.size(), 3u);
  EXPECT_EQ(layers[0]["name"], "Posts");
  EXPECT_EQ(layers[0]["points"], 2);
  EXPECT_EQ(layers[0]["labels"], 2);
  EXPECT_NE(both.err.find("1 of 3 points is not on the terrain"), std::string::npos) << both.err;
  EXPECT_EQ(layers[1]["lines"], 1);
  EXPECT_EQ(layers[2]["name"], "way 2") << "names of layers differ";
  EXPECT_FALSE(read("both.png") == read("plain.png"));
  // A layer that shines through wholly is not there, however wide it is.
  for (const char* name : {"thin", "wide", "seen"}) {
    const std::string keys = name == std::string("thin")   ? ",opacity=0"
                             : name == std::string("wide") ? ",opacity=0,width=20"
                                                           : ",width=20";
    const Outcome one = shoot(std::string(name) + ".png", {"--layer", "way.csv" + keys});
    ASSERT_EQ(one.code, 0) << one.err;
  }
  EXPECT_TRUE(read("thin.png") == read("wide.png"));
  EXPECT_FALSE(read("thin.png") == read("seen.png"));
}

TEST_F(ViewLayers, ThatAreNotOnTheTerrainAreRefusedBeforeAnythingIsDrawn) {
  write("far.csv", "x,y\n1,1\n");
  const Outcome far = shoot("far.png", {"--layer", "far.csv"});
  EXPECT_EQ(far.code, 4) << far.err;
  EXPECT_NE(far.err.find("far.csv: nothing of the layer 'far' is on the terrain"), std::string::npos)
      << far.err;
  EXPECT_FALSE(exists("far.png"));
  const Outcome unknown = shoot("far.png", {"--layer", "far.csv,colour=red"});
  EXPECT_EQ(unknown.code, 2);
  EXPECT_NE(unknown.err.find("--layer far.csv,colour=red"), std::string::npos) << unknown.err;
}

TEST_F(ViewLayers, LabelsWithoutRoomAreCounted) {
  std::string crowd = "x,y,what\n";
  for (int i = 0; i < 40; ++i) crowd += "500900,5199300,crowd\n";
  write("crowd.csv", crowd);
  const Outcome made = shoot("crowd.png", {"--layer", "crowd.csv,label=what"});
  if (made.err.find("no OpenGL 4.5 context") != std::string::npos) GTEST_SKIP() << made.err;
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_NE(made.err.find("of 40 labels have no room in the picture"), std::string::npos) << made.err;
}

TEST_F(ViewLayers, DrapesLieOverEachOther) {
  makeRaster("other.tif", "fractal", 60, 50);
  const Outcome one = shoot("one.png", {"--drape", "other.tif"});
  if (one.err.find("no OpenGL 4.5 context") != std::string::npos) GTEST_SKIP() << one.err;
  ASSERT_EQ(one.code, 0) << one.err;
  const Outcome two = shoot("two.png", {"--drape", "other.tif,opacity=0.5", "--drape", "dem.tif,opacity=0"});
  ASSERT_EQ(two.code, 0) << two.err;
  EXPECT_EQ(two.json()["layers"].size(), 2u);
  EXPECT_EQ(two.json()["layers"][1]["name"], "drape 2");
  EXPECT_EQ(two.json()["drape"]["file"], "other.tif");
  EXPECT_FALSE(read("one.png") == read("two.png"));
}

}  // namespace
}  // namespace arete::cli_test

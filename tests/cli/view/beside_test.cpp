// SPDX-License-Identifier: GPL-3.0-or-later
//
// Two models beside each other (arete view --beside). A half is held against a picture of its model alone
// with the camera and the size of the half.
#include <array>
#include <vector>

#include "cli/ball_fixture.h"
#include "io/geo/gdal/support.h"

namespace arete::cli_test {
namespace {

class Beside : public Balls {
 protected:
  static bool isWithoutOpenGl(const Outcome& o) {
    return o.err.find("no OpenGL 4.5 context") != std::string::npos;
  }
  Outcome shoot(const std::string& picture, std::vector<std::string> more) {
    std::vector<std::string> words = {"view",      "ball.obj", "--headless", "--screenshot",
                                      picture,     "--size",   "240x120",    "--no-decorations",
                                      "--samples", "1",        "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  /// Of the pixels from column `from` on, `width` of them.
  std::vector<std::uint8_t> part(const std::string& name, int from, int width) {
    const GdalDatasetPtr png = openGdal(path(name), GDAL_OF_RASTER);
    std::vector<std::uint8_t> bytes(std::size_t(width) * 120 * 3);
    for (int band = 0; png && band < 3; ++band)
      EXPECT_EQ(png->GetRasterBand(band + 1)->RasterIO(GF_Read, from, 0, width, 120,
                                                       &bytes[std::size_t(band) * width * 120], width, 120,
                                                       GDT_Byte, 0, 0, nullptr),
                CE_None);
    return bytes;
  }
};

TEST_F(Beside, EachHalfIsThePictureOfItsModelUnderOneCamera) {
  // The other one is larger, so that the halves differ.
  ASSERT_EQ(run({"mesh", "place", "ball.obj", "-o", "large.obj", "--scale", "1.4"}).code, 0);
  const std::vector<std::string> camera = {"--camera", "5,-5,3,0,0,0"};
  std::vector<std::string> both = {"--beside", "large.obj"};
  both.insert(both.end(), camera.begin(), camera.end());
  const Outcome shot = shoot("both.png", both);
  if (isWithoutOpenGl(shot)) GTEST_SKIP() << shot.err;
  ASSERT_EQ(shot.code, 0) << shot.err;
  EXPECT_EQ(shot.json()["screenshot"]["objects"].size(), 2u);
  EXPECT_EQ(shot.json()["screenshot"]["objects"][1]["name"], "large.obj");
  const std::array<std::string, 2> files = {"ball.obj", "large.obj"};
  for (std::size_t half = 0; half < 2; ++half) {
    const Outcome alone = run({"view", files[half], "--headless", "--screenshot", "alone.png", "--size",
                               "120x120", "--no-decorations", "--samples", "1", "--camera", "5,-5,3,0,0,0"});
    ASSERT_EQ(alone.code, 0) << alone.err;
    // Not the columns of the line between the halves.
    const int from = half == 0 ? 0 : 121;
    const auto shown = part("both.png", from, 119), expected = part("alone.png", half == 0 ? 0 : 1, 119);
    std::size_t unlike = 0;
    for (std::size_t i = 0; i < shown.size(); ++i) unlike += std::abs(shown[i] - expected[i]) > 3 ? 1 : 0;
    EXPECT_LT(unlike, shown.size() / 50) << files[half];
  }
}

TEST_F(Beside, DistancesAreTheDistancesOfTheVerticesToTheOtherSurface) {
  ASSERT_EQ(run({"mesh", "place", "ball.obj", "-o", "moved.obj", "--move", "0,0,0.5"}).code, 0);
  const Outcome shot = shoot("d.png", {"--beside", "moved.obj", "--distances"});
  if (isWithoutOpenGl(shot)) GTEST_SKIP() << shot.err;
  ASSERT_EQ(shot.code, 0) << shot.err;
  const Json distances = shot.json()["distances"];
  // The pole is half a radius from the other's; at the side of a pole the other sphere is nearer.
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(double(distances[i]["largest"]), 0.5, 0.01);
    EXPECT_GT(double(distances[i]["mean"]), 0.1);
    EXPECT_LT(double(distances[i]["mean"]), 0.4);
  }
}

TEST_F(Beside, ALevelOfTheOtherIsByHand) {
  ASSERT_EQ(run({"build", "ball.obj", "-o", "ball.amt", "-q"}).code, 0);
  const Outcome shot = shoot("l.png", {"--beside", "ball.amt,triangles=200"});
  if (isWithoutOpenGl(shot)) GTEST_SKIP() << shot.err;
  ASSERT_EQ(shot.code, 0) << shot.err;
  const Json objects = shot.json()["screenshot"]["objects"];
  EXPECT_LE(int(objects[1]["triangles"]), 200);
  EXPECT_GT(int(objects[0]["triangles"]), 200);
}

TEST_F(Beside, SaysWhatIsWrongInASentence) {
  makeRaster("dem.tif", "fractal", 30, 20);
  write("scene.json", R"({"objects": [{"file": "ball.obj"}]})");
  for (const auto& [more, sentence] :
       {std::pair{std::vector<std::string>{"--beside", "none.obj"}, "none.obj"},
        {{"--beside", "dem.tif"}, "is a mesh on terrain"},
        {{"--beside", "scene.json"}, "a scene has its objects"},
        {{"--beside", "ball.obj,triangles=many"}, "many is not a number of triangles"},
        {{"--beside", "ball.obj,error=1,triangles=9"}, "one of them"},
        {{"--distances"}, "--beside"}}) {
    const Outcome refused = shoot("x.png", more);
    EXPECT_NE(refused.code, 0);
    EXPECT_NE(refused.err.find(sentence), std::string::npos) << refused.err << refused.out;
    EXPECT_FALSE(exists("x.png"));
  }
}

}  // namespace
}  // namespace arete::cli_test

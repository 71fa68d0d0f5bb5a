// SPDX-License-Identifier: GPL-3.0-or-later
// arete view of terrain and of surfaces in pages.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "cli/ball_fixture.h"
#include "cli/cli_fixture.h"

namespace arete::cli_test {
namespace {

class ViewOfPages : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    makeRaster("dem.tif", "fractal", 300, 260);
    ASSERT_EQ(run({"build", "dem.tif", "-o", "paged.amt", "--paged", "-q"}).code, 0);
  }
  Outcome shoot(std::vector<std::string> more) const {
    std::vector<std::string> words = {"view",   "paged.amt", "--screenshot", "view.png",
                                      "--size", "200x120",   "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  static bool isWithoutOpenGl(const Outcome& o) {
    return o.err.find("no OpenGL 4.5 context") != std::string::npos;
  }
};

TEST_F(ViewOfPages, DrawsAPictureWithinItsToleranceOfAPartOfThePages) {
  const Outcome shot = shoot({"--camera", "503900,5196100,20,0,-20"});
  if (isWithoutOpenGl(shot)) GTEST_SKIP() << shot.err;
  ASSERT_EQ(shot.code, 0) << shot.err;
  const auto figures = shot.json()["screenshot"]["figures"];
  EXPECT_EQ(figures["pixelError"], 1.0);
  EXPECT_EQ(figures["pages"]["missingTriangles"], 0);
  EXPECT_EQ(figures["pages"]["missing"], 0);
  EXPECT_TRUE(figures["isComplete"].get<bool>());
}

TEST_F(ViewOfPages, ReadsAllFirstWhereThatIsAskedForOrNeededAndSaysSo) {
  const Outcome whole = shoot({"--page-memory", "0"});
  if (isWithoutOpenGl(whole)) GTEST_SKIP() << whole.err;
  ASSERT_EQ(whole.code, 0) << whole.err;
  EXPECT_FALSE(whole.json()["screenshot"]["figures"].contains("pages"));
  for (const std::vector<std::string>& needy :
       {std::vector<std::string>{"--contours", "20"}, {"--color", "slope"}, {"--color", "aspect"}}) {
    const Outcome shot = shoot(needy);
    ASSERT_EQ(shot.code, 0) << shot.err;
    EXPECT_NE(shot.err.find(needy[0]), std::string::npos) << shot.err;
    EXPECT_NE(shot.err.find("needs all of the model"), std::string::npos) << shot.err;
    EXPECT_FALSE(shot.json()["screenshot"]["figures"].contains("pages"));
  }
}

TEST_F(ViewOfPages, FliesWithABudgetAFrameAndGivesTheFiguresOfEach) {
  const auto fly = [&](const std::string& frames, const std::string& threads) {
    return run({"view", "paged.amt", "--round", "--frames", frames, "--fps", "0.3", "--size", "160x100",
                "--page-budget", "8", "--threads", threads, "--json"});
  };
  const Outcome flown = fly("frames", "1");
  if (isWithoutOpenGl(flown)) GTEST_SKIP() << flown.err;
  ASSERT_EQ(flown.code, 0) << flown.err;
  const auto frames = flown.json()["frames"];
  ASSERT_GT(frames.size(), 2u);
  for (const auto& frame : frames) {
    EXPECT_LE(frame["pages"]["bytes"].get<int>(), 40'000);
    if (frame["pages"]["missingTriangles"] == 0) {
      EXPECT_EQ(frame["pixelError"], 1.0);
    }
  }
  ASSERT_EQ(fly("again", "3").code, 0);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::string name = fmt::format("/frame_{:05}.png", i);
    EXPECT_EQ(read("frames" + name), read("again" + name)) << i;
  }
}

TEST_F(ViewOfPages, SaysSoWhereTheBudgetOfMemoryIsTooSmallForItsTolerance) {
  const Outcome shot =
      shoot({"--page-memory", "1", "--pixel-error", "0.001", "--camera", "503900,5196100,20,0,-20"});
  if (isWithoutOpenGl(shot)) GTEST_SKIP() << shot.err;
  ASSERT_EQ(shot.code, 0) << shot.err;
  const auto figures = shot.json()["screenshot"]["figures"];
  if (figures["pages"]["missingTriangles"] > 0) {
    EXPECT_NE(shot.err.find("--page-memory"), std::string::npos) << shot.err;
  }
  EXPECT_LE(figures["pages"]["residentBytes"].get<int>(), 1 << 20);
}

class ViewOfSurfacePages : public Balls {
 protected:
  void SetUp() override {
    Cli::SetUp();
    write("ball.obj", ball(120, 80));
    ASSERT_EQ(run({"build", "ball.obj", "-o", "paged.amt", "--paged", "-q"}).code, 0);
  }
  Outcome shoot(std::vector<std::string> more) const {
    std::vector<std::string> words = {"view",   "paged.amt", "--screenshot", "view.png",
                                      "--size", "200x120",   "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  static bool isWithoutOpenGl(const Outcome& o) {
    return o.err.find("no OpenGL 4.5 context") != std::string::npos;
  }
};

TEST_F(ViewOfSurfacePages, DrawsAPictureWithinItsToleranceOfAPartOfThePages) {
  const Outcome shot = shoot({"--camera", "3,0,1,0,0,0", "--pixel-error", "0.3"});
  if (isWithoutOpenGl(shot)) GTEST_SKIP() << shot.err;
  ASSERT_EQ(shot.code, 0) << shot.err;
  const auto figures = shot.json()["screenshot"]["figures"];
  EXPECT_EQ(figures["pixelError"], 0.3);
  EXPECT_EQ(figures["pages"]["missingTriangles"], 0);
  EXPECT_EQ(figures["pages"]["missing"], 0);
  EXPECT_TRUE(figures["showsSurface"].get<bool>());
  EXPECT_EQ(shot.err.find("needs all of the model"), std::string::npos) << shot.err;
}

TEST_F(ViewOfSurfacePages, ReadsAllFirstWhereThatIsAskedForOrNeededAndSaysSo) {
  const Outcome whole = shoot({"--page-memory", "0"});
  if (isWithoutOpenGl(whole)) GTEST_SKIP() << whole.err;
  ASSERT_EQ(whole.code, 0) << whole.err;
  EXPECT_FALSE(whole.json()["screenshot"]["figures"].contains("pages"));
  for (const std::vector<std::string>& needy :
       {std::vector<std::string>{"--color", "charts"}, {"--color", "stretch"}, {"--beside", "ball.obj"}}) {
    const Outcome shot = shoot(needy);
    ASSERT_EQ(shot.code, 0) << shot.err;
    EXPECT_NE(shot.err.find(needy[0]), std::string::npos) << shot.err;
    EXPECT_NE(shot.err.find("needs all of the model"), std::string::npos) << shot.err;
    EXPECT_FALSE(shot.json()["screenshot"]["figures"].contains("pages"));
  }
}

TEST_F(ViewOfSurfacePages, FliesWithABudgetAFrameAndGivesTheSamePicturesForAnyNumberOfThreads) {
  const auto fly = [&](const std::string& frames, const std::string& threads) {
    return run({"view", "paged.amt", "--round", "--frames", frames, "--fps", "0.4", "--size", "160x100",
                "--pixel-error", "0.05", "--page-budget", "4", "--threads", threads, "--json"});
  };
  const Outcome flown = fly("frames", "1");
  if (isWithoutOpenGl(flown)) GTEST_SKIP() << flown.err;
  ASSERT_EQ(flown.code, 0) << flown.err;
  const auto frames = flown.json()["frames"];
  ASSERT_GT(frames.size(), 2u);
  for (const auto& frame : frames) EXPECT_TRUE(frame.contains("pages"));
  ASSERT_EQ(fly("again", "3").code, 0);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::string name = fmt::format("/frame_{:05}.png", i);
    EXPECT_EQ(read("frames" + name), read("again" + name)) << i;
  }
}

TEST_F(ViewOfSurfacePages, SaysWhichPageIsDamaged) {
  std::string bytes = read("paged.amt");
  bytes[bytes.size() - 40] ^= 1;
  bytes[bytes.size() / 2] ^= 1;
  write("paged.amt", bytes);
  const Outcome shot = shoot({"--pixel-error", "0.001"});
  if (isWithoutOpenGl(shot)) GTEST_SKIP() << shot.err;
  EXPECT_EQ(shot.code, 4) << shot.err;
  EXPECT_NE(shot.err.find("paged.amt"), std::string::npos) << shot.err;
  EXPECT_FALSE(exists("view.png"));
}

TEST_F(ViewOfSurfacePages, OfARealScanReadsLessForWhatIsNear) {
  const std::string scan = realData("meshes/horse.ply");
  if (scan.empty()) GTEST_SKIP() << "the horse is not here (set ARETE_DATA)";
  fs::remove(path("paged.amt"));
  const Outcome built = run({"build", scan, "-o", "paged.amt", "--paged", "-q"});
  ASSERT_EQ(built.code, 0) << built.err;
  const Outcome all = shoot({"--pixel-error", "0.3"});
  if (isWithoutOpenGl(all)) GTEST_SKIP() << all.err;
  ASSERT_EQ(all.code, 0) << all.err;
  const Outcome narrow = shoot({"--camera", "0.0957,-0.1574,0.0428,-0.0406,0.0374,-0.0437,1"});
  ASSERT_EQ(narrow.code, 0) << narrow.err;
  std::uint64_t bytes[2] = {};
  for (const Outcome* const shot : {&all, &narrow}) {
    const auto figures = shot->json()["screenshot"]["figures"];
    EXPECT_EQ(figures["pixelError"], shot == &all ? 0.3 : 1.0);
    EXPECT_EQ(figures["pages"]["missingTriangles"], 0);
    bytes[shot == &all ? 0 : 1] = figures["pages"]["bytes"].get<std::uint64_t>();
  }
  EXPECT_GT(bytes[0], 0u);
  EXPECT_LT(bytes[1], fs::file_size(path("paged.amt")) / 2);
}

}  // namespace
}  // namespace arete::cli_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/panel/overwrite_question.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <string>

namespace arete {
namespace {

namespace fs = std::filesystem;

class OverwriteQuestionTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              (std::string("overwrite_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path file(const std::string& name) {
    std::ofstream(folder_ / name) << "kept";
    return folder_ / name;
  }
  fs::path folder_;
};

TEST_F(OverwriteQuestionTest, AFreePathIsWrittenAtOnce) {
  OverwriteQuestion question;
  EXPECT_TRUE(question.mayDo(Saving::flight, folder_ / "flight.json"));
  EXPECT_TRUE(question.mayDo(Saving::frames, folder_ / "frames"));
  EXPECT_TRUE(question.mayDo(Saving::flight, folder_ / "no folder" / "flight.json"));
  EXPECT_FALSE(question.isWaiting());
  EXPECT_EQ(question.sentence(), "");
  EXPECT_FALSE(question.yes()) << "an answer to no question";
}

TEST_F(OverwriteQuestionTest, AFileThatExistsWaitsForTheAnswer) {
  const fs::path path = file("flight.json");
  OverwriteQuestion question;
  EXPECT_FALSE(question.mayDo(Saving::flight, path));
  EXPECT_TRUE(question.isWaiting());
  EXPECT_EQ(question.sentence(), path.string() + " exists. Overwrite it?");
  const auto wish = question.yes();
  ASSERT_TRUE(wish);
  EXPECT_EQ(wish->path, path);
  EXPECT_EQ(wish->saving, Saving::flight);
  EXPECT_FALSE(question.isWaiting());
  EXPECT_FALSE(question.yes()) << "one answer is one file";
}

TEST_F(OverwriteQuestionTest, NoLeavesEverythingAsItIs) {
  const fs::path path = file("flight.json");
  OverwriteQuestion question;
  EXPECT_FALSE(question.mayDo(Saving::flight, path));
  question.no();
  EXPECT_FALSE(question.isWaiting());
  EXPECT_FALSE(question.yes());
  EXPECT_FALSE(question.mayDo(Saving::flight, path)) << "and is asked again the next time";
}

TEST_F(OverwriteQuestionTest, ALaterWishReplacesTheOneThatWaits) {
  const fs::path first = file("one.json"), second = file("two.json");
  OverwriteQuestion question;
  EXPECT_FALSE(question.mayDo(Saving::flight, first));
  EXPECT_FALSE(question.mayDo(Saving::flight, second));
  EXPECT_EQ(question.yes()->path, second);
  EXPECT_FALSE(question.mayDo(Saving::flight, first));
  EXPECT_TRUE(question.mayDo(Saving::flight, folder_ / "free.json"));
  EXPECT_FALSE(question.isWaiting()) << "a yes to the new wish does not reach the old one";
}

TEST_F(OverwriteQuestionTest, FramesOfAnEarlierFilmAreCountedAndOtherFilesAreNot) {
  for (const char* name : {"frame_00000.png", "frame_00001.png", "frame_.png", "frame_one.png", "view.png",
                           "frame_00002.jpg", "frame_00003.png.part"})
    file(name);
  OverwriteQuestion question;
  EXPECT_FALSE(question.mayDo(Saving::frames, folder_));
  EXPECT_EQ(question.sentence(), folder_.string() + " holds 2 frames. Overwrite them?");
  fs::remove(folder_ / "frame_00000.png");
  EXPECT_EQ(lostBySaving(Saving::frames, folder_), folder_.string() + " holds 1 frame");
  fs::remove(folder_ / "frame_00001.png");
  EXPECT_TRUE(question.mayDo(Saving::frames, folder_));
}

TEST_F(OverwriteQuestionTest, AFolderIsNoFileAndAFileIsNoFolder) {
  fs::create_directories(folder_ / "flight.json");
  EXPECT_EQ(lostBySaving(Saving::flight, folder_ / "flight.json"), "");
  EXPECT_EQ(lostBySaving(Saving::frames, file("frames")), "");
}

TEST_F(OverwriteQuestionTest, ANameThatIsTakenGetsTheNextNumber) {
  const fs::path path = folder_ / "arete.v2.png";
  EXPECT_EQ(freePath(path), path);
  file("arete.v2.png");
  EXPECT_EQ(freePath(path), folder_ / "arete.v2-2.png");
  file("arete.v2-2.png");
  EXPECT_EQ(freePath(path), folder_ / "arete.v2-3.png");
}

}  // namespace
}  // namespace arete

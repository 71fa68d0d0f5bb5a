// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/files/output_file.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "io/files/file_writer.h"
#include "io/files/temporary_files.h"
#include "io/files/watched_files.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

class OutputFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("arete-output-" + std::to_string(::getpid()) + "-" +
                                           ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  static void put(const fs::path& path, const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
  }
  static std::string contents(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  }
  std::ptrdiff_t filesThere() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }

  fs::path folder_;
};

TEST_F(OutputFileTest, AppearsOnlyWhenCommitted) {
  const fs::path path = folder_ / "dem.tif";
  put(path, "old");
  Result<OutputFile> file = OutputFile::create(path);
  ASSERT_TRUE(file);
  EXPECT_EQ(file->temporaryPath().parent_path(), fs::canonical(folder_));
  EXPECT_EQ(file->temporaryPath().extension(), ".tif");
  EXPECT_FALSE(fs::exists(file->temporaryPath()));
  put(file->temporaryPath(), "new");
  put(file->temporaryPath().string() + ".aux.xml", "aux");
  EXPECT_EQ(contents(path), "old");
  ASSERT_TRUE(file->commit());
  EXPECT_EQ(contents(path), "new");
  EXPECT_EQ(contents(path.string() + ".aux.xml"), "aux");
  EXPECT_EQ(filesThere(), 2);
  EXPECT_FALSE(file->commit());
}

TEST_F(OutputFileTest, LeavesNothingBehindWithoutACommit) {
  const fs::path path = folder_ / "model.gpkg";
  put(path, "old");
  {
    Result<OutputFile> file = OutputFile::create(path);
    ASSERT_TRUE(file);
    put(file->temporaryPath(), "new");
    put(file->temporaryPath().string() + "-journal", "journal");
    OutputFile moved = std::move(*file);
    EXPECT_EQ(filesThere(), 3);
  }
  EXPECT_EQ(filesThere(), 1);
  EXPECT_EQ(contents(path), "old");
}

TEST_F(OutputFileTest, SaysWhenNothingWasWritten) {
  Result<OutputFile> file = OutputFile::create(folder_ / "a.ply");
  ASSERT_TRUE(file);
  const Status status = file->commit();
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::unreadable);
  EXPECT_NE(status.error().describe().find("a.ply"), std::string::npos);
}

TEST_F(OutputFileTest, NamesAreUnique) {
  const Result<OutputFile> a = OutputFile::create(folder_ / "a.ply"),
                           b = OutputFile::create(folder_ / "a.ply");
  ASSERT_TRUE(a && b);
  EXPECT_NE(a->temporaryPath(), b->temporaryPath());
  const Result<OutputFile> longName = OutputFile::create(folder_ / (std::string(250, 'x') + ".ply"));
  ASSERT_TRUE(longName);
  EXPECT_LT(longName->temporaryPath().filename().string().size(), 255u);
}

TEST_F(OutputFileTest, RefusesFoldersThatAreNotThere) {
  EXPECT_EQ(OutputFile::create(folder_ / "no" / "a.ply").error().code, ErrorCode::notFound);
  EXPECT_EQ(OutputFile::create(folder_).error().code, ErrorCode::unreadable);
  EXPECT_FALSE(OutputFile::create(""));
}

TEST_F(OutputFileTest, FollowsLinksAndWritesDevicesInPlace) {
  put(folder_ / "real.ply", "old");
  fs::create_symlink(folder_ / "real.ply", folder_ / "link.ply");
  Result<FileWriter> writer = FileWriter::create(folder_ / "link.ply");
  ASSERT_TRUE(writer);
  writer->write("new");
  ASSERT_TRUE(writer->finish());
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.ply"));
  EXPECT_EQ(contents(folder_ / "real.ply"), "new");

  Result<FileWriter> null = FileWriter::create("/dev/null");
  ASSERT_TRUE(null);
  null->write("nothing");
  EXPECT_TRUE(null->finish());
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(OutputFileTest, FollowsALinkToWhatIsNotThereYet) {
  fs::create_directory(folder_ / "far");
  fs::create_symlink("far/real.ply", folder_ / "link.ply");
  fs::create_symlink("link.ply", folder_ / "link2.ply");
  Result<FileWriter> writer = FileWriter::create(folder_ / "link2.ply");
  ASSERT_TRUE(writer);
  writer->write("new");
  ASSERT_TRUE(writer->finish());
  EXPECT_EQ(contents(folder_ / "far" / "real.ply"), "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.ply") && fs::is_symlink(folder_ / "link2.ply"));
  fs::create_symlink("nowhere/real.ply", folder_ / "link3.ply");
  EXPECT_EQ(OutputFile::create(folder_ / "link3.ply").error().code, ErrorCode::notFound);
  fs::create_symlink("loop.ply", folder_ / "loop.ply");
  EXPECT_FALSE(OutputFile::create(folder_ / "loop.ply"));
}

TEST_F(OutputFileTest, RemovesWhatKilledRunsHaveLeft) {
  const pid_t child = fork();
  if (child == 0) {
    // The child is ended in the middle of its work.
    Result<OutputFile> file = OutputFile::create(folder_ / "a.gpkg");
    put(file->temporaryPath(), "half");
    put(file->temporaryPath().string() + "-journal", "half");
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  put(folder_ / ".a.1-00000000-0.gpkg", "of another machine");
  put(folder_ / ".hidden", "of somebody");
  ASSERT_EQ(filesThere(), 4);
  removeAbandonedFiles(fs::canonical(folder_));
  EXPECT_EQ(filesThere(), 2);
  EXPECT_TRUE(fs::exists(folder_ / ".a.1-00000000-0.gpkg") && fs::exists(folder_ / ".hidden"));
}

TEST_F(OutputFileTest, IsNotWrittenFromAnInputThatChanged) {
  watchInputFiles();
  const std::string input = (folder_ / "input").string();
  put(input, "before");
  watchInputFile(input);
  EXPECT_EQ(changedInputFile(), nullptr);
  {
    Result<FileWriter> writer = FileWriter::create(folder_ / "a.ply");
    ASSERT_TRUE(writer);
    put(input, "longer than before");
    EXPECT_STREQ(changedInputFile(), input.c_str());
    const Status finished = writer->finish();
    ASSERT_FALSE(finished);
    EXPECT_EQ(finished.error().culprit, input);
  }
  EXPECT_EQ(filesThere(), 1);
  // A file that this process replaces is its own.
  Result<FileWriter> writer = FileWriter::create(input);
  ASSERT_TRUE(writer);
  forgetInputFile(input);
  EXPECT_TRUE(writer->finish());
  EXPECT_EQ(changedInputFile(), nullptr);
}

TEST_F(OutputFileTest, OfAGroupAppearTogetherOrNotAtAll) {
  const auto writeBoth = [&](bool commits) {
    OutputGroup together;
    for (const char* name : {"mesh.mtl", "mesh.obj"}) {
      Result<OutputFile> file = OutputFile::create(folder_ / name);
      ASSERT_TRUE(file);
      put(file->temporaryPath(), "new");
      EXPECT_EQ(OutputGroup::placeOf(folder_ / name), folder_ / name);
      ASSERT_TRUE(file->commit());
      EXPECT_EQ(contents(OutputGroup::placeOf(folder_ / name)), "new");
    }
    EXPECT_EQ(contents(folder_ / "mesh.obj"), "old");
    EXPECT_FALSE(fs::exists(folder_ / "mesh.mtl"));
    if (commits) {
      ASSERT_TRUE(together.commit());
    }
  };
  put(folder_ / "mesh.obj", "old");
  writeBoth(false);
  EXPECT_EQ(contents(folder_ / "mesh.obj"), "old");
  EXPECT_EQ(filesThere(), 1);
  writeBoth(true);
  EXPECT_EQ(contents(folder_ / "mesh.obj"), "new");
  EXPECT_EQ(contents(folder_ / "mesh.mtl"), "new");
  EXPECT_EQ(filesThere(), 2);
}

TEST_F(OutputFileTest, OfAGroupGetTheirOlderContentBackWhenOneCannotBeNamed) {
  put(folder_ / "a.png", "old");
  put(folder_ / "c.png", "old");
  {
    OutputGroup together;
    for (const char* name : {"a.png", "b.png", "c.png", "last.obj"}) {
      Result<OutputFile> file = OutputFile::create(folder_ / name);
      ASSERT_TRUE(file);
      put(file->temporaryPath(), "new");
      ASSERT_TRUE(file->commit());
    }
    fs::create_directory(folder_ / "last.obj");  // nothing can be renamed to a folder
    const Status named = together.commit();
    ASSERT_FALSE(named);
    EXPECT_EQ(named.error().culprit, (folder_ / "last.obj").string());
  }
  EXPECT_EQ(contents(folder_ / "a.png"), "old");
  EXPECT_EQ(contents(folder_ / "c.png"), "old");
  EXPECT_FALSE(fs::exists(folder_ / "b.png"));
  EXPECT_EQ(filesThere(), 3) << "no temporary file is left";
}

TEST_F(OutputFileTest, AnInnerGroupHandsItsFilesToTheOuterAndTheLaterOfANameCounts) {
  {
    OutputGroup outer;
    for (const char* text : {"first", "second"}) {
      OutputGroup inner;
      Result<FileWriter> writer = FileWriter::create(folder_ / "t.ply");
      ASSERT_TRUE(writer);
      writer->write(text);
      ASSERT_TRUE(writer->finish());
      ASSERT_TRUE(inner.commit());
      EXPECT_FALSE(fs::exists(folder_ / "t.ply"));
    }
    ASSERT_TRUE(outer.commit());
  }
  EXPECT_EQ(contents(folder_ / "t.ply"), "second");
  EXPECT_EQ(filesThere(), 1);
}

TEST_F(OutputFileTest, SideFilesOfTheOlderFileGoWithItAndNotBefore) {
  const fs::path path = folder_ / "dem.tif";
  put(path, "old");
  put(folder_ / "dem.tif.ovr", "overviews");
  for (const bool commits : {false, true}) {
    OutputGroup together;
    Result<OutputFile> file = OutputFile::create(path);
    ASSERT_TRUE(file);
    file->removeBeside({".ovr"});
    put(file->temporaryPath(), "new");
    ASSERT_TRUE(file->commit());
    if (commits) {
      ASSERT_TRUE(together.commit());
    }
    EXPECT_EQ(fs::exists(folder_ / "dem.tif.ovr"), !commits);
  }
}

TEST_F(OutputFileTest, WhatCannotBeReadBackDoesNotReplaceAnOlderFile) {
  const fs::path path = folder_ / "t.csv";
  put(path, "old");
  Result<FileWriter> writer = FileWriter::create(path);
  ASSERT_TRUE(writer);
  writer->write(std::string(3 * FileWriter::kCapacity, 'x'));
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_))
    if (entry.path().filename().string().front() == '.')
      std::fstream(entry.path(), std::ios::in | std::ios::out | std::ios::binary).seekp(7).put('y');
  const Status finished = writer->finish();
  ASSERT_FALSE(finished);
  EXPECT_NE(finished.error().message.find("cannot be read after it was written"), std::string::npos);
  EXPECT_EQ(contents(path), "old");
}

}  // namespace
}  // namespace arete

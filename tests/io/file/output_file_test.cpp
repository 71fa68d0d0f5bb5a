// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/file/output_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "io/file/file_writer.h"

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

}  // namespace
}  // namespace arete

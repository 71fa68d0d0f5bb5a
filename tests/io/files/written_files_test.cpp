// SPDX-License-Identifier: GPL-3.0-or-later
// The list lasts for the rest of a process, so each test makes one of its own.
#include "io/files/written_files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "io/files/file_writer.h"
#include "io/files/output_file.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

class WrittenFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("arete-written-" + std::to_string(::getpid()) + "-" +
                                           ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
    listWrittenFiles();
    before_ = writtenFiles().size();
  }
  void TearDown() override { fs::remove_all(folder_); }

  /// An absolute name stays.
  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    auto file = FileWriter::create(at(name));
    ASSERT_TRUE(file);
    file->write(text);
    ASSERT_TRUE(file->finish());
  }
  /// Those of this test.
  std::vector<WrittenFile> files() const {
    const auto all = writtenFiles();
    return {all.begin() + static_cast<std::ptrdiff_t>(before_), all.end()};
  }

  fs::path folder_;
  std::size_t before_ = 0;
};

TEST_F(WrittenFiles, AreListedWithTheirSizesAndThoseOfWhatTheyReplace) {
  std::ofstream(at("old.txt")) << "older text";
  write("new.txt", "abc");
  write("old.txt", "defgh");
  const auto listed = files();
  ASSERT_EQ(listed.size(), 2u);
  EXPECT_EQ(listed[0].path, at("new.txt"));
  EXPECT_EQ(listed[0].bytes, 3u);
  EXPECT_FALSE(listed[0].olderBytes);
  EXPECT_EQ(listed[1].bytes, 5u);
  EXPECT_EQ(listed[1].olderBytes, 10u);
  write("new.txt", "abcdef");
  ASSERT_EQ(files().size(), 2u) << "a file that this process replaces is its own";
  EXPECT_EQ(files()[0].bytes, 6u);
  EXPECT_FALSE(files()[0].olderBytes);
}

TEST_F(WrittenFiles, AreThoseThatGotTheirNames) {
  {
    const auto dropped = OutputFile::create(at("dropped.txt"));
    ASSERT_TRUE(dropped);
    std::ofstream(dropped->temporaryPath()) << "text";
  }
  EXPECT_TRUE(files().empty());
  {
    const OutputGroup group;
    write("held.txt", "text");
  }
  EXPECT_TRUE(files().empty());
  write("/dev/null", "text");
  EXPECT_TRUE(files().empty()) << "is no file that anybody looks for";
}

TEST_F(WrittenFiles, AreNamedAsTheyWereStatedThroughALink) {
  std::ofstream(at("target.txt")) << "12345678";
  fs::create_symlink("target.txt", at("link.txt"));
  write("link.txt", "abc");
  ASSERT_EQ(files().size(), 1u);
  EXPECT_EQ(files()[0].path, at("link.txt"));
  EXPECT_EQ(files()[0].olderBytes, 8u);
}

TEST_F(WrittenFiles, IncludeTheSideFileOfGdal) {
  auto file = OutputFile::create(at("dem.tif"));
  ASSERT_TRUE(file);
  std::ofstream(file->temporaryPath()) << "tif";
  std::ofstream(file->temporaryPath().string() + ".aux.xml") << "xml!";
  ASSERT_TRUE(file->commit());
  ASSERT_EQ(files().size(), 2u);
  EXPECT_EQ(files()[1].path, at("dem.tif.aux.xml"));
  EXPECT_EQ(files()[1].bytes, 4u);
}

}  // namespace
}  // namespace arete

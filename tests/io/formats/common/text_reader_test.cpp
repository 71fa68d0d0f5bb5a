// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/common/text_reader.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <vector>

#include "io/io_fixture.h"
#include "sentences_of.h"

namespace arete {
namespace {

/// Keeps the lines; one with '#' is a comment, one with '!' is left out, "bad" is an error.
class LineKeeper final : public MeshTextReader {
 public:
  using MeshTextReader::MeshTextReader;
  std::vector<std::string> lines;
  bool isFinished = false;

 private:
  Status readLine() override {
    const char* begin = at();
    at() = lineEnd();
    const std::string line(begin, at());
    if (line == "bad") return corrupt(begin, "is bad");
    if (line.starts_with('!')) leaveOut(std::string_view(line).substr(1));
    if (line.starts_with('#')) takeComment(std::string_view(line).substr(1));
    lines.push_back(line);
    return {};
  }
  Status finish() override {
    isFinished = true;
    warnOfLeftOut("lines");
    return {};
  }
};

class MeshTextReaderTest : public ::testing::Test {
 protected:
  Result<MeshFile> read(const std::string& text, const RunContext& context = {}) {
    const auto bytes = FileBytes::readText(folder_.write("a.txt", text));
    EXPECT_TRUE(bytes);
    LineKeeper keeper(*bytes, "a.txt", context);
    Result<MeshFile> file = keeper.read();
    lines_ = keeper.lines;
    EXPECT_EQ(keeper.isFinished, file.has_value());
    return file;
  }
  test::TemporaryFolder folder_;
  std::vector<std::string> lines_;
};

TEST_F(MeshTextReaderTest, HandsOutEveryLineWithoutAByteOrderMark) {
  using Lines = std::vector<std::string>;
  EXPECT_TRUE(
      read("\xEF\xBB\xBF"
           "a\n\nb"));
  EXPECT_EQ(lines_, (Lines{"a", "", "b"}));
  EXPECT_TRUE(read("a\nb\n"));
  EXPECT_EQ(lines_, (Lines{"a", "b"}));
  EXPECT_TRUE(read(""));
  EXPECT_TRUE(lines_.empty());
}

TEST_F(MeshTextReaderTest, TakesCrsAndUnitFromComments) {
  const auto file = read("# crs PROJCRS[\"a b\"] \r\n#vertical_unit ft\n# crs\n# other\n");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->crsWkt, "PROJCRS[\"a b\"]");
  EXPECT_EQ(file->verticalUnit, "ft");
}

TEST_F(MeshTextReaderTest, MissesTheEndOfItsOwnFilesOnly) {
  EXPECT_TRUE(read("# generator arete\n# end\n"));
  EXPECT_TRUE(read("# generator other\n"));
  const auto cut = read("# generator arete\n# en");
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.error().code, ErrorCode::corrupt);
  EXPECT_NE(cut.error().message.find("truncated"), std::string::npos);
}

TEST_F(MeshTextReaderTest, NamesTheLineOfAnErrorAndStopsThere) {
  const auto file = read("a\nb\nbad\nc\n");
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().message, "line 3 is bad");
  EXPECT_EQ(file.error().culprit, "a.txt");
  EXPECT_EQ(lines_.size(), 2u);
}

TEST_F(MeshTextReaderTest, CountsWhatIsLeftOutUpToEightWords) {
  EXPECT_TRUE(read("a\n")->warnings.empty());
  EXPECT_EQ(test::sentencesOf(read("!b\n!a\n!b\n")->warnings),
            std::vector<std::string>{"its lines \"a\" (1), \"b\" (2) are left out"});
  std::string many;
  for (char c = 'a'; c <= 'l'; ++c) many += std::string("!") + c + "\n";
  const auto file = read(many + many);
  ASSERT_EQ(file->warnings.size(), 1u);
  EXPECT_TRUE(file->warnings[0].sentence.ends_with("\"h\" (2) and 8 more are left out"))
      << file->warnings[0].sentence;
}

TEST_F(MeshTextReaderTest, StopsWhenCancelled) {
  const std::atomic<bool> stop = true;
  RunContext context;
  context.cancel = &stop;
  const auto file = read("a\n", context);
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace arete

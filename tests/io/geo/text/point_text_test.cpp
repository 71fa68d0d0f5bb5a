// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/text/point_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "io/io_fixture.h"

namespace arete {
namespace {

using test::contains;
using test::joined;
using test::TemporaryFolder;

struct Read {
  PointRows rows;
  PointAttributes attributes;
  Warnings warnings;
  Error error;
};

class PointTextFile : public ::testing::Test {
 protected:
  Read read(const std::string& text, PointTextColumns columns = PointTextColumns::plan,
            const std::string& zColumn = {}) const {
    Read result;
    auto rows = readPointText(folder_.write("a.csv", text), zColumn, result.warnings, {}, columns,
                              &result.attributes);
    if (rows)
      result.rows = std::move(*rows);
    else
      result.error = rows.error();
    return result;
  }
  TemporaryFolder folder_;
};

TEST_F(PointTextFile, MayHaveLineBreaksAndSeparatorsInQuotes) {
  for (const std::string end : {"\n", "\r\n"}) {
    const Read read = this->read("hut,x,y" + end + "\"The\nold, \"\"red\"\" # hut\"  ,1,2" + end + "b,3,4" +
                                 end + "\"\n\n\",5,6" + end + "c,7,8");
    ASSERT_EQ(read.rows.positions.size(), 4u) << read.error.describe();
    EXPECT_EQ(read.rows.positions[0], (Vec2{1, 2}));
    EXPECT_EQ(read.rows.positions[3], (Vec2{7, 8}));
    EXPECT_EQ(read.attributes.at(0, 0), "The\nold, \"red\" # hut");
    EXPECT_EQ(read.attributes.at(1, 0), "b");
    // A row is named by the first line of its record.
    EXPECT_EQ(read.rows.origins, (std::vector<std::uint64_t>{2, 4, 5, 8}));
  }
}

TEST_F(PointTextFile, MayHaveALineBreakInTheNameOfAColumn) {
  const Read read = this->read("\"a\nb\",x,y\n1,2,3\n");
  ASSERT_EQ(read.rows.positions.size(), 1u) << read.error.describe();
  EXPECT_EQ(read.attributes.columns[0].name, "a\nb");
}

TEST_F(PointTextFile, DoesNotLetAStrayQuoteJoinLines) {
  // Not at the start of a field: a quote is a character, as an inch is.
  const Read inches = read("x,y,pipe\n1,2,5\" wide\n3,4,6\" wide\n");
  EXPECT_EQ(inches.rows.positions.size(), 2u) << inches.error.describe();
  // At the start of a field, and closed by the quote of another line.
  const Read joined = read("x,y,pipe\n1,2,\"wide\n3,4,\"narrow\n5,6,z\n");
  EXPECT_EQ(joined.error.code, ErrorCode::invalidData);
  EXPECT_TRUE(contains(joined.error.culprit, "a.csv:2")) << joined.error.describe();
  const Read open = read("x,y,pipe\n1,2,\"wide\n3,4,z\n5,6,z\n");
  EXPECT_EQ(open.error.code, ErrorCode::invalidData);
  EXPECT_TRUE(contains(open.error.culprit, "a.csv:2")) << open.error.describe();
  EXPECT_TRUE(contains(open.error.message, "does not end")) << open.error.describe();
  // A comment, and fields between spaces, have no quotes.
  EXPECT_EQ(read("# \"sites\nx,y # \"gone\n1,2\n").rows.positions.size(), 1u);
  EXPECT_EQ(read("1 2 \"a\n3 4 b\n").rows.positions.size(), 2u);
}

TEST_F(PointTextFile, NamesTheLineOfAnErrorBehindARecordOfSeveralLines) {
  const Read read = this->read("n,x,y\n\"a\nb\nc\",1,2\nd,e,4\n");
  EXPECT_EQ(read.error.code, ErrorCode::invalidData);
  EXPECT_TRUE(contains(read.error.culprit, "a.csv:5")) << read.error.describe();
}

TEST_F(PointTextFile, KeepsEveryDoubleToTheBit) {
  std::mt19937_64 random(7);
  std::vector<Vec2> positions;
  std::string text = "x,y,note\n";
  while (positions.size() < 20000) {
    const Vec2 p{std::bit_cast<double>(random()), double(random()) / 3};
    if (!std::isfinite(p.x)) continue;
    positions.push_back({p.x + 0.0, p.y + 0.0});
    text += fmt::format("{},{},\"{}\"\n", p.x, p.y, positions.size() % 5 == 0 ? "two\nlines" : "one");
  }
  const Read read = this->read(text);
  EXPECT_EQ(read.rows.positions, positions) << read.error.describe();
}

TEST_F(PointTextFile, ReadsRecordsAcrossChunks) {
  // The reader takes 4 MiB at a time; records of many lengths lie over the seams.
  std::mt19937 random(3);
  std::string text = "x,y,note\n";
  std::size_t rows = 0, lines = 1;
  std::vector<std::uint64_t> origins;
  while (text.size() < 9'000'000) {
    origins.push_back(lines + 1);
    const std::size_t breaks = random() % 4;
    text += fmt::format("{},{},\"", rows, -double(rows));
    for (std::size_t b = 0; b < breaks; ++b) text += std::string(random() % 40, 'n') + "\n";
    text += "\"\n";
    lines += breaks + 1;
    ++rows;
  }
  const Read read = this->read(text);
  ASSERT_EQ(read.rows.positions.size(), rows) << read.error.describe();
  EXPECT_EQ(read.rows.positions.back(), (Vec2{double(rows - 1), -double(rows - 1)}));
  EXPECT_EQ(read.rows.origins, origins);
}

TEST_F(PointTextFile, RefusesARecordThatIsTooLong) {
  const Read read = this->read("x,y,note\n1,2,\"" + std::string(3'000'000, '\n'));
  EXPECT_EQ(read.error.code, ErrorCode::invalidData);
}

TEST_F(PointTextFile, NeedsAHeightOnlyWhereItIsSpatial) {
  const std::string text = "x,y,q\n1,2,3\n";
  EXPECT_EQ(read(text).rows.positions.size(), 1u);
  const Read spatial = read(text, PointTextColumns::spatial);
  EXPECT_EQ(spatial.error.code, ErrorCode::invalidData);
  EXPECT_TRUE(contains(spatial.error.message, "`zField`")) << spatial.error.describe();
  EXPECT_EQ(read(text, PointTextColumns::spatial, "Q").rows.heights, (std::vector<double>{3}));
  EXPECT_EQ(read(text, PointTextColumns::spatial, "r").error.code, ErrorCode::usage);
}

TEST_F(PointTextFile, IsRecognizedByItsNameOrItsFirstNumbers) {
  EXPECT_TRUE(looksLikePointText("nowhere.CSV"));
  EXPECT_TRUE(looksLikePointText(folder_.write("a.dat", "# comment\n\n 1 2 3\n")));
  for (const char* text :
       {"x,y,z\n", "id;Lon;Lat;elev\n", "easting northing\n", "P1 1 2 3\n", "1;2,5;3\n", "1 2 nan\n",
        "\xEF\xBB\xBF"
        "1\t2\t3\n",
        "X|Y|H\r1|2|3\r"})
    EXPECT_TRUE(looksLikePointText(folder_.write("a.dat", text))) << text;
  for (const char* text :
       {"ncols 10\n", "{\"type\": \"Feature\"}\n", "<x y=\"1\">\n", "x marks the spot\n", "", "1\n"})
    EXPECT_FALSE(looksLikePointText(folder_.write("b.dat", text))) << text;
  EXPECT_TRUE(looksLikePointText(folder_.write("a.dat", std::string("\xFF\xFE"
                                                                    "1\0,\0"
                                                                    "2\0,\0"
                                                                    "3\0\n\0",
                                                                    14))));
  EXPECT_FALSE(looksLikePointText(folder_.write("b.dat", "1 2\n")));
  EXPECT_FALSE(looksLikePointText(folder_.write("c.dat", std::string("1 2 3\0", 6))));
  EXPECT_FALSE(looksLikePointText(folder_.file("no.dat")));
}

}  // namespace
}  // namespace arete

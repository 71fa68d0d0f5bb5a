// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/table/line_table.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <fstream>
#include <iterator>

#include "io/geo/crs/reader.h"
#include "io/geo/table/sight_pairs.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

Georeference utmOfLines() {
  Georeference georeference;
  EXPECT_TRUE(describeCrs(*crsFromText("EPSG:32632"), georeference));
  return georeference;
}

std::string linesOf(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(LineTable, ComesBackAsPairs) {
  const test::TemporaryFolder folder_;
  PointAttributes inputs, results;
  inputs.columns = {{"verdict", PointAttributes::Kind::text}, {"n", PointAttributes::Kind::integer}};
  results.columns = {{"verdict", PointAttributes::Kind::text}, {"clearance", PointAttributes::Kind::real}};
  for (const char* value : {"mine, \"too\"", "7", "", "8"}) inputs.add(value);
  for (const char* value : {"visible", "1.5", "", ""}) results.add(value);
  const std::vector<std::array<Vec2, 2>> ends = {{Vec2{1, 2}, Vec2{3, 4}}, {Vec2{NAN, NAN}, Vec2{3, 4}}};
  const LineTable table{"sight", utmOfLines().crsWkt, ends, &inputs, &results};
  std::string csv;
  forCsvLines(table, [&](std::string_view line) { csv += line; });
  EXPECT_EQ(csv, "verdict_in,n,verdict,clearance\n\"mine, \"\"too\"\"\",7,visible,1.5\n,8,,\n");
  const std::string path = folder_.file("lines.gpkg");
  ASSERT_TRUE(writeLineTable(path, table));
  const auto pairs = readSightPairs(path, utmOfLines());
  ASSERT_TRUE(pairs) << pairs.error().describe();
  ASSERT_EQ(pairs->rows.size(), 2u);
  EXPECT_EQ(pairs->rows[0][1].xy, (Vec2{3, 4}));
  EXPECT_TRUE(std::isnan(pairs->rows[1][0].xy.x));
  EXPECT_EQ(pairs->attributes.at(0, 1), "mine, \"too\"");
  EXPECT_EQ(writeLineTable(folder_.file("lines.txt"), table).error().code, ErrorCode::usage);
}

TEST(LineTable, IsTheSameBytesEveryTimeAndLeavesNothingWhenStopped) {
  const test::TemporaryFolder folder;
  PointAttributes inputs, results;
  inputs.columns = {{"name", PointAttributes::Kind::text}};
  inputs.add("a");
  results.columns = {{"n", PointAttributes::Kind::integer}};
  results.add("7");
  const std::vector<std::array<Vec2, 2>> ends = {{Vec2{1, 2}, Vec2{3, 4}}};
  const LineTable table{"lines", "", ends, &inputs, &results};
  for (const char* name : {"a.csv", "a.gpkg"}) {
    const std::string path = folder.file(name);
    ASSERT_TRUE(writeLineTable(path, table)) << name;
    const std::string first = linesOf(path);
    ASSERT_TRUE(writeLineTable(path, table)) << name;
    EXPECT_TRUE(linesOf(path) == first) << name;
  }
  EXPECT_EQ(linesOf(folder.file("a.csv")), "name,n\na,7\n");
  const std::atomic<bool> stop = true;
  RunContext context;
  context.cancel = &stop;
  const auto stopped = writeLineTable(folder.file("b.gpkg"), table, context);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::interrupted);
  EXPECT_EQ(stopped.error().culprit, folder.file("b.gpkg"));
  EXPECT_EQ(writeLineTable(folder.file("no/a.csv"), table).error().code, ErrorCode::notFound);
  EXPECT_EQ(folder.count(), 2u);
}

}  // namespace
}  // namespace arete

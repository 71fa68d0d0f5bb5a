// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/table/plan_point_reader.h"

#include <gtest/gtest.h>

#include <atomic>

#include "io/io_fixture.h"
#include "io/vector_fixture.h"

namespace arete {
namespace {

using test::TemporaryFolder;
using test::writeVector;

TEST(PlanPointReader, ReadsTextWithAndWithoutHeights) {
  const TemporaryFolder folder;
  for (const char* text : {"x,y\n1,2\n3,4\n", "1 2\n3 4\n", "1 2 9\n3 4 9\n", "# two\nlat;lon\n2;1\n4;3\n"}) {
    const auto points = readPlanPoints(folder.write("a.csv", text), "EPSG:32611");
    ASSERT_TRUE(points) << text << points.error().describe();
    EXPECT_EQ(points->positions, (std::vector<Vec2>{{1, 2}, {3, 4}})) << text;
  }
}

TEST(PlanPointReader, TransformsALayerAndTakesEveryPointOfIt) {
  const TemporaryFolder folder;
  const std::string path = writeVector(
      folder.file("a.gpkg"), "GPKG",
      {{"a", wkbUnknown, {{"POINT (-117 34)", 0}, {"MULTIPOINT (-116 34, -118 34)", 0}, {nullptr, 0}}}},
      "OGC:CRS84");
  const auto points = readPlanPoints(path, "EPSG:32611");
  ASSERT_TRUE(points) << points.error().describe();
  ASSERT_EQ(points->positions.size(), 3u);
  EXPECT_NEAR(points->positions[0].x, 500000, 1e-6);
  EXPECT_NEAR(points->positions[1].x + points->positions[2].x, 1e6, 1e-5)
      << "symmetric to the central meridian";
}

TEST(PlanPointReader, TakesALayerWithoutACrsAsTheDemsAndWarns) {
  const TemporaryFolder folder;
  const std::string path =
      writeVector(folder.file("a.shp"), "ESRI Shapefile", {{"a", wkbPoint, {{"POINT (1 2)", 0}}}}, nullptr);
  const auto points = readPlanPoints(path, "EPSG:32611");
  ASSERT_TRUE(points) << points.error().describe();
  EXPECT_EQ(points->positions, (std::vector<Vec2>{{1, 2}}));
  EXPECT_EQ(points->warnings.size(), 1u);
}

TEST(PlanPointReader, SaysWhatItCannotRead) {
  const TemporaryFolder folder;
  const auto codeOf = [](const std::string& path, const std::string& crs, const RunContext& context = {}) {
    const auto points = readPlanPoints(path, crs, context);
    if (points) return ErrorCode::brokenPromise;
    EXPECT_EQ(points.error().culprit.substr(0, path.size()), path);
    return points.error().code;
  };
  const std::string layer =
      writeVector(folder.file("a.gpkg"), "GPKG", {{"a", wkbPoint, {{"POINT (-117 34)", 0}}}}, "OGC:CRS84");
  EXPECT_EQ(codeOf(layer, ""), ErrorCode::invalidData) << "the target has no CRS";
  const std::string lines =
      writeVector(folder.file("l.gpkg"), "GPKG", {{"a", wkbUnknown, {{"LINESTRING (1 2, 3 4)", 0}}}});
  EXPECT_EQ(codeOf(lines, "EPSG:32611"), ErrorCode::unsupported);
  EXPECT_EQ(codeOf(folder.file("no.csv"), ""), ErrorCode::notFound);
  EXPECT_EQ(codeOf(folder.write("e.csv", "x,y\n"), ""), ErrorCode::invalidData) << "no point";
  EXPECT_EQ(codeOf(folder.write("n.csv", "x,y\n1,nan\n"), ""), ErrorCode::invalidData);
  const std::string pole =
      writeVector(folder.file("p.gpkg"), "GPKG", {{"a", wkbPoint, {{"POINT (0 95)", 0}}}}, "OGC:CRS84");
  EXPECT_EQ(codeOf(pole, "EPSG:32611"), ErrorCode::invalidData) << "no such latitude";
  const std::atomic<bool> stop = true;
  RunContext context;
  context.cancel = &stop;
  EXPECT_EQ(codeOf(layer, "EPSG:32611", context), ErrorCode::interrupted);
}

}  // namespace
}  // namespace arete

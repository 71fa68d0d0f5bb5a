// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/dem/seam_column.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/geo/dem/dem_reader.h"
#include "io/geo/dem/raster_writer.h"
#include "io/io_fixture.h"
#include "terrain/builder/build.h"
#include "terrain/measure/measure.h"

namespace arete {
namespace {

using test::RasterSpec;
using test::TemporaryFolder;

RasterSpec world(double west, double step, int columns = 0) {
  RasterSpec spec;
  spec.columns = columns > 0 ? columns : int(std::round(360 / step));
  spec.rows = 5;
  spec.values.clear();
  for (int i = 0; i < spec.columns * spec.rows; ++i) spec.values.push_back(i * 37 % 101);
  spec.crs = "EPSG:4326";
  spec.geoTransform = {west, step, 0, 10, 0, -1};
  return spec;
}

RasterHeightfield readWorld(const TemporaryFolder& folder, const RasterSpec& spec) {
  auto read = readDem(test::writeRaster(folder.file("dem.tif"), spec));
  EXPECT_TRUE(read) << read.error().describe();
  return std::get<RasterHeightfield>(read->heightfield);
}

TEST(SeamColumn, IsTheFirstColumnOnceMore) {
  const TemporaryFolder folder;
  for (const RasterSpec& spec :
       {world(-180, 10), world(0, 10), world(-180.5, 1), world(-180, 0.333333, 1080)}) {
    const RasterHeightfield field = readWorld(folder, spec);
    ASSERT_EQ(field.columns, std::uint32_t(spec.columns + 1));
    EXPECT_TRUE(field.georeference.repeatsFirstColumn);
    EXPECT_TRUE(field.validate());
    EXPECT_EQ(field.sourceChecksum, heightsChecksum(field));
    for (std::uint32_t row = 0; row < field.rows; ++row) {
      for (std::uint32_t column = 0; column + 1 < field.columns; ++column)
        ASSERT_EQ(field.at(column, row), spec.values[row * std::uint32_t(spec.columns) + column]);
      EXPECT_EQ(field.at(field.columns - 1, row), field.at(0, row));
    }
  }
}

TEST(SeamColumn, IsNotMadeWhereTheRasterDoesNotGoRound) {
  const TemporaryFolder folder;
  RasterSpec map = world(0, 10);
  map.crs = "EPSG:32611";
  RasterSpec turned = world(0, 10);
  turned.geoTransform = {0, 10, 0.1, 10, 0, -1};
  for (const RasterSpec& spec : {world(-180, 10, 35), world(-185, 10, 37), world(0, 5, 36), map, turned})
    EXPECT_EQ(readWorld(folder, spec).columns, std::uint32_t(spec.columns));
}

TEST(SeamColumn, IsCountedOnceAndWrittenNever) {
  const TemporaryFolder folder;
  const RasterSpec spec = world(-180, 10);
  const RasterHeightfield field = readWorld(folder, spec);
  const auto model = build(field);
  ASSERT_TRUE(model) << model.error().describe();
  EXPECT_TRUE(model->rasterSamples().georeference.repeatsFirstColumn);
  TriangleMesh mesh;
  for (std::uint32_t row = 0; row < field.rows; ++row)
    for (std::uint32_t column = 0; column < field.columns; ++column) {
      const Vec2 p = field.georeference.toSource(column, row);
      mesh.positions.push_back({p.x, p.y, field.at(column, row) + (column + 1 == field.columns ? 3 : 1)});
    }
  for (std::uint32_t row = 0; row + 1 < field.rows; ++row)
    for (std::uint32_t column = 0; column + 1 < field.columns; ++column) {
      const std::uint32_t a = field.index(column, row), b = field.index(column, row + 1);
      mesh.triangles.push_back({a, b, a + 1});
      mesh.triangles.push_back({b, b + 1, a + 1});
    }
  const auto report = measure(mesh, field);
  ASSERT_TRUE(report) << report.error().describe();
  EXPECT_EQ(report->samples, 36u * 5);
  EXPECT_EQ(report->covered, 36u * 5);
  EXPECT_EQ(report->valid, 36u * 5);
  EXPECT_EQ(report->domainAreaPixels, 36.0 * 4) << "the cell at the seam is terrain";
  EXPECT_EQ(report->meanError, 1);
  EXPECT_EQ(report->maxAbsError, 3) << "the repeated samples are compared as well";

  ASSERT_TRUE(
      writeGeoTiff(folder.file("again.tif"), field.columns, field.rows, field.heights, field.georeference));
  const auto again = readRaster(folder.file("again.tif"));
  ASSERT_TRUE(again) << again.error().describe();
  EXPECT_EQ(again->heightfield.columns, 36u);
  for (std::size_t i = 0; i < spec.values.size(); ++i)
    ASSERT_EQ(again->heightfield.heights[i], spec.values[i]);
}

}  // namespace
}  // namespace arete

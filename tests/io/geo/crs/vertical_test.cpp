// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every vertical CRS of EPSG's most used ones, by the direction of its axis as PROJ has it.
#include "io/geo/crs/vertical.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "io/geo/crs/reader.h"
#include "io/geo/dem/dem_reader.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

using test::contains;
using test::joined;
using test::RasterSpec;
using test::TemporaryFolder;

struct Case {
  int code;
  bool isDown;
  double metres;
};

// EPSG's register: name, direction and unit of the axis.
constexpr Case kCases[] = {
    {5703, false, 1},                // NAVD88 height
    {5714, false, 1},                // MSL height
    {3855, false, 1},                // EGM2008 height
    {5773, false, 1},                // EGM96 height
    {5702, false, 1200.0 / 3937.0},  // NGVD29 height (ftUS)
    {6360, false, 1200.0 / 3937.0},  // NAVD88 height (ftUS)
    {8228, false, 0.3048},           // NAVD88 height (ft)
    {5715, true, 1},                 // MSL depth
    {5612, true, 1},                 // Baltic 1977 depth
    {5706, true, 1},                 // Caspian depth
    {6357, true, 1},                 // NAVD88 depth
    {6358, true, 1200.0 / 3937.0},   // NAVD88 depth (ftUS)
    {6359, true, 1200.0 / 3937.0},   // NGVD29 depth (ftUS)
    {5831, true, 1},                 // Instantaneous Water Level depth
    {5861, true, 1},                 // LAT depth
    {5862, true, 1},                 // LLWLT depth
    {5866, true, 1},                 // MLLW depth
    {5867, true, 1},                 // MLW depth
    {5873, true, 1},                 // Low Water depth
    {5336, true, 1},                 // Black Sea depth
    {5865, true, 1},                 // ISLW depth
};

/// What PROJ's database says, read from the text of the CRS itself.
bool saysDown(const OGRSpatialReference& crs) {
  return wktOf(crs).find(",down") != std::string::npos;
}

TEST(VerticalCrs, ThatPointsDownIsNegated) {
  TemporaryFolder folder;
  int down = 0;
  for (const Case& one : kCases) {
    SCOPED_TRACE(one.code);
    const std::string name = fmt::format("EPSG:32633+{}", one.code);
    const auto crs = crsFromText(name);
    if (!crs) continue;  // not in this PROJ's database
    ASSERT_EQ(saysDown(*crs), one.isDown);
    EXPECT_EQ(pointsDown(*crs), one.isDown);
    down += one.isDown ? 1 : 0;

    RasterSpec spec;
    spec.crs = name;
    spec.values = {0, 10, 20, 30, 40, -9999};
    spec.adjust = [](GDALDataset& d) { d.GetRasterBand(1)->SetNoDataValue(-9999); };
    const std::string raster = writeRaster(folder.file("a.tif"), spec);
    const std::string points = folder.write("a.csv", "1,2,10\n4,5.5,20\n7.7,8,30\n0,1,0\n");
    for (const bool isRaster : {true, false}) {
      SourceReading reading;
      if (!isRaster) reading.crs = name;
      const auto read = readDem(isRaster ? raster : points, reading);
      ASSERT_TRUE(read) << read.error().describe();
      std::visit(
          [&](const auto& field) {
            EXPECT_EQ(field.heights[isRaster ? 1 : 0], one.isDown ? -10 : 10);
            EXPECT_FALSE(std::signbit(field.heights[isRaster ? 0 : 3])) << "-0";
            EXPECT_EQ(contains(joined(read->warnings), "depths are negated"), one.isDown)
                << joined(read->warnings);
            EXPECT_EQ(contains(field.georeference.crsWkt, "VERTCRS"), !one.isDown);
            EXPECT_FALSE(contains(field.georeference.verticalDatum, "depth"))
                << field.georeference.verticalDatum;
            EXPECT_NEAR(field.georeference.verticalUnitMetres, one.metres, 1e-12);
          },
          read->heightfield);
    }
    // A person knows better.
    for (const bool isDepth : {true, false}) {
      SourceReading reading;
      reading.isDepth = isDepth;
      const auto read = readDem(raster, reading);
      ASSERT_TRUE(read);
      const auto& field = std::get<RasterHeightfield>(read->heightfield);
      EXPECT_EQ(field.heights[1], isDepth ? -10 : 10);
      EXPECT_TRUE(std::isnan(field.heights[5])) << "NODATA is a raw value";
      EXPECT_FALSE(contains(joined(read->warnings), "negated")) << joined(read->warnings);
    }
  }
  EXPECT_GE(down, 10);
}

TEST(VerticalCrs, NegatesScaleAndOffsetToo) {
  TemporaryFolder folder;
  RasterSpec spec;
  spec.crs = "EPSG:32633+5715";
  spec.adjust = [](GDALDataset& d) {
    d.GetRasterBand(1)->SetScale(0.5);
    d.GetRasterBand(1)->SetOffset(100);
  };
  const auto read = readDem(writeRaster(folder.file("a.tif"), spec));
  ASSERT_TRUE(read);
  const auto& field = std::get<RasterHeightfield>(read->heightfield);
  EXPECT_EQ(field.heights[0], -100.5);
  EXPECT_EQ(field.heights[0], 1 * field.rawScale + field.rawOffset);
}

TEST(VerticalCrs, IsNotTheOnlyThingThatSaysDown) {
  TemporaryFolder folder;
  for (const auto& [item, value, isDepth] : {std::tuple{"positive", "down", true},
                                             {"positive", "up", false},
                                             {"standard_name", "sea_floor_depth_below_geoid", true},
                                             {"standard_name", "depth", true},
                                             {"standard_name", "surface_altitude", false}}) {
    RasterSpec spec;
    spec.adjust = [item = item, value = value](GDALDataset& d) {
      d.GetRasterBand(1)->SetMetadataItem(item, value);
    };
    const auto read = readDem(writeRaster(folder.file("a.tif"), spec));
    ASSERT_TRUE(read);
    EXPECT_EQ(std::get<RasterHeightfield>(read->heightfield).heights[1], isDepth ? -2 : 2)
        << item << " " << value;
    EXPECT_EQ(contains(joined(read->warnings), "negated"), isDepth);
  }
}

TEST(VerticalUnit, IsAskedForWhereTheCrsCountsInFeetAndNothingStatesIt) {
  TemporaryFolder folder;
  struct Unit {
    const char* crs;
    const char* ofBand;
    const char* stated;
    bool isWarned;
    double metres;
  };
  constexpr double kSurvey = 1200.0 / 3937.0;
  for (const Unit& unit : {Unit{"EPSG:2263", "", "", true, 1},
                           {"EPSG:2225", "", "", true, 1},
                           {"EPSG:2222", "", "", true, 1},    // Arizona, international feet
                           {"EPSG:2136", "", "", true, 1},    // Ghana, Gold Coast feet
                           {"EPSG:27200", "", "", false, 1},  // New Zealand, metres
                           {"EPSG:4326", "", "", false, 1},
                           {"", "", "", false, 1},
                           {"EPSG:2263", "m", "", false, 1},
                           {"EPSG:2263", "US survey foot", "", false, kSurvey},
                           {"EPSG:2263+6360", "", "", false, kSurvey},
                           {"EPSG:2263+5703", "", "", false, 1},
                           {"EPSG:2263", "", "us-ft", false, kSurvey},
                           {"EPSG:2263", "", "ft", false, 0.3048},
                           {"EPSG:2263", "", "m", false, 1},
                           {"EPSG:4326", "", "ft", false, 0.3048},
                           {"EPSG:32611", "m", "ft", false, 0.3048}}) {
    SCOPED_TRACE(std::string(unit.crs) + " " + unit.ofBand + " " + unit.stated);
    RasterSpec spec;
    spec.crs = unit.crs;
    if (*unit.ofBand) spec.adjust = [&](GDALDataset& d) { d.GetRasterBand(1)->SetUnitType(unit.ofBand); };
    SourceReading reading;
    reading.verticalUnit = unit.stated;
    const auto read = readDem(writeRaster(folder.file("a.tif"), spec), reading);
    ASSERT_TRUE(read) << read.error().describe();
    EXPECT_EQ(contains(joined(read->warnings), "`verticalUnit`"), unit.isWarned) << joined(read->warnings);
    EXPECT_NEAR(std::get<RasterHeightfield>(read->heightfield).georeference.verticalUnitMetres, unit.metres,
                1e-12);
    EXPECT_EQ(contains(joined(read->warnings), "is replaced by the one stated"),
              *unit.ofBand && *unit.stated);
  }
  SourceReading reading;
  reading.crs = "EPSG:2263";
  const auto points = readDem(folder.write("a.csv", "1,2,10\n4,5.5,20\n7.7,8,30\n0,1,0\n"), reading);
  ASSERT_TRUE(points);
  EXPECT_TRUE(contains(joined(points->warnings), "`verticalUnit`"));
  reading.verticalUnit = "cubits";
  const auto unknown = readDem(folder.file("a.csv"), reading);
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::usage);
  EXPECT_EQ(unknown.error().culprit, "cubits");
}

}  // namespace
}  // namespace arete

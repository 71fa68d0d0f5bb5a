// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/dem/clutter_raster.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "io/geo/crs/reader.h"
#include "io/geo/dem/raster_writer.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

Georeference lonLat(std::array<double, 6> geoTransform) {
  Georeference georeference;
  const auto crs = crsFromText("EPSG:4326");
  EXPECT_TRUE(crs);
  EXPECT_TRUE(describeCrs(*crs, georeference));
  georeference.geoTransform = geoTransform;
  georeference.hasGeoTransform = true;
  return georeference;
}

class ClutterRaster : public ::testing::Test {
 protected:
  /// A wood of two pixels by two, 7 and 9 high in the west and in the east, its corner in the north-west
  /// here.
  Result<SightClutter> wood(double longitude, double latitude, const TerrainModel& model) const {
    const std::string path = folder_.file("wood.tif");
    const std::vector<double> heights = {7, 9, 7, 9};
    EXPECT_TRUE(writeGeoTiff(path, 2, 2, heights, lonLat({longitude, 0.01, 0, latitude, 0, -0.01})));
    return readClutter(path, model);
  }
  static TerrainModel demAt(double longitude) {
    TerrainModel model;
    model.columns = model.rows = 21;
    model.georeference = lonLat({longitude - 0.0005, 0.001, 0, 46.0005, 0, -0.001});
    return model;
  }
  test::TemporaryFolder folder_;
};

TEST_F(ClutterRaster, StandsWhereItIsAnyTurnOfLongitudeAway) {
  for (const double dem : {-0.01, 359.99, -360.01})
    for (const double turns : {-360.0, 0.0, 360.0}) {
      const TerrainModel model = demAt(dem);
      const auto clutter = wood(-0.01 + turns, 46, model);
      ASSERT_TRUE(clutter) << dem << ", " << turns << ": " << clutter.error().describe();
      EXPECT_EQ(clutter->height({5, 10}), 7) << dem << ", " << turns;
      EXPECT_EQ(clutter->height({15, 10}), 9) << dem << ", " << turns;
    }
}

TEST_F(ClutterRaster, BesideAPartOfTheDemLeavesItBare) {
  const TerrainModel model = demAt(8);
  const auto clutter = wood(8.005, 46, model);
  ASSERT_TRUE(clutter) << clutter.error().describe();
  EXPECT_EQ(clutter->height({2, 10}), 0);
  EXPECT_EQ(clutter->height({10, 10}), 7);
  EXPECT_EQ(clutter->height({18, 10}), 9);
}

TEST_F(ClutterRaster, NowhereOverTheDemIsRefused) {
  const TerrainModel model = demAt(8);
  for (const auto& [longitude, latitude] :
       {std::array{7.979, 46.0}, {8.021, 46.0}, {8.0, 46.021}, {8.0, 45.979}}) {
    const auto clutter = wood(longitude, latitude, model);
    ASSERT_FALSE(clutter) << longitude << ", " << latitude;
    EXPECT_EQ(clutter.error().code, ErrorCode::usage);
    EXPECT_NE(clutter.error().describe().find("wood.tif: lies nowhere over the DEM"), std::string::npos)
        << clutter.error().describe();
  }
}

}  // namespace
}  // namespace arete

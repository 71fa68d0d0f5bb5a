// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/drape/placement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/drape_fixture.h"

namespace arete {
namespace {

using test::contains;
using test::PictureSpec;
using test::TemporaryFolder;
using test::terrainAt;
using test::Transform;

constexpr const char* kUtm = "EPSG:32611";
const Transform kDem = {500000, 30, 0, 4000000, 0, -30};  // 41 by 33 samples

class DrapePlacementTest : public ::testing::Test {
 protected:
  Result<DrapePlacement> place(const Transform& transform, const std::string& crs, int columns, int rows,
                               std::uint64_t maxPixels = 1 << 20) {
    PictureSpec spec;
    spec.columns = columns;
    spec.rows = rows;
    spec.transform = transform;
    spec.crs = crs;
    spec.bands = 1;
    spec.value = [](int, int, int) { return 1.0; };
    const GdalDatasetPtr picture = openGdal(test::writePicture(folder_.file("a.tif"), spec), GDAL_OF_RASTER);
    const auto way = drapeTransformer(*picture, model_, warnings_);
    if (!way) return tl::unexpected(way.error());
    return placeDrape(*picture, way->get(), model_, maxPixels);
  }
  TemporaryFolder folder_;
  TerrainModel model_ = terrainAt(folder_, kUtm, kDem);
  Warnings warnings_;
};

TEST_F(DrapePlacementTest, OfAParallelImageIsItsOwnGridOverTheTerrain) {
  // 10 m pixels from 100 pixels west and north of the DEM.
  const auto p = place({499000, 10, 0, 4001000, 0, -10}, kUtm, 400, 400);
  ASSERT_TRUE(p) << p.error().describe();
  EXPECT_TRUE(p->isExact);
  EXPECT_FALSE(p->isWarped);
  EXPECT_EQ(p->columns, 123u) << "41 samples of 30 m";
  EXPECT_EQ(p->rows, 99u);
  EXPECT_EQ(p->window, (std::array<double, 4>{100, 223, 100, 199}));
  EXPECT_NEAR(p->scale.x, 3, 1e-9);
  EXPECT_NEAR(-0.5 * p->scale.x + p->shift.x, 0, 1e-9) << "the corner of the first sample";
  EXPECT_NEAR(32.5 * p->scale.y + p->shift.y, 99, 1e-9);
}

TEST_F(DrapePlacementTest, OfATooLargeImageIsCoarser) {
  const auto p = place({499000, 10, 0, 4001000, 0, -10}, kUtm, 400, 400, 1000);
  ASSERT_TRUE(p);
  EXPECT_FALSE(p->isExact);
  EXPECT_LE(p->columns * p->rows, 1000u);
  EXPECT_GE(p->columns * p->rows, 800u);
  EXPECT_NEAR(p->coarser, std::sqrt(123 * 99 / 1000.0), 0.01);
  EXPECT_NEAR(p->scale.x, 3 / p->coarser, 1e-9);
}

TEST_F(DrapePlacementTest, OfARotatedOrTransformedImageIsANewGrid) {
  const auto rotated = place({500000, 8, 6, 4000000, 6, -8}, kUtm, 200, 200);
  ASSERT_TRUE(rotated) << rotated.error().describe();
  EXPECT_TRUE(rotated->isWarped);
  EXPECT_FALSE(rotated->isExact);
  EXPECT_NEAR(rotated->scale.x, 3, 0.01) << "as fine as its pixels of 10 m";
  const auto other = place({-117.01, 1e-4, 0, 36.2, 0, -1e-4}, "EPSG:4326", 400, 1000);
  ASSERT_TRUE(other) << other.error().describe();
  EXPECT_TRUE(other->isWarped);
}

TEST_F(DrapePlacementTest, SaysWhereTheTwoLieIfTheyAreApart) {
  const auto p = place({600000, 10, 0, 4001000, 0, -10}, kUtm, 10, 10);
  ASSERT_FALSE(p);
  EXPECT_EQ(p.error().code, ErrorCode::invalidData);
  EXPECT_TRUE(contains(p.error().message, "x 600000 to 600100")) << p.error().message;
}

TEST_F(DrapePlacementTest, NeedsAGeoreferenceAndACrs) {
  const auto none = place({}, "", 10, 10);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, ErrorCode::invalidData);
  EXPECT_TRUE(contains(none.error().message, "georeference")) << none.error().message;
  const auto noCrs = place({499000, 10, 0, 4001000, 0, -10}, "", 10, 10);
  ASSERT_FALSE(noCrs);
  EXPECT_TRUE(contains(noCrs.error().message, "CRS")) << noCrs.error().message;
}

}  // namespace
}  // namespace arete

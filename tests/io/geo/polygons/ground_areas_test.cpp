// SPDX-License-Identifier: GPL-3.0-or-later
//
// Areas of cells, held against those of geodesic polygons [Karney2013] and of the whole ellipsoid.
#include "io/geo/polygons/ground_areas.h"

#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/PolygonArea.hpp>
#include <array>
#include <cmath>

#include "io/geo/crs/reader.h"

namespace arete {
namespace {

Georeference georeferenceOf(const char* crs, std::array<double, 6> transform) {
  Georeference georeference;
  georeference.geoTransform = transform;
  georeference.hasGeoTransform = true;
  OGRSpatialReference reference;
  EXPECT_EQ(reference.SetFromUserInput(crs), OGRERR_NONE);
  EXPECT_TRUE(describeCrs(reference, georeference));
  return georeference;
}

TEST(GroundAreas, OfTheWholeEarthAreThoseOfTheEllipsoid) {
  const Georeference earth = georeferenceOf("EPSG:4326", {-180, 0.5, 0, 90, 0, -0.5});
  auto areas = GroundAreas::of(earth, 720, 360);
  ASSERT_TRUE(areas);
  double sum = 0;
  for (std::uint32_t row = 0; row < 360; ++row) sum += areas->ofRun(row, 0, 720);
  const double whole = GeographicLib::Geodesic::WGS84().EllipsoidArea();
  EXPECT_NEAR(sum / whole, 1, 1e-4);
}

TEST(GroundAreas, AreThoseOfGeodesicPolygons) {
  struct Case {
    const char* crs;
    std::array<double, 6> transform;
    std::uint32_t side;
  };
  for (const Case& c : {Case{"EPSG:32632", {400000, 30, 0, 5200000, 0, -30}, 700},
                        Case{"EPSG:3857", {800000, 100, 0, 8400000, 0, -100}, 900},
                        Case{"EPSG:3413", {-200000, 1000, 0, 200000, 0, -1000}, 401},
                        Case{"EPSG:4326", {7, 0.001, 0, 47, 0, -0.001}, 600},
                        Case{"EPSG:32632", {400000, 20, 10, 5200000, 10, -20}, 300}}) {
    const Georeference georeference = georeferenceOf(c.crs, c.transform);
    auto areas = GroundAreas::of(georeference, c.side, c.side);
    ASSERT_TRUE(areas) << c.crs;
    OGRSpatialReference map, lonLat;
    map.SetFromUserInput(c.crs);
    map.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    lonLat.CopyGeogCSFrom(&map);
    lonLat.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const std::unique_ptr<OGRCoordinateTransformation> toLonLat(
        OGRCreateCoordinateTransformation(&map, &lonLat));
    for (const std::uint32_t row : {0u, 1u, c.side / 3, c.side / 2, c.side - 1})
      for (const std::uint32_t column : {0u, c.side / 5, c.side / 2 + 1, c.side - 2}) {
        GeographicLib::PolygonArea polygon(GeographicLib::Geodesic::WGS84());
        for (const auto& [x, y] : {std::array{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
          Vec2 p = georeference.toSource(column + x, row + y);
          ASSERT_TRUE(toLonLat->Transform(1, &p.x, &p.y));
          polygon.AddPoint(p.y, p.x);
        }
        double perimeter = 0, area = 0;
        polygon.Compute(false, true, perimeter, area);
        EXPECT_NEAR(areas->ofRun(row, column, column + 1) / std::abs(area), 1, 1e-3)
            << c.crs << ", column " << column << ", row " << row;
      }
  }
}

TEST(GroundAreas, AreUnknownWithoutACrsOrAPosition) {
  EXPECT_FALSE(GroundAreas::of({}, 3, 3));
  Georeference georeference = georeferenceOf("EPSG:32632", {400000, 30, 0, 5200000, 0, -30});
  EXPECT_TRUE(GroundAreas::of(georeference, 1, 1));
  georeference.hasGeoTransform = false;
  EXPECT_FALSE(GroundAreas::of(georeference, 3, 3));
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/bent/utm.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/geo/bent/place_map.h"
#include "io/geo/crs/names.h"

namespace arete {
namespace {

Georeference degreesOf(const std::string& crs = "EPSG:4326") {
  return georeferenceOf(crs, "m").value();
}

std::vector<Vec3> boxAt(double west, double south, double east, double north) {
  return {{west, south, 0}, {east, south, 0}, {west, north, 0}, {east, north, 0}};
}

std::string nameOfUtm(const Georeference& source, const std::vector<Vec3>& box) {
  const auto map = PlaceMap::of(source, {.crs = "utm"}, box, box[0]);
  return map ? map->name() : map.error().describe();
}

TEST(Utm, IsTheZoneOfTheMiddleOnTheDatumOfTheSource) {
  EXPECT_EQ(nameOfUtm(degreesOf(), boxAt(8, 46, 9, 47)), "WGS 84 / UTM zone 32N (EPSG:32632)");
  EXPECT_EQ(nameOfUtm(degreesOf(), boxAt(-71, -33, -70, -32)), "WGS 84 / UTM zone 19S (EPSG:32719)");
  EXPECT_EQ(nameOfUtm(degreesOf("EPSG:4269"), boxAt(-108, 38, -107, 39)),
            "NAD83 / UTM zone 13N (EPSG:26913)");
  EXPECT_EQ(nameOfUtm(degreesOf("EPSG:4258"), boxAt(8, 46, 9, 47)), "ETRS89 / UTM zone 32N (EPSG:25832)");
}

TEST(Utm, TakesLongitudesAcrossTheAntimeridianAndBeyondHalfATurn) {
  EXPECT_EQ(nameOfUtm(degreesOf(), boxAt(179, -17, 182, -16)), "WGS 84 / UTM zone 1S (EPSG:32701)");
  EXPECT_EQ(nameOfUtm(degreesOf(), boxAt(178, -17, 181, -16)), "WGS 84 / UTM zone 60S (EPSG:32760)");
  EXPECT_EQ(nameOfUtm(degreesOf(), boxAt(352, 40, 353, 41)), "WGS 84 / UTM zone 29N (EPSG:32629)");
}

TEST(Utm, KnowsTheWiderZonesOfNorwayAndSvalbard) {
  EXPECT_EQ(utmZoneAt(4, 60, true).number, 32);  // Bergen
  EXPECT_EQ(utmZoneAt(2, 60, true).number, 31);
  EXPECT_EQ(utmZoneAt(4, 60, false).number, 31);  // another planet
  EXPECT_EQ(utmZoneAt(8, 78, true).number, 31);
  EXPECT_EQ(utmZoneAt(10, 78, true).number, 33);
  EXPECT_EQ(utmZoneAt(16, 78, true).number, 33);
  EXPECT_EQ(utmZoneAt(22, 78, true).number, 35);
  EXPECT_EQ(utmZoneAt(40, 78, true).number, 37);
  EXPECT_EQ(utmZoneAt(-180, 0, true).number, 1);
  EXPECT_EQ(utmZoneAt(180, 0, true).number, 1);
  EXPECT_EQ(utmZoneAt(179.999, 0, true).number, 60);
}

TEST(Utm, IsRefusedByNameBeyondAZoneAndBeyondItsLatitudes) {
  const auto refused = [](const Georeference& source, const std::vector<Vec3>& box) {
    const auto map = PlaceMap::of(source, {.crs = "utm"}, box, box[0]);
    if (map) return std::string("accepted");
    EXPECT_EQ(map.error().code, ErrorCode::usage);
    EXPECT_EQ(map.error().culprit, "toCrs utm");
    return map.error().message;
  };
  EXPECT_NE(refused(degreesOf(), boxAt(0, 40, 14, 47)).find("more than 3 degrees beyond zone 32"),
            std::string::npos);
  EXPECT_EQ(refused(degreesOf(), boxAt(3, 40, 14, 47)), "accepted");
  EXPECT_NE(refused(degreesOf(), boxAt(-180, 60, 180, 84)).find("beyond zone"), std::string::npos);
  EXPECT_NE(refused(degreesOf(), boxAt(0, 80, 3, 85)).find("beyond UTM"), std::string::npos);
  EXPECT_NE(refused(degreesOf(), boxAt(0, -81, 3, -79)).find("EPSG:3031"), std::string::npos);
  EXPECT_NE(refused({}, boxAt(0, 0, 1, 1)).find("CRS"), std::string::npos);
}

}  // namespace
}  // namespace arete

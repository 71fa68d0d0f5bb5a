// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/crs/data_unit.h"

#include <gtest/gtest.h>

#include <string>

#include "io/geo/crs/reader.h"

namespace arete {
namespace {

std::string wkt(const std::string& code) {
  return wktOf(crsFromUser(code).value());
}

TEST(DataUnit, OfHeightsIsThatOfTheGeoreference) {
  Georeference georeference;
  EXPECT_EQ(heightUnitOf(georeference).metres, 0) << "not stated";
  georeference.verticalUnit = "m";
  EXPECT_EQ(heightUnitOf(georeference).metres, 1);
  georeference.verticalUnit = "US survey foot";
  georeference.verticalUnitMetres = 1200.0 / 3937;
  EXPECT_EQ(heightUnitOf(georeference).metres, 1200.0 / 3937);
  georeference.verticalUnit = "hPa";
  georeference.verticalUnitMetres = 1;
  EXPECT_EQ(heightUnitOf(georeference).metres, 0) << "is no length";
}

TEST(DataUnit, OfTheGroundIsTheMetreWhereThereIsACrs) {
  Georeference georeference;
  EXPECT_EQ(groundUnitOf(georeference).metres, 0);
  georeference.crsWkt = wkt("EPSG:4326");
  EXPECT_EQ(groundUnitOf(georeference).metres, 1) << "in degrees too";
}

TEST(DataUnit, OfSpaceIsOneOnlyWherePlanAndHeightsAgree) {
  EXPECT_EQ(spaceUnitOf("", "").metres, 0);
  EXPECT_EQ(spaceUnitOf("", "m").metres, 1);
  EXPECT_EQ(spaceUnitOf("", "ft").metres, 0.3048);
  EXPECT_EQ(spaceUnitOf("", "furlong").metres, 0);
  EXPECT_EQ(spaceUnitOf(wkt("EPSG:32611"), "").metres, 1);
  EXPECT_EQ(spaceUnitOf(wkt("EPSG:32611"), "m").metres, 1);
  EXPECT_EQ(spaceUnitOf(wkt("EPSG:32611"), "ft").metres, 0);
  EXPECT_EQ(spaceUnitOf(wkt("EPSG:4326"), "m").metres, 0) << "degrees are no lengths";
  EXPECT_NEAR(spaceUnitOf(wkt("EPSG:2229"), "us-ft").metres, 1200.0 / 3937, 1e-15);
  EXPECT_EQ(spaceUnitOf("gibberish", "m").metres, 0);
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/crs/reader.h"

#include <gtest/gtest.h>

#include <fstream>

#include "io/files/text/utf8.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

TEST(CrsReader, ParsesEveryFormOfText) {
  const auto utm = crsFromText("EPSG:32611");
  ASSERT_TRUE(utm) << utm.error().describe();
  for (const std::string& text : {std::string("urn:ogc:def:crs:EPSG::32611"), wktOf(*utm),
                                  std::string("+proj=utm +zone=11 +datum=WGS84 +units=m +no_defs")}) {
    const auto parsed = crsFromText(text);
    ASSERT_TRUE(parsed) << text;
    EXPECT_TRUE(parsed->IsProjected()) << text;
  }
  EXPECT_TRUE(crsFromText("EPSG:4326+5773"));
}

TEST(CrsReader, RefusesWhatIsNotACrsAndNamesIt) {
  for (const char* text : {"", "gibberish", "EPSG:99999999", "EPSG:5773"}) {
    const auto parsed = crsFromText(text);
    ASSERT_FALSE(parsed) << text;
    EXPECT_EQ(parsed.error().code, ErrorCode::invalidData) << text;
    EXPECT_EQ(parsed.error().culprit, "") << "the caller knows the file";
    EXPECT_NE(parsed.error().message.find(text), std::string::npos);
    const auto stated = crsFromUser(text);
    ASSERT_FALSE(stated) << text;
    EXPECT_EQ(stated.error().code, ErrorCode::usage) << text;
    EXPECT_EQ(stated.error().culprit, text);
  }
}

TEST(CrsReader, QuotesNoTornCharacter) {
  for (const std::string end : {"\u00e9", "\u6c34", "\U0001F5FB"})
    for (std::size_t before = 50; before < 64; ++before) {
      const std::string text = std::string(before, 'a') + end;
      for (const std::string behind : {"", "bb"}) {
        const auto crs = crsFromText(text + behind);
        ASSERT_FALSE(crs);
        EXPECT_TRUE(text::isUtf8(crs.error().message)) << crs.error().message;
        // A text that is quoted as a whole has all of its last character.
        if (text.size() + behind.size() <= 60) {
          EXPECT_NE(crs.error().message.find(text + behind + "'"), std::string::npos) << crs.error().message;
        }
      }
    }
}

TEST(CrsReader, OpensAFileForAPersonOnly) {
  const test::TemporaryFolder folder;
  const std::string path = folder.write("a.prj", wktOf(*crsFromText("EPSG:32611")));
  EXPECT_TRUE(crsFromUser(path));
  EXPECT_FALSE(crsFromText(path)) << "what a file says must not open another one";
}

TEST(CrsReader, TakesTheStatedCrsBeforeThatOfTheFile) {
  const auto utm = crsFromText("EPSG:32611"), other = crsFromText("EPSG:32612");
  Warnings warnings;
  EXPECT_TRUE(chooseCrs(nullptr, "", warnings)->IsEmpty());
  EXPECT_TRUE(chooseCrs(&*utm, "", warnings)->IsSame(&*utm));
  EXPECT_TRUE(chooseCrs(nullptr, "EPSG:32611", warnings)->IsSame(&*utm));
  EXPECT_TRUE(chooseCrs(&*utm, "EPSG:32611", warnings)->IsSame(&*utm));
  EXPECT_TRUE(warnings.empty()) << test::joined(warnings);
  EXPECT_TRUE(chooseCrs(&*utm, "EPSG:32612", warnings)->IsSame(&*other));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].sentence.find("nothing is reprojected"), std::string::npos) << warnings[0].sentence;
  EXPECT_FALSE(chooseCrs(&*utm, "gibberish", warnings));
}

TEST(CrsReader, TakesABareNumberForOneOfEpsg) {
  const auto utm = crsFromText("EPSG:32611");
  const auto bare = crsFromUser("32611");
  ASSERT_TRUE(bare) << bare.error().describe();
  EXPECT_TRUE(bare->IsSame(&*utm));
  const auto unknown = crsFromUser("999999");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().culprit, "999999");
  EXPECT_EQ(unknown.error().code, ErrorCode::usage);
  for (const char* none : {"32", "2193.5", "-4326", ""}) EXPECT_FALSE(crsFromUser(none)) << none;
}

TEST(CrsReader, DescribesKindUnitsAndEllipsoid) {
  Georeference degrees, feet, moon, none;
  ASSERT_TRUE(describeCrs(*crsFromText("EPSG:4326"), degrees));
  EXPECT_TRUE(degrees.isGeographic);
  EXPECT_NEAR(degrees.angularUnitRadians, 0.017453292519943295, 1e-17);
  EXPECT_NEAR(degrees.inverseFlattening, 298.257223563, 1e-9);
  EXPECT_TRUE(degrees.verticalUnit.empty());
  ASSERT_TRUE(describeCrs(*crsFromText("EPSG:2227+6360"), feet));  // California, both in US survey feet
  EXPECT_FALSE(feet.isGeographic);
  EXPECT_NEAR(feet.linearUnitMetres, 1200.0 / 3937, 1e-12);
  EXPECT_NEAR(feet.verticalUnitMetres, 1200.0 / 3937, 1e-12);
  EXPECT_NE(feet.verticalDatum.find("NAVD88"), std::string::npos) << feet.verticalDatum;
  ASSERT_TRUE(describeCrs(*crsFromText("+proj=longlat +R=1737400 +no_defs"), moon));
  EXPECT_EQ(moon.semiMajorAxisMetres, 1737400);
  EXPECT_EQ(moon.inverseFlattening, 0);
  ASSERT_TRUE(describeCrs(OGRSpatialReference(), none));
  EXPECT_TRUE(none.crsWkt.empty());
}

TEST(CrsReader, TakesAThirdAxisForTheEllipsoid) {
  Georeference georeference;
  ASSERT_TRUE(describeCrs(*crsFromText("EPSG:4979"), georeference));
  EXPECT_EQ(georeference.verticalDatum, "ellipsoid");
  EXPECT_EQ(georeference.verticalUnitMetres, 1);
}

TEST(CrsReader, RefusesAGeocentricCrs) {
  Georeference georeference;
  const Status status = describeCrs(*crsFromText("EPSG:4978"), georeference);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::unsupported);
}

TEST(CrsReader, KnowsUnitsOfHeightInEitherCase) {
  EXPECT_EQ(metresPerUnit("Metre"), 1);
  EXPECT_EQ(metresPerUnit("FT"), 0.3048);
  EXPECT_EQ(metresPerUnit("US survey foot"), 1200.0 / 3937);
  EXPECT_FALSE(metresPerUnit("furlong"));
  EXPECT_FALSE(metresPerUnit(""));
}

TEST(CrsReader, TakesAnUndefinedCrsForNone) {
  EXPECT_FALSE(isKnownCrs(nullptr));
  const OGRSpatialReference empty;
  EXPECT_FALSE(isKnownCrs(&empty));
  const auto utm = crsFromText("EPSG:32611");
  EXPECT_TRUE(isKnownCrs(&*utm));
  OGRSpatialReference undefined;
  undefined.SetLocalCS("Undefined Cartesian SRS");
  EXPECT_FALSE(isKnownCrs(&undefined));
}

}  // namespace
}  // namespace arete

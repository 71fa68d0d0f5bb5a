// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/table/feature_rows.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "io/geo/crs/reader.h"
#include "io/io_fixture.h"
#include "io/vector_fixture.h"

namespace arete {
namespace {

using test::TemporaryFolder;
using test::writeVector;

Georeference utmOfRows() {
  Georeference georeference;
  EXPECT_TRUE(describeCrs(*crsFromText("EPSG:32611"), georeference));
  return georeference;
}

class FeatureRowsTest : public ::testing::Test {
 protected:
  FeatureRowsTest()
      : dataset_(openGdal(
            writeVector(folder_.file("a.gpkg"), "GPKG",
                        {{"a", wkbPoint, {{"POINT (1 2)", 0.1}, {"POINT (3 4)", NAN}, {nullptr, 7}}}}),
            GDAL_OF_VECTOR)) {}
  OGRLayer& layer() { return *dataset_->GetLayer(0); }
  TemporaryFolder folder_;
  GdalDatasetPtr dataset_;
};

TEST_F(FeatureRowsTest, ComeInTheOrderOfTheLayerEveryTime) {
  for (int round = 0; round < 2; ++round) {
    GdalErrors errors;
    std::vector<std::string> heights;
    EXPECT_TRUE(forFeatures(*dataset_, layer(), errors, {}, [&](OGRFeature& feature) -> Status {
      heights.push_back(fieldText(feature, 0));
      return {};
    }));
    EXPECT_EQ(heights, (std::vector<std::string>{"0.1", "", "7"})) << "all digits; empty where it is not set";
  }
}

TEST_F(FeatureRowsTest, EndWithTheFirstError) {
  GdalErrors errors;
  int calls = 0;
  const Status status = forFeatures(*dataset_, layer(), errors, {}, [&](OGRFeature&) -> Status {
    if (++calls == 2) return failure(ErrorCode::degenerate, "two");
    return {};
  });
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::degenerate);
  EXPECT_EQ(calls, 2);
}

TEST_F(FeatureRowsTest, EndWhenCancelledOrGdalFails) {
  const std::atomic<bool> stop = true;
  RunContext context;
  context.cancel = &stop;
  GdalErrors errors;
  const auto none = [](OGRFeature&) -> Status { return {}; };
  EXPECT_EQ(forFeatures(*dataset_, layer(), errors, context, none).error().code, ErrorCode::interrupted);
  const Status failed = forFeatures(*dataset_, layer(), errors, {}, [](OGRFeature&) -> Status {
    CPLError(CE_Failure, CPLE_AppDefined, "the disk is gone");
    return {};
  });
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().code, ErrorCode::unreadable);
  EXPECT_NE(failed.error().message.find("the disk is gone"), std::string::npos);
}

TEST_F(FeatureRowsTest, HaveKindsOfColumns) {
  using Kind = PointAttributes::Kind;
  const auto kind = [](OGRFieldType type, OGRFieldSubType subtype = OFSTNone) {
    OGRFieldDefn field("a", type);
    field.SetSubType(subtype);
    return kindOf(field);
  };
  EXPECT_EQ(kind(OFTInteger), Kind::integer32);
  EXPECT_EQ(kind(OFTInteger, OFSTInt16), Kind::integer16);
  EXPECT_EQ(kind(OFTInteger, OFSTBoolean), Kind::boolean);
  EXPECT_EQ(kind(OFTInteger64), Kind::integer);
  EXPECT_EQ(kind(OFTReal), Kind::real);
  EXPECT_EQ(kind(OFTReal, OFSTFloat32), Kind::real32);
  EXPECT_EQ(kind(OFTString), Kind::text);
  EXPECT_EQ(kind(OFTString, OFSTJSON), Kind::json);
  EXPECT_EQ(kind(OFTDate), Kind::date);
  EXPECT_EQ(kind(OFTTime), Kind::time);
  EXPECT_EQ(kind(OFTDateTime), Kind::dateTime);
  EXPECT_EQ(kind(OFTBinary), Kind::bytes);
  EXPECT_EQ(kind(OFTStringList), Kind::text);
}

TEST(TransformOf, FollowsTheCrsOfTheFileAndTheDem) {
  const auto geographic = crsFromText("OGC:CRS84");
  Warnings warnings;
  // The file has a CRS.
  EXPECT_FALSE(transformOf(&*geographic, utmOfRows(), false, false, warnings)->isIdentity());
  EXPECT_TRUE(warnings.empty());
  EXPECT_FALSE(transformOf(&*geographic, utmOfRows(), true, false, warnings)->isIdentity());
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].sentence.find("`lonLat`"), std::string::npos) << warnings[0].sentence;
  EXPECT_EQ(transformOf(&*geographic, {}, false, false, warnings).error().code, ErrorCode::invalidData);
  // It has none.
  warnings.clear();
  EXPECT_TRUE(transformOf(nullptr, utmOfRows(), false, true, warnings)->isIdentity());
  EXPECT_TRUE(warnings.empty()) << "a table never has one";
  EXPECT_TRUE(transformOf(nullptr, utmOfRows(), false, false, warnings)->isIdentity());
  EXPECT_EQ(warnings.size(), 1u);
  EXPECT_FALSE(transformOf(nullptr, utmOfRows(), true, true, warnings)->isIdentity());
  EXPECT_EQ(transformOf(nullptr, {}, true, true, warnings).error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/extract/region_argument.h"

#include <gtest/gtest.h>

#include "io/georeference_fixture.h"
#include "io/io_fixture.h"

namespace arete {
namespace {

using test::TemporaryFolder;

TEST(RegionArgument, IsABoxOrAFile) {
  const auto box = readRegionArgument({"1, -2,3,4e1"}, {}, {});
  ASSERT_TRUE(box);
  EXPECT_EQ(box->shape.rings, (std::vector<std::vector<Vec2>>{{{1, -2}, {3, -2}, {3, 40}, {1, 40}}}));
  for (const char* text : {"1,2,3", "1,2,3,4,5", "3,0,1,9", "0,5,1,5", "0,0,inf,1", "0,0,nan,1"})
    EXPECT_EQ(readRegionArgument({text}, {}, {}).error().code, ErrorCode::usage) << text;
  EXPECT_EQ(readRegionArgument({"no,such,file"}, {}, {}).error().code, ErrorCode::notFound);

  const TemporaryFolder folder;
  const std::string file = folder.write(
      "r.geojson", R"({"type":"Polygon","coordinates":[[[-117,34],[-116,34],[-116,35],[-117,34]]]})");
  EXPECT_TRUE(readRegionArgument({file}, test::georeferenceOf("EPSG:32611"), {}));
  EXPECT_EQ(readRegionArgument({file}, {}, {}).error().code, ErrorCode::usage);
}

TEST(RegionArgument, HasTheDistanceThatWasGiven) {
  EXPECT_EQ(readRegionArgument({"1,2,3,4"}, {}, {})->shape.distance, 0);
  EXPECT_EQ(readRegionArgument({"1,2,3,4", 25}, {}, {})->shape.distance, 25);
}

TEST(RegionArgument, NamesTheFieldAndTheText) {
  EXPECT_EQ(readRegionArgument({"1,2,3"}, {}, {}).error().culprit, "region 1,2,3");
  const auto error = readRegionArgument({"1,2,three,4"}, {}, {}).error();
  EXPECT_EQ(error.code, ErrorCode::notFound);
  EXPECT_NE(error.message.find("four numbers"), std::string::npos) << error.message;
}

TEST(RegionArgument, OfLinesNeedsADistance) {
  const TemporaryFolder folder;
  const std::string lines =
      folder.write("l.geojson", R"({"type":"LineString","coordinates":[[-117,34],[-116,35]]})");
  const auto refused = readRegionArgument({lines}, test::georeferenceOf("EPSG:4326"), {}).error();
  EXPECT_EQ(refused.code, ErrorCode::usage);
  EXPECT_NE(refused.message.find("`distance`"), std::string::npos) << refused.message;
  const auto corridor = readRegionArgument({lines, 10}, test::georeferenceOf("EPSG:4326"), {});
  ASSERT_TRUE(corridor) << corridor.error().describe();
  EXPECT_EQ(corridor->shape.rings.size(), 1u);
  EXPECT_TRUE(corridor->shape.lines.empty());
}

}  // namespace
}  // namespace arete

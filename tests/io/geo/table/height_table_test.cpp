// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/table/height_table.h"

#include "io/geo/crs/reader.h"
#include "io/geo/table/point_table.h"
#include "io/io_fixture.h"
#include "io/table_fixture.h"

namespace arete {
namespace {

using test::csvOf;
using test::TemporaryFolder;
using test::utm;

std::string contentOf(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(HeightTable, WritesAGeoPackageThatReadsBackWithEveryRowAndColumn) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.csv",
                                        "fid,Height,x,y,part\n"
                                        "9,old,10.5,20,0.1\n"
                                        "8,older,11,21,\n");
  const auto table = readPointTable(path, utm());
  ASSERT_TRUE(table);
  const std::vector<std::optional<GroundHeight>> heights = {
      GroundHeight{.height = 1.1, .below = 0.5, .above = 0.25}, std::nullopt};
  const std::string out = folder.file("out.gpkg"), again = folder.file("again.gpkg");
  ASSERT_TRUE(writeHeightTable(out, *table, heights));
  ASSERT_TRUE(writeHeightTable(again, *table, heights));
  EXPECT_EQ(contentOf(out), contentOf(again)) << "the same bytes";

  const auto back = readPointTable(out, utm());
  ASSERT_TRUE(back) << back.error().describe();
  EXPECT_EQ(back->positions, table->positions);
  EXPECT_EQ(
      csvOf(*back, {std::nullopt, std::nullopt}),
      "source_fid,fid_in,Height_in,part,x_in,y_in,height_in_in,below_in,above_in,x,y,height,below,above\n"
      "1,9,old,0.1,10.5,20,1.1,0.5,0.25,10.5,20,,,\n"
      "2,8,older,,11,21,,,,11,21,,,\n");
}

TEST(HeightTable, IsRefusedUnderAnotherExtensionAndLeavesNothingBehind) {
  const TemporaryFolder folder;
  PointTable table;
  table.stated = table.positions = {{1, 2}};
  const std::vector<std::optional<GroundHeight>> heights(1);
  EXPECT_EQ(writeHeightTable(folder.file("a.shp"), table, heights).error().code, ErrorCode::usage);
  EXPECT_EQ(writeHeightTable(folder.file("no/a.csv"), table, heights).error().code, ErrorCode::notFound);
  EXPECT_EQ(writeHeightTable(folder.file("no/a.gpkg"), table, heights).error().code, ErrorCode::notFound);
  const std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  EXPECT_EQ(writeHeightTable(folder.file("a.gpkg"), table, heights, context).error().code,
            ErrorCode::interrupted);
  EXPECT_EQ(folder.count(), 0u);
}

}  // namespace
}  // namespace arete

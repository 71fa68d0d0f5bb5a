// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/text/column_rules.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "io/files/text_scan.h"

namespace arete {
namespace {

std::optional<std::size_t> find(const std::vector<std::string>& columns,
                                std::span<const std::string_view> names) {
  return findColumn(
      columns.size(), [&](std::size_t i) { return std::string_view(columns[i]); }, names);
}

TEST(ColumnRules, PreferTheFirstNameOfTheListWhateverTheOrderOfTheColumns) {
  EXPECT_EQ(find({"easting", "lon", "X"}, ColumnNames::x()), 2u);
  EXPECT_EQ(find({"easting", "Lon"}, ColumnNames::x()), 1u);
  EXPECT_EQ(find({"x", "x"}, ColumnNames::x()), 0u) << "the first of equal names";
  EXPECT_FALSE(find({"xx", "y", ""}, ColumnNames::x()));
  EXPECT_FALSE(find({}, ColumnNames::x()));
}

TEST(ColumnRules, GiveTheFirstEndTheNamesOfAPointAsWell) {
  EXPECT_EQ(find({"x", "x1"}, ColumnNames::endX(0)), 1u);
  EXPECT_EQ(find({"point_x", "x2"}, ColumnNames::endX(0)), 0u);
  EXPECT_FALSE(find({"x", "lon"}, ColumnNames::endX(1)));
  EXPECT_FALSE(find({"y", "lat"}, ColumnNames::endY(1)));
}

TEST(ColumnRules, GiveNoColumnTwoMeanings) {
  const std::vector<std::span<const std::string_view>> lists = {
      ColumnNames::endX(0),   ColumnNames::endY(0),      ColumnNames::endX(1),
      ColumnNames::endY(1),   ColumnNames::endHeight(0), ColumnNames::endHeight(1),
      ColumnNames::azimuth(), ColumnNames::range(),      ColumnNames::beamwidth()};
  std::vector<std::string_view> all;
  for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
  for (const std::string_view name : all) EXPECT_EQ(text::lowered(name), name);
  std::ranges::sort(all);
  EXPECT_EQ(std::ranges::adjacent_find(all), all.end());
}

}  // namespace
}  // namespace arete

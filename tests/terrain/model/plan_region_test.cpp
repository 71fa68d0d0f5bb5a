// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/model/plan_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>

#include "datasets/families.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

RasterHeightfield modelOf(std::string_view name, std::uint32_t columns, std::uint32_t rows) {
  for (const RasterFamily& family : rasterFamilies())
    if (family.name == name) return family.make(columns, rows, 3);
  return {};
}

std::vector<Vec2> gridBox(const RasterHeightfield& field, double c0, double r0, double c1, double r1) {
  const Georeference& g = field.georeference;
  return {g.toSource(c0, r0), g.toSource(c1, r0), g.toSource(c1, r1), g.toSource(c0, r1)};
}

TEST(PlanRegion, HoldsTheSamplesItWasDrawnAround) {
  for (const char* name : {"fractal", "rotated", "south up", "geographic"}) {
    SCOPED_TRACE(name);
    const RasterHeightfield field = modelOf(name, 20, 16);
    const Region region = planRegion({.rings = {gridBox(field, 3.5, 2.5, 9.5, 7.5)}}, field);
    const auto inside = samplesInside(region, field);
    EXPECT_EQ(std::accumulate(inside.begin(), inside.end(), 0), 6 * 5);
    EXPECT_EQ(inside[field.index(4, 3)], 1);
    EXPECT_EQ(inside[field.index(10, 3)], 0);
  }
}

TEST(PlanRegion, ABoxOfTheMapStaysOneOnARotatedGrid) {
  const RasterHeightfield field = modelOf("rotated", 30, 30);
  const Vec2 centre = field.georeference.toSource(15, 15);
  const Vec2 step = groundStep(field.georeference, 15, 15);
  const double half = 5 * step.x;
  const std::vector<Vec2> box = {{centre.x - half, centre.y - half},
                                 {centre.x + half, centre.y - half},
                                 {centre.x + half, centre.y + half},
                                 {centre.x - half, centre.y + half}};
  const auto inside = samplesInside(planRegion({.rings = {box}}, field), field);
  for (std::uint32_t row = 0; row < field.rows; ++row)
    for (std::uint32_t column = 0; column < field.columns; ++column) {
      const Vec2 p = field.georeference.toSource(column, row);
      const double reach = std::max(std::abs(p.x - centre.x), std::abs(p.y - centre.y)) / half;
      if (std::abs(reach - 1) < 1e-9) continue;
      EXPECT_EQ(inside[field.index(column, row)], reach < 1) << column << " " << row;
    }
}

TEST(PlanRegion, KnowsWhetherItMeetsTheDomain) {
  const RasterHeightfield field = modelOf("rotated", 24, 24);
  const auto model = build(field);
  ASSERT_TRUE(model) << model.error().describe();
  EXPECT_TRUE(meetsDomain(planRegion({.rings = {gridBox(field, 5.1, 5.1, 5.2, 5.2)}}, *model), model->mt));
  EXPECT_FALSE(meetsDomain(planRegion({.rings = {gridBox(field, 24, 0, 30, 24)}}, *model), model->mt));
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Viewsheds cell by cell against the scan of every cell below each line, which passes nothing over and knows
// nothing of skylines.
#include "terrain/viewshed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "datasets/families.h"
#include "datasets/random.h"
#include "terrain/build.h"

namespace arete {
namespace {

struct Place {
  TerrainModel model;
  std::shared_ptr<const SightGrid> grid;
  std::unique_ptr<SightEarth> earth;
  std::unique_ptr<SightEngine> scan;

  explicit Place(const RasterHeightfield& field) : model(*build(field)) {
    grid = std::make_shared<SightGrid>(model);
    earth = makePlaneEarth(model);
    scan = makeSightScan(grid);
  }
};

ViewshedCell cellOf(SightVerdict verdict) {
  return verdict == SightVerdict::visible   ? ViewshedCell::seen
         : verdict == SightVerdict::blocked ? ViewshedCell::hidden
                                            : ViewshedCell::unknown;
}

struct Tally {
  std::uint64_t cells = 0, wrong = 0, rays = 0, seen = 0, hidden = 0, unknown = 0;
};

/// Every cell of a viewshed against the scan.
void compare(const Place& place, const ViewshedObserver& observer, const ViewshedOptions& options,
             const Viewshed& viewshed, const std::string& what, Tally& tally) {
  const double unit = place.model.georeference.verticalUnitMetres;
  for (std::uint32_t row = 0; row < viewshed.rows; ++row)
    for (std::uint32_t column = 0; column < viewshed.columns; ++column) {
      const ViewshedCell cell = viewshed.cells[std::size_t{row} * viewshed.columns + column];
      const double z = place.grid->height(column, row);
      if (std::isnan(z)) {
        ASSERT_EQ(cell, ViewshedCell::outside) << what;
        continue;
      }
      const SightLine line(*place.earth->track(observer.plan, {double(column), double(row)}), observer.height,
                           z + options.targetHeight, unit);
      const SightAnswer answer = place.scan->answer(line, {.nodata = options.nodata});
      ++tally.cells;
      if (cell != cellOf(answer.verdict) && tally.wrong++ < 5)
        ADD_FAILURE() << what << ": cell " << column << ", " << row << " is " << int(cell) << ", not "
                      << int(cellOf(answer.verdict)) << "; clearance " << answer.clearance.value_or(NAN)
                      << " at " << answer.least.distance << " of " << line.length() << ", observer "
                      << observer.plan.x << ", " << observer.plan.y << ", " << observer.height;
    }
  tally.rays += viewshed.rays;
  tally.seen += viewshed.seen;
  tally.hidden += viewshed.hidden;
  tally.unknown += viewshed.unknown;
}

ViewshedObserver randomObserver(const Place& place, Random& random, int which) {
  const double columns = place.grid->columns() - 1, rows = place.grid->rows() - 1;
  Vec2 plan{random.between(0, columns), random.between(0, rows)};
  if (which % 4 == 0) plan = {std::round(plan.x), std::round(plan.y)};
  if (which % 4 == 1) plan.x = std::round(plan.x);
  if (which % 12 == 2)
    plan.y = std::min(rows, std::max(0.0, plan.x - std::floor(plan.x) + std::floor(plan.y)));
  if (which % 12 == 3) plan = {which % 24 == 3 ? 0 : columns, std::round(plan.y)};
  const double ground = place.grid->at(plan);
  const double heights[] = {0, 2, 0.1, 30, 1e-5};
  return {plan, (std::isnan(ground) ? 100 : ground) + heights[which % 5]};
}

TEST(Viewshed, TheSweepGivesTheAnswerOfTheScanOnEveryFamily) {
  Random random(1);
  for (const RasterFamily& family : rasterFamilies()) {
    const Place place(family.make(47, 38, 3));
    const auto maker = ViewshedMaker::make(place.model, *place.earth, place.grid);
    ASSERT_TRUE(maker);
    Tally tally;
    int sweeps = 0;
    for (int i = 0; i < 30; ++i) {
      const ViewshedObserver observer = randomObserver(place, random, i);
      ViewshedOptions options;
      options.targetHeight = i % 3 == 0 ? 1.5 : 0;
      options.nodata = static_cast<NodataSight>(i % 3);
      const auto viewshed = maker->from(observer, options);
      ASSERT_TRUE(viewshed) << viewshed.error().describe();
      sweeps += viewshed->method == ViewshedMethod::sweep;
      compare(place, observer, options, *viewshed, std::string(family.name) + " " + std::to_string(i), tally);
    }
    EXPECT_EQ(tally.wrong, 0u) << family.name;
    printf("%-20s %2d sweeps, %llu cells, rays %.3f, seen %.3f unknown %.3f wrong %llu\n",
           std::string(family.name).c_str(), sweeps, (unsigned long long)tally.cells,
           double(tally.rays) / tally.cells, double(tally.seen) / tally.cells,
           double(tally.unknown) / tally.cells, (unsigned long long)tally.wrong);
  }
}

TEST(Viewshed, ValuesOfTheSweepAreThoseOfTheRays) {
  Random random(2);
  for (const RasterFamily& family : rasterFamilies()) {
    const Place place(family.make(31, 36, 5));
    const auto maker = ViewshedMaker::make(place.model, *place.earth, place.grid);
    ASSERT_TRUE(maker);
    for (int i = 0; i < 12; ++i) {
      const ViewshedObserver observer = randomObserver(place, random, i);
      ViewshedOptions options;
      options.value = i % 2 == 0 ? ViewshedValue::leastHeight : ViewshedValue::horizon;
      options.nodata = static_cast<NodataSight>(i / 2 % 3);
      const auto sweep = maker->from(observer, options);
      options.method = ViewshedMethod::rays;
      const auto rays = maker->from(observer, options);
      ASSERT_TRUE(sweep && rays);
      ASSERT_EQ(sweep->cells, rays->cells) << family.name << " " << i;
      for (std::size_t c = 0; c < rays->cells.size(); ++c) {
        const float a = sweep->values[c], b = rays->values[c];
        if (std::isnan(b)) {
          ASSERT_TRUE(std::isnan(a));
        } else if (a != b) {
          ASSERT_NEAR(a, b, 1e-4 + 1e-5 * std::fabs(b))
              << family.name << " " << i << ": cell " << c % rays->columns << ", " << c / rays->columns
              << " of " << observer.plan.x << ", " << observer.plan.y;
        }
      }
    }
  }
}

}  // namespace
}  // namespace arete

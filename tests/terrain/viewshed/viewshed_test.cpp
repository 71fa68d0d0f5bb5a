// SPDX-License-Identifier: GPL-3.0-or-later
//
// Viewsheds cell by cell against the scan of every cell below each line, which passes nothing over and knows
// nothing of skylines.
#include "terrain/viewshed/viewshed.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <string>

#include "datasets/families.h"
#include "datasets/random.h"
#include "terrain/builder/build.h"
#include "terrain/viewshed/many.h"
#include "terrain/viewshed_cells.h"

namespace arete::test {
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
    CellTally tally;
    for (int i = 0; i < 30; ++i) {
      const ViewshedObserver observer = randomObserver(place, random, i);
      ViewshedOptions options;
      options.targetHeight = i % 3 == 0 ? 1.5 : 0;
      options.nodata = static_cast<NodataSight>(i % 3);
      const auto viewshed = maker->from(observer, options);
      ASSERT_TRUE(viewshed) << viewshed.error().describe();
      expectCells(*viewshed,
                  {*place.earth, *place.scan, *place.grid, place.model.georeference.verticalUnitMetres},
                  observer, options, std::string(family.name) + " " + std::to_string(i), tally);
    }
    EXPECT_EQ(tally.wrong, 0u) << family.name;
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

TEST(Viewshed, HorizonsFromTheGroundOnADiagonalAreOfTheTerrainBeyond) {
  Random random(12);
  const Place place(rasterFamilies()[3].make(40, 44, 6));
  const auto maker = ViewshedMaker::make(place.model, *place.earth, place.grid);
  for (int i = 0; i < 40; ++i) {
    const double x = random.between(2, 12), y = x + 29;  // on it but for rounding
    const ViewshedObserver observer{{x, y}, place.grid->at({x, y})};
    ViewshedOptions options;
    options.value = ViewshedValue::horizon;
    options.method = ViewshedMethod::rays;
    const auto rays = maker->from(observer, options);
    ASSERT_TRUE(rays);
    const Vec2 to{double(random.below(40)), double(random.below(44))};
    const double length = place.earth->track(observer.plan, to)->points.back().distance;
    double steepest = -HUGE_VAL;
    for (int k = 1; k <= 20000; ++k) {
      const double t = k / 20000.0, z = place.grid->at({x + t * (to.x - x), y + t * (to.y - y)});
      steepest = std::max(steepest, (z - observer.height) / (t * length));
    }
    const float value =
        rays->values[static_cast<std::size_t>(to.y) * rays->columns + static_cast<std::size_t>(to.x)];
    EXPECT_NEAR(value, steepest, 1e-5 + 0.01 * std::fabs(steepest)) << x << " to " << to.x << ", " << to.y;
  }
}

TEST(Viewshed, IsTheSameForAnyNumberOfThreadsAndStopsWhenTold) {
  const Place place(rasterFamilies()[3].make(150, 130, 9));
  const auto maker = ViewshedMaker::make(place.model, *place.earth, place.grid);
  const Vec2 plan{70.25, 61};
  const ViewshedObserver observer{plan, place.grid->at(plan) + 3};
  RunContext one;
  one.threads = 1;
  ViewshedOptions options;
  options.value = ViewshedValue::horizon;
  for (const ViewshedMethod method : {ViewshedMethod::sweep, ViewshedMethod::rays}) {
    options.method = method;
    const auto first = maker->from(observer, options, one);
    ASSERT_TRUE(first);
    for (const int threads : {2, 4}) {
      RunContext many;
      many.threads = threads;
      const auto other = maker->from(observer, options, many);
      EXPECT_EQ(other->cells, first->cells);
      EXPECT_EQ(0, std::memcmp(other->values.data(), first->values.data(), first->values.size() * 4));
    }
    std::atomic<bool> stop = true;
    RunContext stopped;
    stopped.cancel = &stop;
    const auto none = maker->from(observer, options, stopped);
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error().code, ErrorCode::interrupted);
  }
}

TEST(Viewshed, FieldsLeaveOutWhatIsBeyondThem) {
  Random random(4);
  for (const RasterFamily& family : rasterFamilies()) {
    const Place place(family.make(40, 33, 2));
    const auto maker = ViewshedMaker::make(place.model, *place.earth, place.grid);
    const double far = place.earth->track({0, 0}, {39, 32})->points.back().distance;
    for (int i = 0; i < 12; ++i) {
      const ViewshedObserver observer = randomObserver(place, random, i);
      ViewshedOptions options;
      options.nodata = NodataSight::clear;
      options.field.leastMetres = i % 2 == 0 ? 0.1 * far : 0;
      options.field.greatestMetres = i % 3 == 0 ? far : 0.4 * far;
      options.field.fromAzimuth = 45.0 * i - 90;
      options.field.azimuthSpan = i % 4 == 0 ? 360 : 30.0 * (i + 1);
      if (i % 2 == 1) options.field.lowest = -10, options.field.highest = 1;
      const auto sweep = maker->from(observer, options);
      options.method = ViewshedMethod::rays;
      const auto rays = maker->from(observer, options);
      ASSERT_TRUE(sweep && rays);
      EXPECT_EQ(sweep->cells, rays->cells) << family.name << " " << i;
      EXPECT_GT(rays->outside, 0u);
    }
  }
}

TEST(Viewshed, OfPlacesHasTheAnswersOfTheGridAndOfLinesBetween) {
  Random random(7);
  const Place place(rasterFamilies()[3].make(33, 28, 4));
  const auto maker = ViewshedMaker::make(place.model, *place.earth, place.grid);
  const ViewshedObserver observer = randomObserver(place, random, 1);
  const auto whole = maker->from(observer);
  std::vector<Vec2> places;
  for (std::uint32_t i = 0; i < 33 * 28; ++i) places.push_back({double(i % 33), double(i / 33)});
  for (int i = 0; i < 400; ++i) places.push_back({random.between(-2, 34), random.between(-2, 29)});
  places.push_back({NAN, 3});
  const auto of = maker->of(places, observer);
  ASSERT_TRUE(of) << of.error().describe();
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i < whole->cells.size()) {
      EXPECT_EQ(of->cells[i], whole->cells[i]) << i;
      continue;
    }
    const double z = place.grid->at(places[i]);
    if (std::isnan(z)) {
      EXPECT_EQ(of->cells[i], ViewshedCell::outside) << i;
      continue;
    }
    const SightLine line(*place.earth->track(observer.plan, places[i]), observer.height, z);
    EXPECT_EQ(of->cells[i], cellOf(place.scan->answer(line, {}).verdict)) << i;
  }
}

TEST(Viewshed, OfManyCountsWhoSeesACellAndNamesTheNearest) {
  Random random(6);
  const Place place(rasterFamilies()[3].make(40, 33, 2));
  const auto maker = ViewshedMaker::make(place.model, *place.earth, place.grid);
  std::vector<ViewshedObserver> observers;
  for (int i = 0; i < 9; ++i) observers.push_back(randomObserver(place, random, i));
  observers.push_back(observers[3]);  // equally near
  std::vector<ViewshedSite> sites;
  for (const ViewshedObserver& observer : observers) sites.push_back({observer, {}});
  const auto all = viewshedOfMany(*maker, place.model, *place.earth, sites, {}, true);
  ASSERT_TRUE(all);
  std::vector<std::uint16_t> counts(all->count.size(), 0), server(counts.size(), 0);
  std::vector<float> nearest(counts.size(), HUGE_VALF);
  for (std::size_t i = 0; i < observers.size(); ++i) {
    const auto one = maker->from(observers[i]);
    for (std::size_t c = 0; c < counts.size(); ++c) {
      if (one->cells[c] != ViewshedCell::seen) continue;
      ++counts[c];
      const Vec2 cell{double(c % 40), double(c / 40)};
      const auto distance =
          static_cast<float>(place.earth->track(observers[i].plan, cell)->points.back().distance);
      if (!(distance < nearest[c])) continue;
      nearest[c] = distance;
      server[c] = static_cast<std::uint16_t>(i + 1);
    }
  }
  EXPECT_EQ(all->count, counts);
  EXPECT_EQ(all->server, server);
}

TEST(Viewshed, OfManyHasNoNumberWhereItIsNotCertain) {
  Random random(16);
  const Place place(rasterFamilies()[3].make(40, 33, 2));
  const auto maker = ViewshedMaker::make(place.model, *place.earth, place.grid);
  std::vector<ViewshedSite> sites;
  for (int i = 0; i < 5; ++i) sites.push_back({randomObserver(place, random, i), {}});
  ViewshedOptions options;
  options.maxError = 5;
  const auto exact = viewshedOfMany(*maker, place.model, *place.earth, sites, {}, true);
  const auto within = viewshedOfMany(*maker, place.model, *place.earth, sites, options, true);
  ASSERT_TRUE(exact && within);
  std::vector<bool> isUndecided(exact->count.size()), isUnknown(exact->count.size());
  for (const ViewshedSite& site : sites) {
    const auto one = maker->from(site.observer, options);
    for (std::size_t c = 0; c < isUndecided.size(); ++c) {
      if (one->cells[c] == ViewshedCell::undecided) isUndecided[c] = true;
      if (one->cells[c] == ViewshedCell::unknown) isUnknown[c] = true;
    }
  }
  std::size_t undecided = 0, numbers = 0;
  for (std::size_t c = 0; c < isUndecided.size(); ++c) {
    const std::uint16_t mark = isUndecided[c] ? ViewshedOfMany::kUndecided : ViewshedOfMany::kUnknown;
    EXPECT_EQ(within->count[c], isUndecided[c] || isUnknown[c] ? mark : exact->count[c]) << c;
    if (within->server[c] < ViewshedOfMany::kUnknown) {
      ++numbers;
      EXPECT_EQ(within->server[c], exact->server[c]) << c;
    }
    undecided += within->server[c] == ViewshedOfMany::kUndecided;
  }
  EXPECT_GT(undecided, 0u);
  EXPECT_GT(numbers, 0u);
}

TEST(Viewshed, WithinAToleranceWhatIsCertainIsRight) {
  Random random(7);
  const Place place(rasterFamilies()[3].make(45, 52, 8));
  const auto maker = ViewshedMaker::make(place.model, *place.earth, place.grid);
  for (int i = 0; i < 4; ++i) {
    const ViewshedObserver observer = randomObserver(place, random, i);
    ViewshedOptions options;
    options.maxError = 5;
    const auto within = maker->from(observer, options), exact = maker->from(observer);
    ASSERT_TRUE(within && exact);
    for (std::size_t c = 0; c < exact->cells.size(); ++c)
      if (within->cells[c] != ViewshedCell::undecided) {
        ASSERT_EQ(within->cells[c], exact->cells[c]) << c;
      }
  }
}

TEST(Viewshed, SaysWhatIsWrongWithOptions) {
  const Place place(rasterFamilies()[3].make(20, 20, 2));
  const auto maker = ViewshedMaker::make(place.model, *place.earth, place.grid);
  ViewshedOptions options;
  options.targetHeight = -1;
  EXPECT_EQ(maker->from({{3, 3}, 10}, options).error().code, ErrorCode::usage);
  options = {};
  options.field.lowest = 20, options.field.highest = 10;
  EXPECT_EQ(maker->from({{3, 3}, 10}, options).error().code, ErrorCode::usage);
  options = {};
  options.method = ViewshedMethod::sweep;
  EXPECT_EQ(maker->from({{-3, 3}, 1e6}, options).error().code, ErrorCode::unsupported);
}

}  // namespace
}  // namespace arete::test

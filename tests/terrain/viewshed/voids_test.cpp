// SPDX-License-Identifier: GPL-3.0-or-later
//
// Viewsheds where NODATA is scattered all over, from places that are beside it, at its border and in it: cell
// by cell against one ray for each, and against the oracle. ARETE_FULL=1 takes fifteen times as many.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <string>

#include "datasets/random.h"
#include "terrain/sight_pairs.h"
#include "terrain/viewshed/viewshed.h"

namespace arete {
namespace {

constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();

struct Scatter {
  const char* name;
  /// Whether the sample is one, where `share` of them should be.
  bool (*isVoid)(std::uint64_t seed, std::uint32_t column, std::uint32_t row, double share);
};

double unitAt(std::uint64_t seed, std::uint32_t column, std::uint32_t row) {
  return Random::toUnit(Random::at(seed, column, row));
}

const Scatter kScatters[] = {
    {"single samples", [](std::uint64_t seed, std::uint32_t column, std::uint32_t row,
                          double share) { return unitAt(seed, column, row) < share; }},
    {"patches with single samples",
     [](std::uint64_t seed, std::uint32_t column, std::uint32_t row, double share) {
       return unitAt(seed, column / 4, row / 3) < share || unitAt(seed + 1, column, row) < share / 10;
     }},
    {"stretches of rows, columns and diagonals",
     [](std::uint64_t seed, std::uint32_t column, std::uint32_t row, double share) {
       return unitAt(seed, column / 5, row) < share / 3 || unitAt(seed + 1, column, row / 5) < share / 3 ||
              unitAt(seed + 2, column + 100 - row, column / 5) < share / 3;
     }},
};

RasterHeightfield scattered(const Scatter& scatter, double share, std::uint64_t seed) {
  RasterHeightfield field;
  field.columns = 37 + static_cast<std::uint32_t>(seed % 9);
  field.rows = 45 - static_cast<std::uint32_t>(seed % 7);
  for (std::uint32_t row = 0; row < field.rows; ++row)
    for (std::uint32_t column = 0; column < field.columns; ++column) {
      const double hills = 60 * std::sin(column * 0.31 + double(seed)) * std::cos(row * 0.23),
                   rough = 25 * unitAt(seed + 7, column, row);
      // Every other terrain is of whole metres, flat in places: lines along it touch.
      const double z = seed % 2 == 0 ? hills + rough : std::floor((hills + rough) / 10);
      field.heights.push_back(scatter.isVoid(seed, column, row, share) ? kVoid : z);
    }
  return field;
}

TerrainModel modelOf(const RasterHeightfield& field) {
  TerrainModel model;
  model.columns = field.columns;
  model.rows = field.rows;
  model.georeference = field.georeference;
  return model;
}

/// Beside NODATA more often than not: on samples, lattice lines and diagonals, anywhere.
ViewshedObserver observerBeside(const RasterHeightfield& field, const SightGrid& grid, Random& random) {
  Vec2 plan;
  for (int tries = 0; tries < 200; ++tries) {
    plan = {double(random.below(field.columns)), double(random.below(field.rows))};
    if (std::isnan(field.at(static_cast<std::uint32_t>(plan.x), static_cast<std::uint32_t>(plan.y)))) break;
  }
  plan.x += double(random.below(3)) - 1;
  plan.y += double(random.below(3)) - 1;
  const double f = random.below(8) / 8.0, g = random.unit();
  const std::array<Vec2, 7> offsets{Vec2{0, 0}, {0, 0}, {f, 0}, {0, g}, {g, g}, {g, 1 - g}, {g, f}};
  const Vec2 off = offsets[random.below(7)];
  plan.x = std::clamp(plan.x + off.x, 0.0, field.columns - 1.0);
  plan.y = std::clamp(plan.y + off.y, 0.0, field.rows - 1.0);
  const double ground = grid.at(plan), heights[] = {2, 0, 0.25, 30, 1e-5};
  return {plan, (std::isnan(ground) ? random.between(-20, 60) : ground) + heights[random.below(5)]};
}

SightVerdict verdictOf(ViewshedCell cell) {
  return cell == ViewshedCell::seen     ? SightVerdict::visible
         : cell == ViewshedCell::hidden ? SightVerdict::blocked
                                        : SightVerdict::unknown;
}

struct Tally {
  std::uint64_t cells = 0, wrong = 0, sweeps = 0, rays = 0, rounded = 0, viewsheds = 0;
};

void compareWithOracle(const RasterHeightfield& field, const SightEarth& earth, const Viewshed& viewshed,
                       const ViewshedObserver& observer, const ViewshedOptions& options, Random& random,
                       const std::string& what, Tally& tally) {
  const test::SightOracle oracle(field);
  for (std::size_t at = random.below(7); at < viewshed.cells.size(); at += 7) {
    const double z = field.heights[at];
    if (std::isnan(z)) continue;
    test::SightPair pair;
    const Vec2 to{double(at % field.columns), double(at / field.columns)};
    pair.track = *earth.track(observer.plan, to);
    pair.from = observer.height;
    pair.to = z + options.targetHeight;
    const test::OracleAnswer truth = oracle.ask(pair.track, pair.from, pair.to);
    const SightOptions asked{.nodata = options.nodata, .wantsClearance = false, .wantsObstruction = false};
    SightAnswer answer;
    answer.verdict = verdictOf(viewshed.cells[at]);
    test::Rounding rounding{};
    const std::string wrong = test::wrongBeyondRounding(oracle, pair, asked, answer, truth, rounding);
    ++tally.cells;
    tally.rounded += rounding != test::Rounding::none;
    if (!wrong.empty() && tally.wrong++ < 5) ADD_FAILURE() << what << ": " << wrong << "; " << describe(pair);
  }
}

template <class Body>
void forScatters(const Body& body) {
  const std::uint64_t seeds = std::getenv("ARETE_FULL") != nullptr ? 30 : 2;
  for (const Scatter& scatter : kScatters)
    for (const double share : {0.01, 0.08, 0.3, 0.6})
      for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        Random random(seed * 1000 + static_cast<std::uint64_t>(share * 100));
        body(scattered(scatter, share, seed), random,
             std::string(scatter.name) + ", share " + std::to_string(share) + ", seed " +
                 std::to_string(seed));
      }
}

TEST(ViewshedVoids, TheSweepGivesTheAnswersOfRaysAndOfTheOracle) {
  Tally tally;
  forScatters([&](const RasterHeightfield& field, Random& random, const std::string& name) {
    const TerrainModel model = modelOf(field);
    const auto grid = std::make_shared<const SightGrid>(field.columns, field.rows, field.heights);
    const auto earth = makePlaneEarth(model);
    const auto maker = ViewshedMaker::make(model, *earth, grid);
    ASSERT_TRUE(maker);
    for (int i = 0; i < 12; ++i) {
      const ViewshedObserver observer = observerBeside(field, *grid, random);
      ViewshedOptions options;
      options.targetHeight = i % 4 == 0 ? 1.5 : 0;
      options.nodata = static_cast<NodataSight>(i % 3);
      const std::string what = name + ", observer " + std::to_string(i);
      const auto viewshed = maker->from(observer, options);
      options.method = ViewshedMethod::rays;
      const auto rays = maker->from(observer, options);
      ASSERT_TRUE(viewshed && rays) << what;
      ++tally.viewsheds;
      tally.sweeps += viewshed->method == ViewshedMethod::sweep;
      tally.rays += viewshed->method == ViewshedMethod::sweep ? viewshed->rays : 0;
      for (std::size_t at = 0; at < rays->cells.size(); ++at)
        if (viewshed->cells[at] != rays->cells[at] && tally.wrong++ < 5)
          ADD_FAILURE() << what << ": cell " << at % field.columns << ", " << at / field.columns << " is "
                        << int(viewshed->cells[at]) << ", by a ray " << int(rays->cells[at]) << "; from "
                        << observer.plan.x << ", " << observer.plan.y << ", " << observer.height;
      compareWithOracle(field, *earth, *viewshed, observer, options, random, what, tally);
    }
  });
  EXPECT_EQ(tally.wrong, 0u);
  EXPECT_GT(tally.sweeps * 10, tally.viewsheds * 7);
  RecordProperty("cells held against the oracle", std::to_string(tally.cells));
  RecordProperty("of these, right but for rounding", std::to_string(tally.rounded));
  RecordProperty("sweeps", std::to_string(tally.sweeps) + " of " + std::to_string(tally.viewsheds));
  RecordProperty("cells that sweeps left to rays", std::to_string(tally.rays));
}

TEST(ViewshedVoids, ValuesOfTheSweepAreThoseOfRays) {
  forScatters([&](const RasterHeightfield& field, Random& random, const std::string& name) {
    const TerrainModel model = modelOf(field);
    const auto grid = std::make_shared<const SightGrid>(field.columns, field.rows, field.heights);
    const auto earth = makePlaneEarth(model);
    const auto maker = ViewshedMaker::make(model, *earth, grid);
    ASSERT_TRUE(maker);
    for (int i = 0; i < 6; ++i) {
      const ViewshedObserver observer = observerBeside(field, *grid, random);
      ViewshedOptions options;
      options.value = i % 2 == 0 ? ViewshedValue::leastHeight : ViewshedValue::horizon;
      options.nodata = static_cast<NodataSight>(i / 2);
      const auto sweep = maker->from(observer, options);
      options.method = ViewshedMethod::rays;
      const auto rays = maker->from(observer, options);
      ASSERT_TRUE(sweep && rays);
      ASSERT_EQ(sweep->cells, rays->cells) << name << ", observer " << i;
      for (std::size_t at = 0; at < rays->cells.size(); ++at) {
        const float a = sweep->values[at], b = rays->values[at];
        if (options.value == ViewshedValue::leastHeight && rays->cells[at] == ViewshedCell::unknown) {
          ASSERT_TRUE(std::isnan(b));
        }
        if (std::isnan(b)) {
          ASSERT_TRUE(std::isnan(a));
        } else if (a != b) {
          ASSERT_NEAR(a, b, 1e-4 + 1e-5 * std::fabs(b))
              << name << ", observer " << i << ": cell " << at % field.columns << ", " << at / field.columns
              << " of " << observer.plan.x << ", " << observer.plan.y << ", " << observer.height;
        }
      }
    }
  });
}

}  // namespace
}  // namespace arete

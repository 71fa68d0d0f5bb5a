// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a camera has of a model in pages, against what went wrong in other programs: holes where pages are
// late or were given back for others, budgets that are exceeded, pages that are read and dropped in turn
// without end, readers that stand still before their budget is used, and pictures that depend on where the
// camera was before.
#include "io/query/pages/resident_pages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "datasets/families.h"
#include "datasets/random.h"
#include "engine/criteria/view_error.h"
#include "engine/cut/cut.h"
#include "io/amt_fixture.h"
#include "io/io_fixture.h"
#include "io/query/pages/pages_fixture.h"
#include "io/query/pages/view_demand.h"
#include "terrain/model/plan_box.h"

namespace arete {
namespace {

using test::built;
using test::got;
using test::kAnyBytes;
using test::settled;
using test::TemporaryFolder;

/// One file of mountains in pages, and its model.
struct Filed {
  Filed() {
    const auto& families = rasterFamilies();
    const auto fractal = std::ranges::find(families, std::string_view("fractal"), &RasterFamily::name);
    whole = built(build(fractal->make(420, 380, 5)));
    const Status written = writeAmt(folder.file("model.amt"), whole, {}, {.isPaged = true});
    if (!written) throw std::runtime_error(written.error().describe());
    for (const PageNeed& need : got(file().pagesFor({}))) bytes += need.bytes.size();
  }
  AmtFile file() const { return *openAmt(folder.file("model.amt")); }
  TerrainPages open(std::uint64_t mostBytes = TerrainPages::kUsualBytes) const {
    return *TerrainPages::open(file(), mostBytes);
  }
  TemporaryFolder folder;
  TerrainModel whole;
  std::uint64_t bytes = 0;  // of all pages
};

const Filed& mountains() {
  static const Filed filed;
  return filed;
}

/// From a place over the terrain, near the ground or far above it.
View viewFrom(double x, double y, double above, double pitch = -0.5) {
  const TerrainModel& model = mountains().whole;
  const Vec3 ground = model.mt.metric().toMetric({x * model.columns, y * model.rows, 0});
  const double side = std::abs(model.mt.metric().scale.x) * model.columns;
  View view;
  view.eye = {ground.x, ground.y,
              model.mt.largestError() * std::abs(model.mt.metric().scale.z) + above * side};
  view.forward = {0.3, 1, pitch};
  view.widthPixels = 640;
  view.heightPixels = 400;
  return view;
}

PageDemand demandFor(const View& view, const TerrainPages& pages, double pixels = 2) {
  return demandOf({.view = view, .pixels = pixels}, *pages.outline());
}

double areaOf(const TerrainModel& model, const Cut& cut) {
  double area = 0;
  for (const auto& t : cut.triangles) {
    std::array<Vec3, 3> p;
    for (std::size_t i = 0; i < 3; ++i) p[i] = model.mt.position(VertexId(cut.vertices[t[i]]));
    const double twice = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
    EXPECT_GT(twice, 0) << "a triangle is turned over or flat";
    area += twice / 2;
  }
  return area;
}

Cut cutOf(const TerrainModel& model, const View& view, double pixels = 2) {
  const ViewError error({.view = view, .pixels = pixels}, model.mt.metric());
  return *takeCut(model.mt, error, {.method = CutMethod::saturated});
}

/// Places and triangles of the cut of a part, whatever their numbers.
std::vector<std::array<double, 9>> trianglesOf(const TerrainModel& model, const View& view) {
  const Cut cut = cutOf(model, view);
  std::vector<std::array<double, 9>> all;
  for (const auto& t : cut.triangles) {
    std::array<double, 9> one{};
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 p = model.mt.position(VertexId(cut.vertices[t[i]]));
      one[3 * i] = p.x, one[3 * i + 1] = p.y, one[3 * i + 2] = p.z;
    }
    all.push_back(one);
  }
  std::ranges::sort(all);
  return all;
}

TEST(ResidentPages, HaveAllThatAPictureNeedsAfterOneStepThatMayReadIt) {
  TerrainPages pages = mountains().open();
  Random random(3);
  for (int i = 0; i < 12; ++i) {
    const View view = viewFrom(random.between(0, 1), random.between(0, 1), random.between(0.001, 0.8));
    const auto step = got(pages.step(demandFor(view, pages), kAnyBytes));
    EXPECT_EQ(step.coarseness, 1);
    EXPECT_EQ(step.missingPages, 0u);
    EXPECT_TRUE(cutOf(*step.part, view).missing.empty()) << i;
    EXPECT_EQ(got(missingInView(step.part->mt, {.view = view, .pixels = 2})).missing, 0u);
  }
}

TEST(ResidentPages, CoverTheWholePlanInEveryStepWhilePagesAreLate) {
  const Filed& filed = mountains();
  const double whole = areaOf(filed.whole, frontOfPrefix(filed.whole.mt, 0));
  TerrainPages pages = filed.open(filed.bytes / 3);
  Random random(4);
  for (int i = 0; i < 60; ++i) {
    const View view = viewFrom(random.between(0, 1), random.between(0, 1), random.between(0.001, 0.5));
    const auto step = got(pages.step(demandFor(view, pages), 4096));
    const double area = areaOf(*step.part, cutOf(*step.part, view));
    EXPECT_NEAR(area, whole, 1e-9 * whole) << i;
  }
}

TEST(ResidentPages, CoverThePlanWhenTheCameraRisesAfterALongTimeNearTheGround) {
  const Filed& filed = mountains();
  const double whole = areaOf(filed.whole, frontOfPrefix(filed.whole.mt, 0));
  TerrainPages pages = filed.open(filed.bytes / 8);
  for (int i = 0; i < 20; ++i)
    ASSERT_TRUE(pages.step(demandFor(viewFrom(0.02 * i, 0.5, 0.001, -0.1), pages), kAnyBytes));
  const View far = viewFrom(0.5, -0.5, 1.5, -0.8);
  const auto step = got(pages.step(demandFor(far, pages), 1));
  EXPECT_NEAR(areaOf(*step.part, cutOf(*step.part, far)), whole, 1e-9 * whole);
}

TEST(ResidentPages, StayWithinTheirBudget) {
  const Filed& filed = mountains();
  for (const std::uint64_t budget : {filed.bytes / 20, filed.bytes / 6, filed.bytes / 2}) {
    TerrainPages pages = filed.open(budget);
    Random random(5);
    for (int i = 0; i < 40; ++i) {
      const View view = viewFrom(random.between(0, 1), random.between(0, 1), random.between(0.001, 0.5));
      const auto step = got(pages.step(demandFor(view, pages, 0.5), i % 2 == 0 ? kAnyBytes : 20'000));
      EXPECT_LE(step.residentBytes, budget) << i;
    }
  }
}

TEST(ResidentPages, ReadNothingMoreForACameraThatStandsStillHoweverSmallTheBudget) {
  const Filed& filed = mountains();
  for (const std::uint64_t part : {30u, 10u, 3u, 1u}) {
    TerrainPages pages = filed.open(filed.bytes / part);
    const View view = viewFrom(0.4, 0.1, 0.02);
    PageDemand demand = demandFor(view, pages, 0.3);
    demand.ahead = demandFor(viewFrom(0.6, 0.3, 0.02), pages, 0.3).needed;
    const auto last = settled(pages, demand, 30'000);
    for (int i = 0; i < 3; ++i) {
      const auto step = got(pages.step(demand, kAnyBytes));
      EXPECT_EQ(step.bytes, 0u);
      EXPECT_FALSE(step.isNew);
      EXPECT_EQ(step.coarseness, last.coarseness);
    }
  }
}

TEST(ResidentPages, ComeToTheirEndByStepsOfOneByteToo) {
  TerrainPages pages = mountains().open();
  const View view = viewFrom(0.5, 0.2, 0.05);
  PageDemand demand = demandFor(view, pages);
  demand.around = {};
  const auto step = settled(pages, demand, 1);
  EXPECT_EQ(step.coarseness, 1);
  EXPECT_EQ(step.missingBytes, 0u);
  EXPECT_TRUE(cutOf(*step.part, view).missing.empty());
}

TEST(ResidentPages, LeadToOnePictureWhereverTheCameraWasBefore) {
  const Filed& filed = mountains();
  const View view = viewFrom(0.3, 0.3, 0.03);
  for (const std::uint64_t budget : {filed.bytes / 12, filed.bytes}) {
    TerrainPages fresh = filed.open(budget);
    const auto expected = settled(fresh, demandFor(view, fresh, 0.7), kAnyBytes);
    TerrainPages travelled = filed.open(budget);
    Random random(6);
    for (int i = 0; i < 15; ++i)
      ASSERT_TRUE(travelled.step(
          demandFor(viewFrom(random.between(0, 1), random.between(0, 1), 0.02), travelled, 0.7), 50'000));
    const auto step = settled(travelled, demandFor(view, travelled, 0.7), 10'000);
    EXPECT_EQ(step.coarseness, expected.coarseness);
    if (step.coarseness == 1) {
      EXPECT_TRUE(cutOf(*step.part, view, 0.7).missing.empty()) << "the part may have more than is needed";
    } else {
      EXPECT_EQ(trianglesOf(*step.part, view), trianglesOf(*expected.part, view));
    }
  }
}

TEST(ResidentPages, AreTheSameForAnyNumberOfThreads) {
  const Filed& filed = mountains();
  TerrainPages one = filed.open(filed.bytes / 5), four = filed.open(filed.bytes / 5);
  Random random(7);
  for (int i = 0; i < 12; ++i) {
    const View view = viewFrom(random.between(0, 1), random.between(0, 1), random.between(0.001, 0.3));
    const auto a = got(one.step(demandFor(view, one), 40'000, {.progress = {}, .threads = 1}));
    const auto b = got(four.step(demandFor(view, four), 40'000, {.progress = {}, .threads = 4}));
    EXPECT_EQ(a.bytes, b.bytes);
    EXPECT_EQ(a.residentBytes, b.residentBytes);
    EXPECT_TRUE(std::ranges::equal(a.part->mt.arrays().link, b.part->mt.arrays().link));
  }
}

TEST(ResidentPages, OfAStepAreNoMoreBytesThanItMayReadOrOnePage) {
  const Filed& filed = mountains();
  TerrainPages pages = filed.open();
  std::uint64_t largest = 0;
  for (const PageNeed& need : got(filed.file().pagesFor({})))
    largest = std::max<std::uint64_t>(largest, need.bytes.size());
  Random random(8);
  for (int i = 0; i < 40; ++i) {
    const View view = viewFrom(random.between(0, 1), random.between(0, 1), random.between(0.001, 0.3));
    EXPECT_LE(got(pages.step(demandFor(view, pages), 10'000)).bytes,
              std::max<std::uint64_t>(largest, 10'000));
  }
}

TEST(ResidentPages, ReadAheadOfACameraThatMovesSoThatLessIsMissingThen) {
  const Filed& filed = mountains();
  const View from = viewFrom(0.2, 0.2, 0.02), to = viewFrom(0.6, 0.5, 0.02);
  std::array<std::uint64_t, 2> read{};
  for (const std::size_t expects : {0u, 1u}) {
    TerrainPages pages = filed.open();
    PageDemand demand = demandFor(from, pages);
    if (expects == 1) demand.ahead = demandFor(to, pages).needed;
    ASSERT_TRUE(pages.step(demand, kAnyBytes));
    ASSERT_TRUE(pages.step(demand, kAnyBytes));
    read[expects] = got(pages.step(demandFor(to, pages), kAnyBytes)).bytes;
  }
  EXPECT_LT(read[1], read[0] / 2);
}

}  // namespace
}  // namespace arete

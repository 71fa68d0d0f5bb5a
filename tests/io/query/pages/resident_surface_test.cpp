// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a camera has of a surface in pages, against what went wrong in other programs: cracks between parts of
// two resolutions, levels that no longer come after some minutes of turning a model, and budgets that are
// exceeded.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "datasets/random.h"
#include "engine/criteria/view_error.h"
#include "engine/cut/cut.h"
#include "io/amt_fixture.h"
#include "io/io_fixture.h"
#include "io/query/pages/pages_fixture.h"
#include "io/query/pages/resident_pages.h"
#include "io/query/pages/view_demand.h"
#include "surface/builder/build.h"
#include "surface/painted_rock.h"

namespace arete {
namespace {

using test::got;
using test::kAnyBytes;
using test::settled;
using test::TemporaryFolder;

/// One file of a rock in pages, and its model.
struct FiledRock {
  FiledRock() {
    whole = got(buildSurface(shapes::paintedRock(28'000, {})));
    const Status written = writeSurfaceAmt(folder.file("rock.amt"), whole, {}, {.isPaged = true});
    if (!written) throw std::runtime_error(written.error().describe());
    const auto pages = got(file().pagesFor({}));
    count = pages.size();
    for (const PageNeed& need : pages) bytes += need.bytes.size();
  }
  PagedSurfaceFile file() const {
    return got(PagedSurfaceFile::open(got(AmtContainer::open(folder.file("rock.amt")))));
  }
  SurfacePages open(std::uint64_t mostBytes = SurfacePages::kUsualBytes) const {
    return got(SurfacePages::open(file(), mostBytes));
  }
  TemporaryFolder folder;
  SurfaceModel whole;
  std::uint64_t count = 0, bytes = 0;  // of all pages
};

const FiledRock& rock() {
  static const FiledRock filed;
  return filed;
}

/// From a place around the rock, at a distance of its middle in diagonals.
View aroundRock(double turn, double height, double distance) {
  const double far = distance * rock().whole.diagonal;
  View view;
  view.eye = {far * std::cos(turn), far * std::sin(turn), height * far};
  view.forward = -1.0 * view.eye;
  view.widthPixels = 640;
  view.heightPixels = 400;
  view.verticalFieldOfView = 0.6;
  return view;
}
View anyView(Random& random) {
  return aroundRock(random.between(0, 6.28), random.between(-1, 1), random.between(0.3, 3));
}

PageDemand demandOfRock(const View& view, const SurfacePages& pages, double pixels = 1) {
  return demandOf({.view = view, .pixels = pixels}, *pages.outline());
}

Cut cutOfRock(const SurfaceModel& model, const View& view, double pixels = 1) {
  const ViewError error({.view = view, .pixels = pixels}, model.mt.metric());
  return got(takeCut(model.mt, error, {.method = CutMethod::saturated}));
}

/// What is open about a front of a closed surface, or nothing: every edge is met once each way.
std::string whyNotClosed(const Cut& cut) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : cut.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      if (++edges[{t[i], t[(i + 1) % 3]}] > 1) return "an edge has two triangles on one side";
  for (const auto& [edge, count] : edges)
    if (!edges.contains({edge.second, edge.first})) return "an edge has one triangle";
  return {};
}

TEST(ResidentSurface, HasAllThatAPictureNeedsAfterOneStepThatMayReadIt) {
  ASSERT_GT(rock().count, 8u) << "there is nothing to read in part";
  SurfacePages pages = rock().open();
  EXPECT_LT(pages.outline()->mt.nodeCount(), rock().whole.mt.nodeCount());
  Random random(3);
  for (int i = 0; i < 10; ++i) {
    SCOPED_TRACE("seed 3, view " + std::to_string(i));
    const View view = anyView(random);
    const auto step = got(pages.step(demandOfRock(view, pages), kAnyBytes));
    EXPECT_EQ(step.coarseness, 1);
    EXPECT_EQ(step.missingPages, 0u);
    EXPECT_TRUE(cutOfRock(*step.part, view).missing.empty());
    EXPECT_EQ(got(missingInView(step.part->mt, {.view = view, .pixels = 1})).missing, 0u);
    EXPECT_EQ(step.part->finestTriangles(), rock().whole.finestTriangles());
  }
}

TEST(ResidentSurface, OfACameraThatLooksAwayReadsNothingAndOfOneThatSeesAPartNotAll) {
  SurfacePages pages = rock().open();
  View away = aroundRock(0.5, 0.1, 2);
  away.forward = away.eye;
  const auto nothing = got(pages.step(demandOfRock(away, pages, 0.1), kAnyBytes));
  EXPECT_EQ(nothing.coarseness, 1);
  EXPECT_EQ(nothing.bytes, 0u);
  View narrow = aroundRock(0.5, 0.1, 2);
  narrow.forward = narrow.forward + Vec3{0, 0, 0.25 * rock().whole.diagonal};
  narrow.verticalFieldOfView = 0.01;
  const auto step = got(pages.step(demandOfRock(narrow, pages), kAnyBytes));
  EXPECT_EQ(step.coarseness, 1);
  EXPECT_GT(step.bytes, 0u);
  EXPECT_TRUE(cutOfRock(*step.part, narrow).missing.empty());
  // The rock is not much wider than the tiles of its pages; tests/cli/view/pages_test.cpp asks for half of a
  // scan.
  EXPECT_LT(step.residentBytes, rock().bytes);
}

TEST(ResidentSurface, IsClosedInEveryStepWhilePagesAreLate) {
  SurfacePages pages = rock().open(rock().bytes / 3);
  Random random(4);
  bool wasLate = false;
  for (int i = 0; i < 40; ++i) {
    SCOPED_TRACE("seed 4, step " + std::to_string(i));
    const View view = anyView(random);
    const auto step = got(pages.step(demandOfRock(view, pages, 0.3), 8192));
    const Cut cut = cutOfRock(*step.part, view, 0.3);
    wasLate = wasLate || !cut.missing.empty();
    EXPECT_EQ(whyNotClosed(cut), "");
    EXPECT_LE(step.residentBytes, rock().bytes / 3);
    if (i % 10 == 0) {
      EXPECT_TRUE(step.part->validate());
    }
  }
  EXPECT_TRUE(wasLate) << "no page was late, so that nothing was tested";
}

TEST(ResidentSurface, GetsFineAgainWhereverTheCameraWasBeforeAndHoweverLong) {
  const View view = aroundRock(1, 0.2, 0.8);
  for (const std::uint64_t budget : {rock().bytes / 6, rock().bytes}) {
    SurfacePages fresh = rock().open(budget);
    const auto expected = settled(fresh, demandOfRock(view, fresh), kAnyBytes);
    SurfacePages travelled = rock().open(budget);
    for (int i = 0; i < 60; ++i)
      ASSERT_TRUE(travelled.step(demandOfRock(aroundRock(0.4 * i, 0.3, 0.6), travelled), 30'000));
    const auto step = settled(travelled, demandOfRock(view, travelled), 10'000);
    EXPECT_EQ(step.coarseness, expected.coarseness);
    EXPECT_EQ(cutOfRock(*step.part, view).missing.empty(), cutOfRock(*expected.part, view).missing.empty());
    EXPECT_EQ(got(travelled.step(demandOfRock(view, travelled), kAnyBytes)).bytes, 0u);
  }
}

TEST(ResidentSurface, IsTheSameForAnyNumberOfThreads) {
  SurfacePages one = rock().open(rock().bytes / 4), four = rock().open(rock().bytes / 4);
  Random random(7);
  for (int i = 0; i < 8; ++i) {
    const View view = anyView(random);
    const auto a = got(one.step(demandOfRock(view, one), 40'000, {.progress = {}, .threads = 1}));
    const auto b = got(four.step(demandOfRock(view, four), 40'000, {.progress = {}, .threads = 4}));
    EXPECT_EQ(a.bytes, b.bytes);
    EXPECT_EQ(a.residentBytes, b.residentBytes);
    EXPECT_TRUE(std::ranges::equal(a.part->mt.arrays().link, b.part->mt.arrays().link));
    EXPECT_TRUE(a.part->wedgesOf == b.part->wedgesOf);
    EXPECT_TRUE(a.part->attributes == b.part->attributes);
  }
}

TEST(ResidentSurface, OfALevelHasItsErrorEverywhere) {
  SurfacePages pages = rock().open();
  const double error = 0.0002 * rock().whole.diagonal;
  const ViewDemand demand{.view = aroundRock(0, 0, 40), .pixels = 100, .error = error};
  const auto step = got(pages.step(demandOf(demand, *pages.outline()), kAnyBytes));
  EXPECT_EQ(step.missingBytes, 0u);
  const Cut cut = got(takeCut(step.part->mt, UniformError(error)));
  EXPECT_TRUE(cut.missing.empty());
  EXPECT_EQ(cut.triangles.size(), got(takeCut(rock().whole.mt, UniformError(error))).triangles.size());
  EXPECT_EQ(got(missingInView(step.part->mt, demand)).missing, 0u);
  EXPECT_GT(got(missingInView(pages.outline()->mt, demand)).missing, 0u);
}

TEST(ResidentSurface, NamesThePageWhoseBytesAreDamagedAndGoesOnWithTheOthers) {
  const TemporaryFolder folder;
  const AmtContainer whole = got(AmtContainer::open(rock().folder.file("rock.amt")));
  const AmtChunk nodes = *whole.find(amt_tag::kPackedNodes);
  std::string bytes = test::readAll(rock().folder.file("rock.amt"));
  bytes[nodes.offset + nodes.bytes - 3] ^= 4;
  test::writeAll(folder.file("damaged.amt"), bytes);
  SurfacePages pages = got(
      SurfacePages::open(got(PagedSurfaceFile::open(got(AmtContainer::open(folder.file("damaged.amt")))))));
  const ViewDemand all{.view = aroundRock(0, 0, 1), .pixels = 1, .error = 0};
  const auto step = pages.step(demandOf(all, *pages.outline()), kAnyBytes);
  ASSERT_FALSE(step);
  EXPECT_EQ(step.error().code, ErrorCode::corrupt);
  EXPECT_NE(step.error().message.find("page "), std::string::npos) << step.error().message;
  EXPECT_NE(step.error().culprit.find("damaged.amt"), std::string::npos);
  EXPECT_TRUE(pages.step(demandOfRock(aroundRock(0, 0, 60), pages), kAnyBytes));
}

TEST(ResidentSurface, IsOfASurfaceInPagesAlone) {
  const TemporaryFolder folder;
  ASSERT_TRUE(writeSurfaceAmt(folder.file("packed.amt"), rock().whole, {}, {.isPacked = true}));
  const auto packed = PagedSurfaceFile::open(got(AmtContainer::open(folder.file("packed.amt"))));
  ASSERT_FALSE(packed);
  EXPECT_EQ(packed.error().code, ErrorCode::unsupported);
  ASSERT_TRUE(writeAmt(folder.file("terrain.amt"), test::tinyModel()));
  const auto terrain = PagedSurfaceFile::open(got(AmtContainer::open(folder.file("terrain.amt"))));
  ASSERT_FALSE(terrain);
  EXPECT_EQ(terrain.error().code, ErrorCode::unsupported);
}

}  // namespace
}  // namespace arete

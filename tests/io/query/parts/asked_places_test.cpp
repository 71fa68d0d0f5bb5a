// SPDX-License-Identifier: GPL-3.0-or-later
//
// What questions say that they require, against what their answers touch.
#include "io/query/parts/asked_places.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>

#include "io/amt_fixture.h"
#include "io/io_fixture.h"
#include "io/query/parts/parts_fixture.h"
#include "terrain/sight/paths.h"

namespace arete {
namespace {

using test::got;
using test::TemporaryFolder;

class AskedPlaces : public ::testing::Test {
 protected:
  AskedPlaces() {
    const std::string path = folder_.file("hills.amt");
    EXPECT_TRUE(
        writeAmt(path, got(build(test::hills(300, 250, [](double z) { return z; }))), {}, {.isPaged = true}));
    file_.emplace(got(openAmt(path)));
    outline_ = got(outlineOf(*file_));
    earth_ = makePlaneEarth(outline_);
  }
  /// Whether full resolution is required at a place of the plan.
  static bool isRequired(const RequiredError& wanted, Vec2 place) {
    return wanted(overPlan({place.x, place.y, place.x, place.y})) == 0;
  }
  Vec2 at(double column, double row) const { return outline_.toSource({column, row}); }

  TemporaryFolder folder_;
  std::optional<AmtFile> file_;
  TerrainModel outline_;
  std::unique_ptr<SightEarth> earth_;
};

TEST_F(AskedPlaces, OfHeightsAreThePlacesAndNothingFarAway) {
  const Vec2 places[] = {{20, 30}, {270, 220}, {std::nan(""), 5}};
  const RequiredError wanted = wantedAt(places, outline_);
  EXPECT_TRUE(isRequired(wanted, {20, 30}));
  EXPECT_TRUE(isRequired(wanted, {270, 220}));
  EXPECT_FALSE(isRequired(wanted, {150, 120}));
  EXPECT_FALSE(isRequired(wantedAt({}, outline_), {20, 30})) << "no question requires nothing";
}

TEST_F(AskedPlaces, OfLinesAreBothEndsAndTheGroundBelowThem) {
  const std::array<Vec2, 2> ends[] = {{at(20, 30), at(220, 130)}};
  const std::vector<Vec2> line = {at(20, 30), at(220, 130)};
  for (const RequiredError& wanted :
       {wantedBetween(ends, *earth_, outline_), wantedAlong({&line, 1}, *earth_, outline_)}) {
    for (const double part : {0.0, 0.3, 0.7, 1.0})
      EXPECT_TRUE(isRequired(wanted, {20 + 200 * part, 30 + 100 * part})) << part;
    EXPECT_FALSE(isRequired(wanted, {220, 30}));
  }
  const std::vector<Vec2> nothing[] = {{}, {}};
  EXPECT_FALSE(isRequired(wantedAlong(nothing, *earth_, outline_), {20, 30}));
}

TEST_F(AskedPlaces, OfViewshedsAreTheGroundInRangeAndEverythingWithoutALimit) {
  constexpr double kStep = 1.0 / 3600;
  AskedRange near{at(60, 60), 20 * kStep};
  const auto wanted = wantedInRange({&near, 1}, *earth_, outline_);
  ASSERT_TRUE(wanted);
  for (const Vec2 place : {Vec2{60, 60}, {79, 60}, {60, 41}}) EXPECT_TRUE(isRequired(*wanted, place));
  EXPECT_FALSE(isRequired(*wanted, {150, 150}));
  const auto wider = wantedInRange({&near, 1}, *earth_, outline_, 0.5);
  ASSERT_TRUE(wider);
  EXPECT_TRUE(isRequired(*wider, {90, 90})) << "a map has margins";
  near.metres = std::numeric_limits<double>::infinity();
  const auto all = wantedInRange({&near, 1}, *earth_, outline_);
  ASSERT_TRUE(all);
  EXPECT_FALSE(*all) << "null requires everything";
}

TEST_F(AskedPlaces, AreNotLookedForOnceTheQuestionIsStopped) {
  const AskedRange near{at(60, 60), 20};
  const std::atomic<bool> isStopped = true;
  RunContext context;
  context.cancel = &isStopped;
  const auto wanted = wantedInRange({&near, 1}, *earth_, outline_, std::nullopt, context);
  ASSERT_FALSE(wanted);
  EXPECT_EQ(wanted.error().code, ErrorCode::interrupted);
}

TEST_F(AskedPlaces, OfPointsAreTheWholeModel) {
  PointHeightfield field;
  for (int i = 0; i < 900; ++i) {
    field.positions.push_back({double(i % 30) + 0.1 * (i % 7), double(i / 30)});
    field.heights.push_back(std::sin(i * 0.3));
  }
  const std::string path = folder_.file("points.amt");
  ASSERT_TRUE(writeAmt(path, got(build(field)), {}, {.isPaged = true}));
  const AmtFile file = got(openAmt(path));
  const TerrainModel outline = got(outlineOf(file));
  EXPECT_EQ(outline.mt.nodeCount(), file.nodeCount());
  EXPECT_EQ(got(readWanted(file, outline, requiredNowhere())).mt.nodeCount(), file.nodeCount());
}

}  // namespace
}  // namespace arete

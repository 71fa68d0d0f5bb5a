// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/simplify/level_schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "engine/ids_of.h"

namespace arete {
namespace {

using test::idsBelow;
using Step = LevelSchedule::Step;

/// Vertices that may be removed, with thresholds of their own. Of fewer than 64 no quantile is taken.
struct Vertices {
  ThresholdList list;
  std::uint32_t removed = 0;

  explicit Vertices(const std::vector<float>& thresholds) {
    const auto ids = idsBelow<VertexId>(thresholds.size());
    list.assign(ids, std::vector<std::uint8_t>(ids.size(), 0));
    for (const VertexId v : ids) list.set(v, thresholds[v.index()]);
  }
  /// Removes the next ones.
  void remove(std::uint32_t count) {
    for (; count > 0; --count) {
      const std::vector<VertexId> one = {VertexId(removed++)};
      list.remove(one, LoopThreads::caller);
    }
  }
};

constexpr float kNever = ThresholdList::kNever;

TEST(LevelSchedule, GrowsLessTheFewerVerticesAreLeft) {
  for (const double ratio : {1.005, 1.1, 1.5, 16.0})
    for (const unsigned seed : {1u, 2u}) {
      SCOPED_TRACE(testing::Message() << "ratio " << ratio << ", seed " << seed);
      std::mt19937 random(seed);
      Vertices vertices(std::vector<float>(60, 0));
      LevelSchedule schedule(vertices.list, {.first = 0.25, .ratio = ratio});
      EXPECT_EQ(schedule.sizeAtStart(), 60u);
      double expected = 0.25;
      EXPECT_EQ(schedule.threshold(), expected);
      while (!vertices.list.empty()) {
        vertices.remove(std::min(1 + std::uint32_t(random() % 8), std::uint32_t(vertices.list.size())));
        ASSERT_EQ(schedule.advance(), Step::level);
        double growth = (ratio - 1) * (60.0 - vertices.removed) / 60.0;
        if (growth < 0.015) growth = ratio < 1.015 ? ratio - 1 : 0.015;
        expected += expected * growth;
        ASSERT_NEAR(schedule.threshold(), expected, 1e-12 * expected) << vertices.removed << " removed";
      }
    }
}

TEST(LevelSchedule, SkipsThresholdsAtWhichLessThanAFiftiethIsDue) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> magnitude(3, 9);
  std::vector<float> thresholds(1000);
  for (float& t : thresholds) t = std::pow(10.0f, magnitude(random));
  Vertices vertices(thresholds);
  LevelSchedule schedule(vertices.list, {.first = 1, .ratio = 1.1});
  vertices.remove(1);
  EXPECT_EQ(schedule.advance(), Step::level);
  const auto due = std::count_if(thresholds.begin() + 1, thresholds.end(),
                                 [&](float t) { return t <= schedule.threshold(); });
  EXPECT_GE(double(due) / 999, 0.02);
  EXPECT_LE(double(due) / 999, 0.022);
}

TEST(LevelSchedule, GoesToTheLeastThresholdAfterALevelThatRemovesNothing) {
  Vertices vertices({kNever, 300, 70, kNever, 90});
  LevelSchedule schedule(vertices.list, {.first = 1, .ratio = 1.1});
  vertices.remove(1);
  EXPECT_EQ(schedule.advance(), Step::level);
  EXPECT_LT(schedule.threshold(), 1.2) << "one was removed";
  EXPECT_EQ(schedule.advance(), Step::level);
  EXPECT_EQ(schedule.threshold(), 70);
  EXPECT_EQ(schedule.advanceTo(80), Step::level);
  EXPECT_EQ(schedule.threshold(), 80) << "70 is less";
}

TEST(LevelSchedule, EndsWhereNothingWasRemovedAndNothingWillBeDue) {
  Vertices vertices(std::vector<float>(9, kNever));
  LevelSchedule schedule(vertices.list, {.first = 1, .ratio = 1.1});
  vertices.remove(2);
  EXPECT_EQ(schedule.advance(), Step::level) << "the removals may have changed the others";
  EXPECT_EQ(schedule.advance(), Step::end);

  Vertices none({});
  EXPECT_EQ(LevelSchedule(none.list, {}).sizeAtStart(), 1u);
}

TEST(LevelSchedule, RefreshesCostsOnceBeforeAGapIfVerticesWereRemoved) {
  Vertices vertices(std::vector<float>(9, 5));
  LevelSchedule schedule(vertices.list, {.first = 1, .ratio = 1.1, .gap = 2});
  vertices.remove(1);
  EXPECT_EQ(schedule.advance(), Step::level);
  const double last = schedule.threshold();
  EXPECT_LT(last, 2) << "no gap";
  EXPECT_EQ(schedule.advance(), Step::refresh);
  EXPECT_EQ(schedule.threshold(), last);
  EXPECT_EQ(schedule.advance(), Step::level) << "nothing has changed since";
  EXPECT_EQ(schedule.threshold(), 5);

  for (const VertexId v : idsBelow<VertexId>(9)) vertices.list.set(v, kNever);
  vertices.remove(1);
  EXPECT_EQ(schedule.advance(), Step::level);
  EXPECT_EQ(schedule.advance(), Step::refresh) << "what was stuck may no longer be";
  EXPECT_EQ(schedule.advance(), Step::end);
}

TEST(LevelSchedule, StaysBelowTheThresholdOfVerticesThatAreNeverDue) {
  Vertices vertices(std::vector<float>(9, kNever));
  LevelSchedule schedule(vertices.list, {.first = 3e38, .ratio = 1e6});
  for (const double threshold : schedule.pass(1e9)) EXPECT_LT(static_cast<float>(threshold), kNever);
  vertices.remove(1);
  EXPECT_EQ(schedule.advance(), Step::level);
  EXPECT_LT(static_cast<float>(schedule.threshold()), kNever);
  EXPECT_GT(schedule.threshold(), 3e38);
}

TEST(LevelSchedule, DividesAPassIntoLevels) {
  Vertices vertices(std::vector<float>(20, 0));
  const auto passOf = [&](double first, double ratio, double span) {
    return LevelSchedule(vertices.list, {.first = first, .ratio = ratio}).pass(span);
  };
  const std::vector<double> thresholds = passOf(2, 1.1, 1.5);
  ASSERT_EQ(thresholds.size(), 6u) << "1.1 to the fifth exceeds 1.5, to the fourth it does not";
  EXPECT_EQ(thresholds.front(), 2);
  for (std::size_t i = 1; i < thresholds.size(); ++i)
    EXPECT_NEAR(thresholds[i], 1.1 * thresholds[i - 1], 1e-14);
  EXPECT_EQ(passOf(2, 1.6, 1.5).size(), 2u);
  EXPECT_EQ(passOf(2, 1.001, 1.5).size(), 17u) << "at most 16 levels";
  EXPECT_EQ(passOf(0, 1.1, 1.5), std::vector<double>({0, 0})) << "on flat ground";
}

TEST(LevelSchedule, LeavesNoVertexPendingHoweverCostsChange) {
  for (const double gap : {2.0, double(kNever)})
    for (const unsigned seed : {1u, 2u, 3u, 4u}) {
      SCOPED_TRACE(testing::Message() << "gap " << gap << ", seed " << seed);
      std::mt19937 random(seed);
      std::vector<float> thresholds(40 + random() % 200);
      for (float& t : thresholds) t = float(random() % 1000);
      Vertices vertices(thresholds);
      ThresholdList& list = vertices.list;
      LevelSchedule schedule(list, {.first = 1e-3, .ratio = 1.3, .gap = gap});
      std::vector<VertexId> due;
      ThresholdList::Scratch scratch;
      double last = 0;
      int levels = 0;
      for (Step step = Step::level; step != Step::end && !list.empty(); step = schedule.advance()) {
        ASSERT_LT(++levels, 2000);
        ASSERT_GE(schedule.threshold(), last);
        last = schedule.threshold();
        list.collect(last, due, scratch);
        for (const VertexId v : due) {
          const unsigned fate = random() % 8;
          if (fate < 3)
            list.remove(std::vector<VertexId>{v}, LoopThreads::caller);
          else
            list.set(v, fate == 3 ? kNever : float(last * double(1 + random() % 9)) + 1);
        }
      }
      EXPECT_EQ(list.least(), kNever);
      EXPECT_GT(levels, 10);
    }
}

}  // namespace
}  // namespace arete

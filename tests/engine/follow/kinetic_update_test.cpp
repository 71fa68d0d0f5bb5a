// SPDX-License-Identifier: GPL-3.0-or-later
//
// A saturated cut that follows a camera which moves a little, or a lot. The oracle is the cut from scratch.
#include "engine/follow/incremental_cut.h"

#include <gtest/gtest.h>

#include <atomic>
#include <random>

#include "engine/camera_moves.h"
#include "engine/cut_promises.h"
#include "engine/family_models.h"

namespace arete {
namespace {

/// A camera with a habit, one criterion a frame.
class Flight {
 public:
  enum Habit { steady, jerky, resting, jumping, turning, zooming, adapting, resizing, anything, kHabits };

  Flight(const MultiTriangulation& mt, Habit habit, std::mt19937_64& random)
      : extent_(mt), metric_(mt.arrays().metric), habit_(habit), random_(random) {
    o_.view = randomView(extent_, random);
    o_.view.eye.z = extent_.high.z + 0.1 * extent_.relief();
    if (random() % 2) o_.view.nearDistance = 0.001 * extent_.size();
    if (random() % 3 == 0) o_.outsideError = 0.2 * extent_.relief();
  }

  ViewError next() {
    std::uniform_real_distribution<double> unit(0, 1);
    const double size = extent_.size();
    const Habit habit = habit_ == anything ? Habit(random_() % anything) : habit_;
    switch (habit) {
      case steady:
        advance(o_.view, 0.002 * size);
        turn(o_.view, {0, 0, 1}, 0.006);
        break;
      case jerky: {
        const double jerk = std::pow(unit(random_), 4) * 10;
        advance(o_.view, 0.003 * size * jerk);
        turn(o_.view, direction(random_), 0.01 * jerk);
        break;
      }
      case resting:
        if (random_() % 4 == 0) advance(o_.view, 0.01 * size);
        break;
      case jumping: {
        advance(o_.view, 0.002 * size);
        if (random_() % 6 == 0) {
          const View there = randomView(extent_, random_);
          o_.view.eye = there.eye;
          o_.view.forward = there.forward;
        }
        break;
      }
      case turning:
        turn(o_.view, {0, 0, 1}, 0.02);
        break;
      case zooming:
        o_.view.verticalFieldOfView =
            std::clamp(o_.view.verticalFieldOfView * std::exp(0.1 * unit(random_) - 0.05), 0.05, 2.5);
        break;
      case adapting:
        advance(o_.view, 0.002 * size);
        o_.pixels = std::clamp(o_.pixels * std::exp(0.2 * unit(random_) - 0.1), 0.1, 50.0);
        break;
      default:
        o_.view.widthPixels = 200 + double(random_() % 2000);
        o_.view.heightPixels = 200 + double(random_() % 1500);
        if (random_() % 5 == 0) o_.view.farDistance = (0.2 + unit(random_)) * size;
    }
    return ViewError(o_, metric_);
  }

 private:
  const Extent extent_;
  const MetricFrame metric_;
  const Habit habit_;
  std::mt19937_64& random_;
  ViewError::Options o_;
};

NodeSet takenAnew(const MultiTriangulation& mt, const Criterion& criterion) {
  return takeNodes(mt, criterion, {.method = CutMethod::saturated})->nodes;
}

template <class Work>
void forAllModels(const Work& work) {
  for (const FamilyModel& m : familyModels()) {
    SCOPED_TRACE(m.name);
    work(m.model.mt);
  }
  SCOPED_TRACE("mountains");
  work(mountains());
}

TEST(KineticUpdate, EqualsTheCutFromScratchHoweverTheCameraMoves) {
  for (const unsigned seed : {21u, 22u}) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    forAllModels([&](const MultiTriangulation& mt) {
      for (int habit = 0; habit < Flight::kHabits; ++habit) {
        SCOPED_TRACE(habit);
        IncrementalCut cut(mt);
        Flight flight(mt, Flight::Habit(habit), random);
        for (int frame = 0; frame < 40; ++frame) {
          const ViewError criterion = flight.next();
          const auto update = cut.update(criterion);
          ASSERT_TRUE(update && update->isComplete);
          ASSERT_EQ(cut.nodes(), takenAnew(mt, criterion)) << "frame " << frame;
        }
        ASSERT_TRUE(cut.validate());
      }
    });
  }
}

TEST(KineticUpdate, GoesOnWhereADeadlineStoppedIt) {
  std::mt19937_64 random(23);
  forAllModels([&](const MultiTriangulation& mt) {
    for (const auto habit : {Flight::steady, Flight::jumping, Flight::anything}) {
      IncrementalCut cut(mt);
      Flight flight(mt, habit, random);
      for (int frame = 0; frame < 60; ++frame) {
        const ViewError criterion = flight.next();
        IncrementalOptions options;
        if (frame % 10 != 9) options.deadline = strikeAfter(1 + int(random() % 60));
        const auto update = cut.update(criterion, options);
        ASSERT_TRUE(update);
        ASSERT_TRUE(cut.validate()) << "frame " << frame;
        if (!options.deadline) {
          ASSERT_TRUE(update->isComplete);
        }
        if (update->isComplete) {
          ASSERT_EQ(cut.nodes(), takenAnew(mt, criterion)) << "frame " << frame;
        }
      }
    }
  });
}

TEST(KineticUpdate, GoesOnWhereItWasInterrupted) {
  std::mt19937_64 random(24);
  std::atomic<bool> cancel = false;
  RunContext context;
  context.cancel = &cancel;
  IncrementalCut cut(mountains());
  Flight flight(mountains(), Flight::jumping, random);
  for (int frame = 0; frame < 20; ++frame) {
    const ViewError criterion = flight.next();
    cancel = frame % 2 == 0;
    const auto update = cut.update(criterion, {}, context);
    ASSERT_TRUE(update);
    if (cancel) continue;
    EXPECT_TRUE(update->isComplete);
    EXPECT_EQ(cut.nodes(), takenAnew(mountains(), criterion));
  }
}

TEST(KineticUpdate, KeepsABudgetThatComesAndGoes) {
  std::mt19937_64 random(25);
  forAllModels([&](const MultiTriangulation& mt) {
    IncrementalCut cut(mt);
    Flight flight(mt, Flight::anything, random);
    const std::uint32_t roots = mt.rootTriangleCount();
    std::uint32_t needed = roots;
    int affordable = 0;
    for (int frame = 0; frame < 80; ++frame) {
      const ViewError criterion = flight.next();
      IncrementalOptions options;
      const NodeSet wanted = takenAnew(mt, criterion);
      needed = std::uint32_t(front(mt, wanted).ids.size());
      if (frame % 20 >= 5) options.maxTriangles = needed + 10;  // for a while there is enough
      if (frame % 20 >= 15) options.maxTriangles = roots + std::uint32_t(random() % (needed - roots + 1));
      if (frame % 8 == 7) options.deadline = strikeAfter(1 + int(random() % 100));
      const auto update = cut.update(criterion, options);
      ASSERT_TRUE(update);
      ASSERT_TRUE(cut.validate()) << "frame " << frame;
      if (options.maxTriangles) {
        ASSERT_LE(cut.triangles().size(), *options.maxTriangles) << "frame " << frame;
      }
      if (update->isComplete) {
        ASSERT_EQ(cut.nodes(), wanted) << "frame " << frame;
      }
      if (options.maxTriangles && !options.deadline) {
        const auto scratch =
            takeNodes(mt, criterion, {.method = CutMethod::saturated, .maxTriangles = options.maxTriangles});
        ASSERT_EQ(cut.nodes(), scratch->nodes) << "frame " << frame;
      }
      if (options.deadline || (options.maxTriangles && *options.maxTriangles < needed)) continue;
      ASSERT_TRUE(update->isComplete) << "frame " << frame;
      ++affordable;
    }
    EXPECT_GT(affordable, 40);
  });
}

TEST(KineticUpdate, TakesUpACutThatOthersHaveChanged) {
  std::mt19937_64 random(26);
  const MultiTriangulation& mt = mountains();
  IncrementalCut cut(mt), other(mt);
  Flight flight(mt, Flight::steady, random);
  for (int frame = 0; frame < 30; ++frame) {
    const ViewError criterion = flight.next();
    if (frame % 3 == 1) {
      ASSERT_TRUE(cut.apply(difference(cut.nodes(), takeNodes(mt, criterion)->nodes)));
      EXPECT_EQ(cut.nodes(), takeNodes(mt, criterion)->nodes);
    }
    if (frame % 5 == 2) {
      ASSERT_TRUE(other.update(ViewError({.view = randomView(Extent(mt), random)}, mt.arrays().metric)));
      ASSERT_TRUE(cut.apply(difference(cut.nodes(), other.nodes())));
    }
    if (frame % 7 == 3) {
      ASSERT_TRUE(cut.update(UniformError(1)));
    }
    ASSERT_TRUE(cut.update(criterion));
    EXPECT_EQ(cut.nodes(), takenAnew(mt, criterion)) << "frame " << frame;
    EXPECT_TRUE(cut.validate());
  }
}

/// Counts evaluations.
class Counting final : public KineticCriterion {
 public:
  explicit Counting(ViewError view) : view_(std::move(view)) {}
  bool isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const override {
    return view_.isFineEnough(mt, t, corners);
  }
  double allowedError(const Sphere& s) const override { return view_.allowedError(s); }
  std::unique_ptr<const KineticCriterion> clone() const override { return view_.clone(); }
  std::optional<Motion> motionSince(const KineticCriterion& before) const override {
    return view_.motionSince(before);
  }
  std::uint64_t exceedingFor(std::span<const Sphere> balls, std::span<const float> errors, const Motion& rate,
                             std::span<float> units) const override {
    evaluated += balls.size();
    return view_.exceedingFor(balls, errors, rate, units);
  }
  static inline std::atomic<std::size_t> evaluated = 0;  // from several threads

 private:
  ViewError view_;
};

TEST(KineticUpdate, AsksAboutAFewAndAboutNoneWhileTheCameraRests) {
  std::mt19937_64 random(27);
  const MultiTriangulation& mt = mountains();
  IncrementalCut cut(mt);
  const Extent extent(mt);
  View view;
  view.eye = {(extent.low.x + extent.high.x) / 2, (extent.low.y + extent.high.y) / 2, extent.high.z};
  view.forward = {1, 0.3, -0.3};
  const auto fly = [&] {
    advance(view, 2.5);
    turn(view, {0, 0, 1}, 0.006);
    return Counting(ViewError({.view = view}, mt.arrays().metric));
  };
  ASSERT_TRUE(cut.update(fly()));
  const std::size_t first = Counting::evaluated;
  for (int frame = 0; frame < 20; ++frame) ASSERT_TRUE(cut.update(fly()));
  Counting::evaluated = 0;
  constexpr int kFrames = 200;
  for (int frame = 0; frame < kFrames; ++frame) ASSERT_TRUE(cut.update(fly()));
  std::printf("evaluated at first: %zu, in a frame: %.0f, triangles: %zu\n", first,
              double(Counting::evaluated) / kFrames, cut.triangles().size());
  EXPECT_LT(double(Counting::evaluated) / kFrames, 0.2 * double(cut.triangles().size()));
  Counting::evaluated = 0;
  for (int frame = 0; frame < 5; ++frame)
    ASSERT_TRUE(cut.update(Counting(ViewError({.view = view}, mt.arrays().metric))));
  EXPECT_EQ(Counting::evaluated, 0u);
}

TEST(KineticUpdate, GivesTheSameStepsForAnyThreadCount) {
  std::vector<std::vector<CutStep>> steps;
  for (const int threads : {1, 2, 4}) {
    std::mt19937_64 random(28);
    RunContext context;
    context.threads = threads;
    IncrementalCut cut(mountains());
    Flight flight(mountains(), Flight::anything, random);
    std::vector<CutStep> all;
    for (int frame = 0; frame < 60; ++frame) {
      ASSERT_TRUE(cut.update(flight.next(), {}, context));
      all.insert(all.end(), cut.lastSteps().begin(), cut.lastSteps().end());
    }
    steps.push_back(std::move(all));
  }
  EXPECT_EQ(steps[0], steps[1]);
  EXPECT_EQ(steps[0], steps[2]);
}

}  // namespace
}  // namespace arete

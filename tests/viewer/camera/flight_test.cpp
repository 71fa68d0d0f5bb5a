// SPDX-License-Identifier: GPL-3.0-or-later
//
// Flights held against what they promise, numerically: keys met at their times, speeds by differences of
// positions, no steps in position or direction, nothing beyond what two neighbouring keys say.
#include "viewer/camera/flight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "viewer/camera_models.h"

namespace arete {
namespace {

using test::apart;
using test::turned;

const TerrainModel& someModel(const std::string& name = "turned") {
  for (const auto& m : test::cameraModels())
    if (m.name == name) return m.model;
  return test::cameraModels()[0].model;
}

/// Keys all over a model, steps between them from a metre to kilometres.
std::vector<Camera> randomKeys(Random& random, const TerrainModel& model, std::size_t count) {
  const CameraSpace space(model);
  std::vector<Camera> keys;
  Vec3 place{};
  for (std::size_t i = 0; i < count; ++i) {
    const double step = std::pow(10, random.between(0, 3.3)), angle = random.between(0, 6.3);
    place = {place.x + step * std::cos(angle), place.y + step * std::sin(angle),
             place.z + step * random.between(-0.5, 0.5)};
    keys.push_back(space.at({.azimuthDegrees = random.between(0, 360),
                             .pitchDegrees = random.between(-90, 90),
                             .verticalFieldOfViewDegrees = random.between(20, 90)},
                            place));
  }
  return keys;
}

/// The largest step in what `of` tells between times a ten-thousandth of a second apart.
double largestStep(const Flight& flight, const std::function<double(double, double)>& of) {
  const double h = 1e-4;
  double largest = 0;
  for (double t = -0.1; t < flight.duration() + 0.1; t += h) largest = std::max(largest, of(t, t + h));
  return largest;
}

TEST(Flight, IsAtEachKeyAtItsTimeOnEveryGrid) {
  for (const auto& [name, model] : test::cameraModels()) {
    const CameraSpace space(model);
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      SCOPED_TRACE(name + ", seed " + std::to_string(seed));
      Random random(seed);
      FlightPlan plan{.keys = randomKeys(random, model, 3 + random.below(8)), .speed = 150};
      plan.isClosed = seed % 3 == 0;
      plan.easeSeconds = random.between(0, 2);
      const auto flight = Flight::create(plan, space);
      ASSERT_TRUE(flight) << flight.error().describe();
      ASSERT_EQ(flight->keyTimes().size(), plan.keys.size());
      for (std::size_t i = 0; i < plan.keys.size(); ++i) {
        const Camera& key = plan.keys[i];
        const Camera at = flight->at(flight->keyTimes()[i]);
        ASSERT_LT(apart(space.position(at), space.position(key)), 1e-5) << "key " << i;
        // Between keys a metre apart much turns in a millimetre.
        ASSERT_LT(turned(at.azimuthDegrees, key.azimuthDegrees), 1e-3) << "key " << i;
        ASSERT_NEAR(at.pitchDegrees, key.pitchDegrees, 1e-3) << "key " << i;
        ASSERT_NEAR(at.verticalFieldOfViewDegrees, key.verticalFieldOfViewDegrees, 1e-3) << "key " << i;
      }
      const Camera before = flight->at(-5), after = flight->at(flight->duration() + 5);
      if (!plan.isClosed) {
        EXPECT_LT(apart(space.position(before), space.position(plan.keys.front())), 1e-5);
        EXPECT_LT(apart(space.position(after), space.position(plan.keys.back())), 1e-5);
      }
    }
  }
}

TEST(Flight, FliesAtASteadySpeedAndEasesAtItsEnds) {
  const TerrainModel& model = someModel();
  const CameraSpace space(model);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const auto flight =
        Flight::create({.keys = randomKeys(random, model, 8), .speed = 50, .easeSeconds = 2}, space);
    ASSERT_TRUE(flight);
    const double h = 1e-3;
    double slowest = INFINITY, fastest = 0;
    for (double t = 0; t + h <= flight->duration(); t += 0.01) {
      const double speed = apart(space.position(flight->at(t)), space.position(flight->at(t + h))) / h;
      fastest = std::max(fastest, speed);
      if (t > 2 && t < flight->duration() - 2 - h) slowest = std::min(slowest, speed);
    }
    EXPECT_NEAR(fastest, 50, 1e-2);
    EXPECT_GE(slowest, 49) << "a chord across a sharp bend is a little shorter than its arc";
    EXPECT_NEAR(flight->duration(), flight->length() / 50 + 2, 1e-9);
    const double start = apart(space.position(flight->at(0)), space.position(flight->at(0.01))) / 0.01;
    EXPECT_LT(start, 0.1) << "it starts from rest";
  }
}

TEST(Flight, TakesTheDurationThatIsAskedFor) {
  const TerrainModel& model = someModel("geographic");
  const CameraSpace space(model);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    FlightPlan plan{.keys = randomKeys(random, model, 5), .duration = random.between(0.5, 100)};
    plan.easeSeconds = random.between(0, 5);
    auto turn = plan.keys[2];
    turn.azimuthDegrees += 4;
    if (seed % 2 == 0) plan.keys.insert(plan.keys.begin() + 3, turn);
    plan.turnRate = 100;
    const auto flight = Flight::create(plan, space);
    if (!flight) {
      EXPECT_NE(flight.error().message.find("turns on the spot"), std::string::npos);
      continue;
    }
    EXPECT_NEAR(flight->duration(), *plan.duration, 1e-9 * *plan.duration) << "seed " << seed;
  }
}

TEST(Flight, HasNoStepInPositionOrDirectionNorInTheirSpeeds) {
  const TerrainModel& model = someModel();
  const CameraSpace space(model);
  for (const bool turnsOnTheSpot : {false, true})
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      SCOPED_TRACE("seed " + std::to_string(seed) + (turnsOnTheSpot ? ", with turns" : ""));
      Random random(seed);
      // Even steps: what turns within a metre at 50 m/s turns fast, and no spline helps.
      std::vector<Camera> keys;
      for (int i = 0; i < 6; ++i)
        keys.push_back(
            space.at({.azimuthDegrees = random.between(0, 360), .pitchDegrees = random.between(-80, 20)},
                     {100.0 * i, random.between(-60, 60), random.between(0, 60)}));
      if (turnsOnTheSpot)
        for (int k = 0; k < 2; ++k) {
          Camera turn = keys[2];
          turn.azimuthDegrees = random.between(0, 360);
          turn.pitchDegrees = random.between(-80, 20);
          keys.insert(keys.begin() + 3, turn);
        }
      const auto flight =
          Flight::create({.keys = keys, .speed = 50, .easeSeconds = 1, .turnRate = 40}, space);
      ASSERT_TRUE(flight) << flight.error().describe();
      EXPECT_LT(largestStep(*flight,
                            [&](double a, double b) {
                              return apart(space.position(flight->at(a)), space.position(flight->at(b)));
                            }),
                50 * 1e-4 * 1.001);
      const auto directionStep = [&](double a, double b) {
        return apart(space.forward(lookOf(flight->at(a))), space.forward(lookOf(flight->at(b))));
      };
      // 180 degrees in a leg of 2 s turn at most 1.5 times as fast as evenly on a cubic, 3 at a knot.
      EXPECT_LT(largestStep(*flight, directionStep), 5 * 1e-4);
      // Velocities: a jump would be as large as the velocity, an acceleration is worth 1e-4 of itself.
      const auto velocityStep = [&](double a, double b) {
        const double h = b - a;
        const Vec3 p = space.position(flight->at(a)), q = space.position(flight->at(b)),
                   r = space.position(flight->at(b + h));
        return apart({q.x - p.x, q.y - p.y, q.z - p.z}, {r.x - q.x, r.y - q.y, r.z - q.z}) / h;
      };
      EXPECT_LT(largestStep(*flight, velocityStep), 0.1);
      const auto turnStep = [&](double a, double b) {
        const double h = b - a;
        const Camera p = flight->at(a), q = flight->at(b), r = flight->at(b + h);
        const auto rate = [&](const Camera& from, const Camera& to) {
          return std::remainder(to.azimuthDegrees - from.azimuthDegrees, 360) / h;
        };
        return std::abs(rate(q, r) - rate(p, q));
      };
      EXPECT_LT(largestStep(*flight, turnStep), 0.5) << "degrees per second";
    }
}

TEST(Flight, TurnsTheShorterWayAndNeverBeyondItsKeys) {
  const TerrainModel& model = someModel("north up");
  const CameraSpace space(model);
  const auto key = [&](double x, double azimuth, double pitch) {
    return space.at({.azimuthDegrees = azimuth, .pitchDegrees = pitch}, {x, 0, 0});
  };
  const auto flight = Flight::create(
      {.keys = {key(0, 350, -90), key(100, 10, -90), key(200, 20, 90), key(300, 355, 90)}, .speed = 10},
      space);
  ASSERT_TRUE(flight);
  for (double t = 0; t <= flight->duration(); t += 0.01) {
    const Camera camera = flight->at(t);
    ASSERT_TRUE(viewOf(camera, model)) << "no pitch beyond the vertical, at " << t;
    const double azimuth = std::remainder(camera.azimuthDegrees, 360);
    ASSERT_GE(azimuth, -10 - 1e-9);
    ASSERT_LE(azimuth, 20 + 1e-9);
    if (t <= flight->keyTimes()[1]) {
      ASSERT_EQ(camera.pitchDegrees, -90);
    }
  }
}

TEST(Flight, TurnsOnTheSpotByTheAngle) {
  const TerrainModel& model = someModel("north up");
  const CameraSpace space(model);
  const auto key = [&](double x, double azimuth) { return space.at({.azimuthDegrees = azimuth}, {x, 0, 0}); };
  const auto flight = Flight::create({.keys = {key(0, 0), key(100, 0), key(100, 90), key(300, 90)},
                                      .speed = 10,
                                      .easeSeconds = 0,
                                      .turnRate = 30},
                                     space);
  ASSERT_TRUE(flight);
  EXPECT_NEAR(flight->keyTimes()[1], 10, 1e-9);
  EXPECT_NEAR(flight->keyTimes()[2], 13, 1e-9);
  EXPECT_NEAR(flight->duration(), 33, 1e-9);
  EXPECT_NEAR(flight->at(11.5).azimuthDegrees, 45, 1e-6);
  // Only turning: a panorama.
  const auto panorama =
      Flight::create({.keys = {key(0, 0), key(0, 120), key(0, 240), key(0, 0)}, .duration = 36}, space);
  ASSERT_TRUE(panorama);
  EXPECT_NEAR(panorama->duration(), 36, 1e-9);
  EXPECT_EQ(panorama->length(), 0);
  EXPECT_NEAR(panorama->at(18).azimuthDegrees, 180, 1e-6);
}

TEST(Flight, GoesRoundForEverWhenItIsClosed) {
  const TerrainModel& model = someModel();
  const CameraSpace space(model);
  Random random(9);
  FlightPlan plan{.keys = randomKeys(random, model, 6), .speed = 80, .isClosed = true};
  const auto flight = Flight::create(plan, space);
  ASSERT_TRUE(flight);
  for (double t = -3; t < 3; t += 0.37)
    EXPECT_LT(apart(space.position(flight->at(t)), space.position(flight->at(t + flight->duration()))), 1e-4);
  const double h = 1e-4;
  const Vec3 p = space.position(flight->at(-h)), q = space.position(flight->at(0)),
             r = space.position(flight->at(h));
  EXPECT_NEAR(apart(p, q) / h, 80, 0.1);
  EXPECT_NEAR(apart(q, r) / h, 80, 0.1);
  EXPECT_NEAR(apart(p, r) / h, 160, 0.2) << "straight through the seam";
  EXPECT_EQ(flight->frameCount(), static_cast<std::uint64_t>(std::round(flight->duration() * 60)));
}

TEST(Flight, CountsTheFramesOfAFilm) {
  const TerrainModel& model = someModel();
  const CameraSpace space(model);
  Random random(10);
  FlightPlan plan{.keys = randomKeys(random, model, 3), .duration = 2};
  plan.framesPerSecond = 30;
  EXPECT_EQ(Flight::create(plan, space)->frameCount(), 61);
}

TEST(Flight, RefusesWhatIsNoneAndNamesTheKeyFrame) {
  const TerrainModel& model = someModel("north up");
  const CameraSpace space(model);
  const auto key = [&](double x, double azimuth = 0) {
    return space.at({.azimuthDegrees = azimuth}, {x, 0, 0});
  };
  const auto with = [&](const std::function<void(FlightPlan&)>& change) {
    FlightPlan plan{.keys = {key(0), key(100), key(200)}, .speed = 10};
    change(plan);
    return plan;
  };
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const struct {
    std::function<void(FlightPlan&)> change;
    std::string culprit, words;
  } cases[] = {
      {[](FlightPlan& p) { p.keys.resize(1); }, "flight", "one key frame"},
      {[](FlightPlan& p) { p.keys.clear(); }, "flight", "no key frame"},
      {[](FlightPlan& p) { p.keys[2] = p.keys[1]; }, "key frame 3", "equals key frame 2"},
      {[](FlightPlan& p) { p.keys[1].azimuthDegrees = 360, p.keys[1].xy = p.keys[0].xy; }, "key frame 2",
       "equals key frame 1"},
      {[](FlightPlan& p) { p.keys[1].xy.x = kNan; }, "key frame 2", "position"},
      {[](FlightPlan& p) { p.keys[1].height = 1e300; }, "key frame 2", "position"},
      {[](FlightPlan& p) { p.keys[0].azimuthDegrees = kInfinity; }, "key frame 1", "azimuth"},
      {[](FlightPlan& p) { p.keys[0].pitchDegrees = 91; }, "key frame 1", "pitch"},
      {[](FlightPlan& p) { p.keys[2].verticalFieldOfViewDegrees = 180; }, "key frame 3", "field of view"},
      {[](FlightPlan& p) { p.speed.reset(); }, "flight", "speed or its duration"},
      {[](FlightPlan& p) { p.duration = 3; }, "flight", "both its speed and its duration"},
      {[](FlightPlan& p) { p.speed = 0; }, "flight", "speed"},
      {[&](FlightPlan& p) { p.speed = kNan; }, "flight", "speed"},
      {[](FlightPlan& p) { p.speed.reset(), p.duration = -1; }, "flight", "duration"},
      {[](FlightPlan& p) { p.easeSeconds = -1; }, "flight", "easing"},
      {[](FlightPlan& p) { p.turnRate = 0; }, "flight", "turn rate"},
      {[](FlightPlan& p) { p.framesPerSecond = 0; }, "flight", "frames per second"},
      {[](FlightPlan& p) { p.isClosed = true, p.keys.resize(2); }, "flight", "three places"},
      {[](FlightPlan& p) { p.isClosed = true, p.keys.push_back(p.keys[0]); }, "key frame 4",
       "returns there by itself"},
      {[&](FlightPlan& p) { p.isClosed = true, p.keys.push_back(key(200, 90)); }, "flight", "no turn"},
      {[&](FlightPlan& p) { p.speed.reset(), p.duration = 1, p.keys.push_back(key(200, 90)); }, "flight",
       "turns on the spot alone"},
  };
  ASSERT_TRUE(Flight::create(with([](FlightPlan&) {}), space));
  for (const auto& c : cases) {
    const auto flight = Flight::create(with(c.change), space);
    ASSERT_FALSE(flight) << c.words;
    EXPECT_EQ(flight.error().code, ErrorCode::usage);
    EXPECT_EQ(flight.error().culprit, c.culprit) << c.words;
    EXPECT_NE(flight.error().message.find(c.words), std::string::npos) << flight.error().describe();
  }
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Views in parallel projection. Pixels are measured by a projection of the test's own.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <random>
#include <vector>

#include "engine/camera_moves.h"
#include "engine/criteria/view_error.h"
#include "engine/cut_promises.h"
#include "engine/family_models.h"
#include "engine/front_samples.h"
#include "engine/morph/geomorph.h"

namespace arete {
namespace {

constexpr double kEverywhere = std::numeric_limits<double>::infinity();

/// Looks down somewhere over the terrain, or under it; half of the views see what is behind the eye too.
View parallelView(const Extent& e, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0, 1);
  View view = randomView(e, random);
  view.parallelHeight = e.size() * std::exp(-3 * unit(random));
  if (random() % 2)
    view.nearDistance = -kEverywhere;
  else if (random() % 2)
    view.nearDistance = -0.2 * e.size() * unit(random);
  return view;
}

TEST(ParallelView, KeepsItsPixelsOnTheScreenOfEveryCamera) {
  constexpr unsigned kSeed = 41;
  SCOPED_TRACE(kSeed);
  std::mt19937_64 random(kSeed);
  std::size_t seen = 0, behind = 0;
  double closest = 0;
  for (const FamilyModel& m : familyModels())
    for (int round = 0; round < 12; ++round) {
      const MetricFrame& metric = m.model.mt.arrays().metric;
      const View view = parallelView(Extent(m.model.mt), random);
      ASSERT_TRUE(view.validate());
      const double pixels = round % 2 ? 1 : 8;
      const double length = std::hypot(view.forward.x, view.forward.y, view.forward.z);
      const Vec3 f{view.forward.x / length, view.forward.y / length, view.forward.z / length};
      const double flat = std::hypot(f.x, f.y);
      const Vec3 r{f.y / flat, -f.x / flat, 0}, u{-f.x * f.z / flat, -f.y * f.z / flat, flat};
      const double perUnit = view.heightPixels / view.parallelHeight;
      const auto project = [&](Vec3 p) -> std::optional<Vec2> {
        const Vec3 d{p.x - view.eye.x, p.y - view.eye.y, p.z - view.eye.z};
        const double depth = d.x * f.x + d.y * f.y + d.z * f.z;
        if (depth < view.nearDistance) return std::nullopt;
        const Vec2 s{perUnit * (d.x * r.x + d.y * r.y), perUnit * (d.x * u.x + d.y * u.y + d.z * u.z)};
        if (std::abs(s.x) > view.widthPixels / 2 || std::abs(s.y) > view.heightPixels / 2)
          return std::nullopt;
        behind += depth < 0 ? 1 : 0;
        return s;
      };
      const ViewError criterion({.view = view, .pixels = pixels}, metric);
      for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
        const auto cut = takeCut(m.model.mt, criterion, {.method = method});
        ASSERT_TRUE(cut);
        forSamples(m.model, *cut, [&](Vec3 p, double z) {
          const auto drawn = project(metric.toMetric({p.x, p.y, z})), real = project(metric.toMetric(p));
          if (!drawn || !real) return;
          ++seen;
          const double off = std::hypot(drawn->x - real->x, drawn->y - real->y);
          closest = std::max(closest, off / pixels);
          EXPECT_LE(off, pixels * (1 + 1e-6) + 1e-6) << m.name << " round " << round;
        });
      }
    }
  std::printf("%zu samples in sight, %zu behind the eye, at most %.3f of the tolerance\n", seen, behind,
              closest);
  EXPECT_GT(seen, 10000u);
  EXPECT_GT(behind, 100u);
  EXPECT_GT(closest, 0.8);
}

TEST(ParallelView, RefinesWithTheScaleAndNotWithTheDistance) {
  const MultiTriangulation& mt = mountains();
  const Extent e(mt);
  View view;
  view.eye = {(e.low.x + e.high.x) / 2, (e.low.y + e.high.y) / 2, e.high.z + e.relief()};
  view.forward = {0, 0, -1};
  view.up = {0, 1, 0};
  view.parallelHeight = e.size() / 4;
  const auto nodes = [&](const View& v) {
    const auto cut = takeCut(mt, ViewError({.view = v, .pixels = 2}, mt.arrays().metric));
    return cut ? cut->nodes : 0;
  };
  const auto before = nodes(view);
  View higher = view;
  higher.eye.z += 100 * e.size();
  EXPECT_EQ(nodes(higher), before);
  View larger = view;
  larger.widthPixels *= 4, larger.heightPixels *= 4;
  EXPECT_GT(nodes(larger), before);
  // The other way round nothing is in front of the eye, until what is behind it counts.
  View away = view;
  away.forward = {0, 0, 1};
  EXPECT_EQ(nodes(away), 0u);
  away.nearDistance = -kEverywhere;
  EXPECT_EQ(nodes(away), before);
}

TEST(ParallelView, IsRefusedByWhatIsWrongWithIt) {
  View view;
  view.parallelHeight = -1;
  EXPECT_NE(view.validate().error().message.find("parallel picture"), std::string::npos);
  view.parallelHeight = kEverywhere;
  EXPECT_FALSE(view.validate());
  view.parallelHeight = NAN;
  EXPECT_FALSE(view.validate());
  view.parallelHeight = 10;
  view.nearDistance = -5;
  EXPECT_TRUE(view.validate());
  view.farDistance = -6;
  EXPECT_NE(view.validate().error().message.find("near"), std::string::npos);
  view.parallelHeight = 0;
  view.farDistance = 5;
  EXPECT_FALSE(view.validate()) << "a near distance below 0 in perspective";
}

TEST(ParallelView, HasVerdictsOfManyBallsAsOfEachAndBoundsTheMotionThatLeavesThem) {
  std::size_t checked = 0, close = 0, turnedOver = 0;
  for (const unsigned seed : {1u, 2u, 3u}) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    const MultiTriangulation& mt = mountains();
    const MtArrays& a = mt.arrays();
    const Extent extent(mt);
    for (int round = 0; round < 100; ++round) {
      ViewError::Options o{.view = parallelView(extent, random), .pixels = std::exp(6 * unit(random) - 3)};
      if (round % 4 == 0) o.outsideError = 0.1 * extent.relief();
      const ViewError before(o, a.metric);
      const Motion rate{extent.size() * std::exp(-4 - 8 * unit(random)), std::exp(-3 - 8 * unit(random)),
                        std::exp(-3 - 8 * unit(random))};
      const std::uint32_t count = 1 + std::uint32_t(random() % 64);
      std::vector<Sphere> balls;
      std::vector<float> errors;
      for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t n = std::uint32_t(random() % mt.nodeCount());
        balls.push_back(a.sphere[n]);
        const double allowed = before.allowedError(a.sphere[n]);
        errors.push_back(std::isfinite(allowed) && i % 2 ? float(allowed * std::exp(unit(random) - 0.5))
                                                         : a.scale.decode(a.saturatedError[n]));
      }
      std::vector<float> units(count);
      const std::uint64_t answers = before.exceedingFor(balls, errors, rate, units);
      ASSERT_EQ(answers, before.exceeding(balls, errors));
      for (std::uint32_t i = 0; i < count; ++i)
        ASSERT_EQ(answers >> i & 1, errors[i] > before.allowedError(balls[i]) ? 1u : 0u);
      for (int move = 0; move < 30; ++move) {
        const double size = units[random() % count] * (move % 2 ? 0.99 : 4 * unit(random));
        if (!(size < 1e6)) continue;
        ViewError::Options after = o;
        const int kind = move % 4;
        if (kind == 0 || kind == 3) {
          const Vec3 d = direction(random);
          const double s = size * rate.travel;
          after.view.eye = {o.view.eye.x + s * d.x, o.view.eye.y + s * d.y, o.view.eye.z + s * d.z};
        }
        if (kind == 1 || kind == 3)
          turn(after.view, random() % 2 ? direction(random) : Vec3{0, 0, 1}, std::min(3.0, size * rate.turn));
        if (kind == 2) {
          const double grown = o.view.parallelHeight + (random() % 2 ? 1 : -1) * size * rate.travel;
          if (grown > 0) after.view.parallelHeight = grown;
        }
        const ViewError there(after, a.metric);
        const auto moved = there.motionSince(before);
        ASSERT_TRUE(moved);
        const double passed = moved->in(rate);
        const std::uint64_t now = there.exceeding(balls, errors);
        for (std::uint32_t i = 0; i < count; ++i) {
          const bool isSame = ((now ^ answers) >> i & 1) == 0;
          if (passed > units[i]) {
            turnedOver += isSame ? 0 : 1;
            continue;
          }
          ++checked;
          close += passed > 0.5 * units[i] ? 1 : 0;
          ASSERT_TRUE(isSame) << "ball " << i << " after " << passed << " of " << units[i] << " units";
        }
      }
      View other = o.view;
      other.parallelHeight = 0;
      other.nearDistance = std::max(0.0, other.nearDistance);
      EXPECT_FALSE(ViewError({.view = other}, a.metric).motionSince(before)) << "of another projection";
    }
  }
  std::printf("verdicts that stood: %zu, after more than half of their time: %zu; that turned later: %zu\n",
              checked, close, turnedOver);
  EXPECT_GT(close, 1000u);
  EXPECT_GT(turnedOver, 1000u);
}

TEST(ParallelView, HasPixelsOfAHeightThatDoNotChangeOnTheWay) {
  std::mt19937_64 random(60);
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    const View view = parallelView(Extent(mt), random);
    const MorphCamera camera({.view = view, .pixels = 3}, mt.arrays().metric);
    EXPECT_DOUBLE_EQ(camera.tolerance().cut + camera.tolerance().offset, 3);
    EXPECT_DOUBLE_EQ(camera.pixelsOf(2.5), 2.5);
    const double perHeight = view.heightPixels / view.parallelHeight * std::abs(mt.arrays().metric.scale.z);
    std::vector<double> pixels(mt.nodeCount());
    camera.pixelsPerHeight(mt.arrays().sphere, pixels);
    std::size_t off = 0, seen = 0;
    for (std::uint32_t n = 0; n < mt.nodeCount(); ++n) {
      const double one = camera.pixelsPerHeight(mt.arrays().sphere[n]);
      off += one == pixels[n] && (one == 0 || std::abs(one - perHeight) <= 1e-12 * perHeight) ? 0 : 1;
      seen += one > 0 ? 1 : 0;
    }
    EXPECT_EQ(off, 0u) << m.name << ", " << seen << " in sight of " << mt.nodeCount();
  }
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pixels are measured at the samples by a camera of the test's own; motions are tried at random.
#include "engine/criteria/view_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <optional>
#include <random>
#include <vector>

#include "engine/camera_moves.h"
#include "engine/cut_promises.h"
#include "engine/family_models.h"
#include "engine/front_samples.h"

namespace arete {
namespace {

TEST(ViewError, KeepsItsPixelsOnTheScreenOfEveryCamera) {
  std::mt19937_64 random(31);
  std::size_t seen = 0;
  for (const FamilyModel& m : familyModels())
    for (int round = 0; round < 25; ++round) {
      const MetricFrame& metric = m.model.mt.arrays().metric;
      const View view = randomView(Extent(m.model.mt), random);
      ASSERT_TRUE(view.validate());
      const double pixels = round % 2 ? 1 : 8;
      // A camera of the test's own: screen coordinates in pixels, or nothing out of sight.
      const double length = std::hypot(view.forward.x, view.forward.y, view.forward.z);
      const Vec3 f{view.forward.x / length, view.forward.y / length, view.forward.z / length};
      const double flat = std::hypot(f.x, f.y);
      const Vec3 r{f.y / flat, -f.x / flat, 0}, u{-f.x * f.z / flat, -f.y * f.z / flat, flat};
      const double focal = view.heightPixels / 2 / std::tan(view.verticalFieldOfView / 2);
      const auto project = [&](Vec3 p) -> std::optional<Vec2> {
        const Vec3 d{p.x - view.eye.x, p.y - view.eye.y, p.z - view.eye.z};
        const double depth = d.x * f.x + d.y * f.y + d.z * f.z;
        if (depth <= 0) return std::nullopt;
        const Vec2 s{focal * (d.x * r.x + d.y * r.y) / depth,
                     focal * (d.x * u.x + d.y * u.y + d.z * u.z) / depth};
        if (std::abs(s.x) > view.widthPixels / 2 || std::abs(s.y) > view.heightPixels / 2)
          return std::nullopt;
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
          EXPECT_LE(std::hypot(drawn->x - real->x, drawn->y - real->y), pixels * (1 + 1e-6) + 1e-6)
              << m.name << " round " << round;
        });
      }
    }
  EXPECT_GT(seen, 10000u);
}

TEST(ViewError, LeavesWhatIsOutOfSightCoarse) {
  const FamilyModel& m = familyModels().front();
  const Extent e(m.model.mt);
  View view;
  view.eye = {e.high.x + e.size(), 0, e.high.z + e.relief()};
  view.forward = {1, 0, 0};  // away from the terrain
  const auto cut = takeCut(m.model.mt, ViewError({.view = view}, m.model.mt.arrays().metric));
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->nodes, 0u);
}

TEST(ViewError, HasALimitWhichIsTheSeverityUpToWhichTrianglesAreFineEnough) {
  std::mt19937_64 random(6);
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    const ViewError view({.view = randomView(Extent(mt), random), .pixels = 3, .outsideError = 2},
                         mt.arrays().metric);
    EXPECT_EQ(view.severityLimit(), 3);
    const auto other = view.withSeverityLimit(0.25);
    EXPECT_EQ(other->severityLimit(), 0.25);
    for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t) {
      const NodeId creator = mt.creator(TriangleId(t));
      if (mt.remover(TriangleId(t)) == creator) continue;  // no triangle
      const auto corners = mt.corners(TriangleId(t), creator);
      const double severity = view.severity(mt, TriangleId(t), corners);
      if (std::abs(severity - 0.25) < 1e-7) continue;
      EXPECT_EQ(other->isFineEnough(mt, TriangleId(t), corners), severity < 0.25);
    }
  }
}

TEST(ViewError, BoundsTheMotionThatLeavesAVerdictUnchanged) {
  std::size_t checked = 0, close = 0, turnedOver = 0;
  for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    const MultiTriangulation& mt = mountains();
    const MtArrays& a = mt.arrays();
    const Extent extent(mt);
    for (int round = 0; round < 200; ++round) {
      ViewError::Options o{.view = randomView(extent, random), .pixels = std::exp(6 * unit(random) - 3)};
      if (round % 3 == 0) o.view.nearDistance = 0.05 * unit(random) * extent.size();
      if (round % 5 == 0) o.view.farDistance = (0.1 + unit(random)) * extent.size();
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
        // Around what is allowed: there the verdict turns.
        const double allowed = before.allowedError(a.sphere[n]);
        errors.push_back(std::isfinite(allowed) && i % 2 ? float(allowed * std::exp(unit(random) - 0.5))
                                                         : a.scale.decode(a.saturatedError[n]));
      }
      std::vector<float> units(count);
      const std::uint64_t answers = before.exceedingFor(balls, errors, rate, units);
      ASSERT_EQ(answers, before.exceeding(balls, errors));
      for (int move = 0; move < 40; ++move) {
        const double size = units[random() % count] * (move % 2 ? 0.99 : 4 * unit(random));
        if (!(size < 1e6)) continue;
        ViewError::Options after = o;
        const int kind = move % 5;  // one thing alone, or all
        if (kind == 0 || kind >= 3) {
          const Vec3 d = direction(random);
          const double s = size * rate.travel;
          after.view.eye = {o.view.eye.x + s * d.x, o.view.eye.y + s * d.y, o.view.eye.z + s * d.z};
        }
        if (kind == 1 || kind >= 3)
          turn(after.view, random() % 2 ? direction(random) : Vec3{0, 0, 1}, std::min(3.0, size * rate.turn));
        if (kind == 2 || kind == 4)
          after.pixels *= std::exp((random() % 2 ? 1 : -1) * std::min(20.0, size * rate.scale));
        if (move % 7 == 0) {
          after.pixels = o.pixels;
          after.view.verticalFieldOfView = std::clamp(
              o.view.verticalFieldOfView + (random() % 2 ? 1 : -1) * size * rate.turn / 4, 0.05, 3.0);
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
    }
  }
  std::printf("verdicts that stood: %zu, after more than half of their time: %zu; that turned later: %zu\n",
              checked, close, turnedOver);
  EXPECT_GT(close, 10000u);
  EXPECT_GT(turnedOver, 10000u);
}

}  // namespace
}  // namespace arete

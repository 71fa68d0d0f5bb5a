// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle is morph_oracle.h. Tolerances and jumps are checked at every sample of generated terrains, from
// random cameras and along slow flights.
#include "engine/morph/geomorphed_cut.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "engine/cut_promises.h"
#include "engine/family_models.h"
#include "engine/morph_flight.h"
#include "engine/morph_oracle.h"

namespace arete {
namespace {

TEST(GeomorphedTerrain, KeepsTheToleranceAtEverySampleInSight) {
  std::mt19937_64 random(61);
  std::size_t seen = 0;
  double closest = 0;
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    const RasterHeightfield field = m.model.rasterSamples();
    IncrementalCut cut(mt);
    GeomorphedTerrain surface(mt);
    View view;
    for (int round = 0; round < 24; ++round) {
      view = round % 4 ? moved(view, Extent(mt), 0.02, random) : randomView(Extent(mt), random);
      const double tolerance = std::array{1.0, 8.0, 3.0, 40.0, 0.3}[round % 5];
      const bool moves = round % 3 != 2;
      const MorphCamera camera({.view = view, .pixels = tolerance, .moves = moves}, mt.arrays().metric);
      follow(cut, view, camera);
      const auto update = surface.update(camera, cut);
      EXPECT_TRUE(moves || update.moving == 0);
      PlainOffsets plain(mt, view, camera.tolerance().cut, camera.tolerance().offset);
      std::size_t off = 0;
      const auto over = heightsOver(m.model, cut.triangles(), [&](std::uint32_t v) {
        const double offset = surface.offset(VertexId(v)), expected = plain.of(v).offset;
        off += std::abs(offset - expected) > 1e-5 * (std::abs(expected) + 1e-3 * Extent(mt).relief()) ? 1 : 0;
        return mt.position(VertexId(v)).z + offset;
      });
      EXPECT_EQ(off, 0u) << m.name << " round " << round;
      const double worst = worstPixels(m.model, PlainCamera(view), field.heights, over, &seen);
      EXPECT_LE(worst, tolerance * (1 + 1e-6) + 1e-5) << m.name << " round " << round;
      closest = std::max(closest, worst / tolerance);
    }
  }
  EXPECT_GT(seen, 10000u);
  std::printf("%zu samples in sight, at most %.3f of the tolerance\n", seen, closest);
}

TEST(GeomorphedTerrain, ShowsAVertexFirstOnTheSurfaceThatItRefinesAndAtLastAtItsOwnHeight) {
  std::mt19937_64 random(62);
  std::size_t appeared = 0, clamped = 0, resting = 0;
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    const Extent extent(mt);
    IncrementalCut cut(mt);
    GeomorphedTerrain surface(mt);
    MorphFlight flight(mt, 100, random);
    for (int round = 0; round < 30; ++round) {
      flight.fly();
      const View& view = flight.view;
      const MorphCamera camera({.view = view, .pixels = flight.pixels}, mt.arrays().metric);
      follow(cut, view, camera);
      surface.update(camera, cut);
      PlainOffsets plain(mt, view, camera.tolerance().cut, camera.tolerance().offset);
      const double slack = 1e-5 * extent.relief();
      for (std::uint32_t n = 0; n < mt.nodeCount(); ++n) {
        if (!cut.contains(NodeId(n))) continue;
        const auto& expected = plain.of(mt.apex(NodeId(n)).index());
        const double offset = surface.offset(mt.apex(NodeId(n)));
        EXPECT_LE(std::abs(offset), expected.most * (1 + 1e-6)) << m.name;
        if (expected.rho >= 2 * camera.tolerance().cut * (1 + 1e-9)) {
          EXPECT_EQ(offset, 0) << m.name;
          ++resting;
        } else if (expected.rho <= 1.01 * camera.tolerance().cut) {
          ++appeared;
          if (std::abs(expected.onFloor) > expected.most)
            ++clamped;
          else
            EXPECT_NEAR(offset, expected.onFloor, 0.011 * std::abs(mt.saturatedError(NodeId(n))) + slack)
                << m.name;
        }
      }
    }
  }
  EXPECT_GT(appeared, 100u);
  EXPECT_GT(resting, 1000u);
  std::printf("%zu just appeared, %zu of them clamped; %zu at rest\n", appeared, clamped, resting);
}

TEST(GeomorphedTerrain, JumpsNowhereByMoreThanItReports) {
  std::mt19937_64 random(63);
  std::size_t updates = 0;
  for (const bool moves : {true, false}) {
    std::vector<double> found, reported;
    for (const FamilyModel& m : familyModels()) {
      const MultiTriangulation& mt = m.model.mt;
      const MetricFrame& metric = mt.arrays().metric;
      IncrementalCut cut(mt);
      GeomorphedTerrain surface(mt);
      std::optional<MorphFlight> flight;
      for (int round = 0; round < 80; ++round) {
        // Slow flights; now and then a leap.
        if (round % 20 == 0) flight.emplace(mt, round < 40 ? 1000 : 100, random);
        flight->fly();
        const View& view = flight->view;
        const MorphCamera camera({.view = view, .pixels = flight->pixels, .moves = moves}, metric);
        const std::vector<std::uint32_t> before(cut.triangles().begin(), cut.triangles().end());
        follow(cut, view, camera);
        const auto update = surface.update(camera, cut);
        // Both fronts with the offsets that this camera gives: no continuous motion is left between them.
        PlainOffsets plain(mt, view, camera.tolerance().cut, camera.tolerance().offset);
        const auto height = [&](std::uint32_t v) { return mt.position(VertexId(v)).z + plain.of(v).offset; };
        const auto old = heightsOver(m.model, before, height),
                   now = heightsOver(m.model, cut.triangles(), height);
        const PlainCamera plainCamera(view);
        double worst = 0;
        for (std::size_t i = 0; i < old.size(); ++i) {
          if (std::isnan(old[i]) || std::isnan(now[i])) continue;
          const double x = double(i % m.model.columns), y = double(i / m.model.columns);
          const Vec3 a = metric.toMetric({x, y, old[i]}), b = metric.toMetric({x, y, now[i]});
          if (plainCamera.sees(a) || plainCamera.sees(b)) worst = std::max(worst, plainCamera.between(a, b));
        }
        EXPECT_LE(worst, update.jumpPixels * (1 + 1e-5) + 1e-4) << m.name << " round " << round;
        ++updates;
        if (round % 20 == 0) continue;
        found.push_back(worst / flight->pixels);
        reported.push_back(update.jumpPixels / flight->pixels);
      }
    }
    std::ranges::sort(found);
    std::ranges::sort(reported);
    std::printf(
        "moving %d: jumps of the tolerance, 90 %% %.3f, 99 %% %.3f; reported, 90 %% %.3f, 99 %% %.3f\n",
        moves, found[found.size() * 9 / 10], found[found.size() * 99 / 100],
        reported[reported.size() * 9 / 10], reported[reported.size() * 99 / 100]);
  }
  EXPECT_GT(updates, 1000u);
}

TEST(GeomorphedTerrain, ReportsItsChangesAndRestsWhenTheCameraRests) {
  std::mt19937_64 random(64);
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    IncrementalCut cut(mt);
    GeomorphedTerrain surface(mt);
    std::vector<float> mine(mt.vertexCount(), 0);
    View view = randomView(Extent(mt), random);
    for (int round = 0; round < 12; ++round) {
      view = round % 6 ? moved(view, Extent(mt), 0.01, random) : randomView(Extent(mt), random);
      const MorphCamera camera({.view = view, .pixels = 3}, mt.arrays().metric);
      for (const bool again : {false, true}) {
        follow(cut, view, camera);
        const auto update = surface.update(camera, cut);
        for (const auto& change : surface.changes()) mine[change.vertex.index()] = change.offset;
        if (again) {
          EXPECT_TRUE(surface.changes().empty()) << m.name;
          EXPECT_EQ(update.jumpPixels, 0) << m.name;
        }
        for (std::uint32_t v = 0; v < mt.vertexCount(); ++v)
          ASSERT_EQ(mine[v], surface.offset(VertexId(v))) << m.name;
      }
    }
  }
}

}  // namespace
}  // namespace arete

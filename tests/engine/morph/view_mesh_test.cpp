// SPDX-License-Identifier: GPL-3.0-or-later
//
// A renderer of the test's own: it updates its buffers by the changes it receives, and everything is asked of
// these buffers. Its camera, and what a surface over the samples is, are morph_oracle.h's.
#include "engine/morph/view_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "datasets/families.h"
#include "engine/cut_promises.h"
#include "engine/family_models.h"
#include "engine/laws/validate.h"
#include "engine/morph/geomorph.h"
#include "engine/morph_oracle.h"
#include "engine/mt/exaggerated_mt.h"

namespace arete {
namespace {

/// Buffers as a renderer has them.
struct Buffers {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  explicit Buffers(const ViewMesh& mesh)
      : positions(mesh.positions()), triangles(mesh.triangles().begin(), mesh.triangles().end()) {}

  void apply(const ViewMesh& mesh) {
    triangles.resize(mesh.triangles().size());
    for (const ViewMesh::Places& p : mesh.changedPlaces())
      std::copy_n(mesh.triangles().begin() + p.first, p.count, triangles.begin() + p.first);
    for (const ViewMesh::HeightChange& change : mesh.heightChanges())
      positions[change.vertex][2] = change.height;
  }

  void expectLike(const ViewMesh& mesh, const std::string& where) const {
    EXPECT_TRUE(std::ranges::equal(triangles, mesh.triangles())) << where;
    EXPECT_TRUE(positions == mesh.positions()) << where;
    ASSERT_EQ(mesh.triangleIds().size(), triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i)
      ASSERT_EQ(triangles[i], mesh.mt().corners(TriangleId(mesh.triangleIds()[i]))) << where;
  }

  /// Over the samples, in the unit of heights.
  std::vector<double> surface(const TerrainModel& model, const ViewMesh& mesh) const {
    const MetricFrame& metric = mesh.mt().arrays().metric;
    return heightsOver(model, mesh.triangleIds(), [&](std::uint32_t v) {
      return (double(positions[v][2]) + mesh.origin().z) / metric.scale.z + metric.origin.z;
    });
  }
};

/// Pixels to allow for floats: half of the last bit of the largest coordinate, seen from near by.
double worstOf(const TerrainModel& model, const ViewMesh& mesh, const Buffers& buffers, const View& view) {
  TerrainModel in = model;
  in.mt = mesh.mt();
  return worstPixels(in, PlainCamera(view), model.rasterSamples().heights, buffers.surface(in, mesh));
}

TEST(ViewMesh, IsWithinTheToleranceInBuffersThatAreKeptByChanges) {
  std::mt19937_64 random(70);
  for (const FamilyModel& m : familyModels())
    for (const double heightScale : {1.0, 2.5}) {
      auto mesh = ViewMesh::create(m.model.mt, {.heightScale = heightScale});
      ASSERT_TRUE(mesh);
      const Extent extent(mesh->mt());
      Buffers buffers(*mesh);
      EXPECT_EQ(buffers.triangles.size(), m.model.mt.rootTriangleCount());
      for (int round = 0; round < 16; ++round) {
        View view = randomView(extent, random);
        if (round % 2) view.nearDistance = 0.02 * extent.size();
        const double pixels = round % 3 ? 1 + double(random() % 20) : 0.5;
        const bool moves = round % 5 != 0;
        const auto report = mesh->update(view, {.pixels = pixels, .geomorph = moves});
        ASSERT_TRUE(report) << report.error().describe();
        buffers.apply(*mesh);
        const std::string where = m.name + " round " + std::to_string(round);
        buffers.expectLike(*mesh, where);
        EXPECT_TRUE(report->isComplete);
        EXPECT_EQ(report->pixels, pixels);
        EXPECT_EQ(report->triangles, buffers.triangles.size());
        EXPECT_TRUE(moves || report->moving == 0);
        EXPECT_LE(worstOf(m.model, *mesh, buffers, view), pixels * (1 + 1e-5) + 2e-3) << where;

        const MorphCamera camera({.view = view, .pixels = pixels, .moves = moves},
                                 mesh->mt().arrays().metric);
        const auto scratch =
            takeCut(mesh->mt(),
                    ViewError({.view = view, .pixels = camera.tolerance().cut}, mesh->mt().arrays().metric),
                    {.method = CutMethod::saturated});
        std::vector<std::uint32_t> ids(mesh->triangleIds().begin(), mesh->triangleIds().end());
        std::ranges::sort(ids);
        EXPECT_EQ(ids, scratch->ids) << where;

        const auto again = mesh->update(view, {.pixels = pixels, .geomorph = moves});
        ASSERT_TRUE(again);
        EXPECT_TRUE(mesh->changedPlaces().empty() && mesh->heightChanges().empty()) << where;
        EXPECT_EQ(again->jumpPixels, 0) << where;
      }
    }
}

TEST(ViewMesh, KeepsABudgetAndTheToleranceThatItReports) {
  std::mt19937_64 random(71);
  std::size_t bound = 0, finite = 0;
  int mostUpdates = 0;
  for (const FamilyModel& m : familyModels()) {
    auto mesh = ViewMesh::create(m.model.mt);
    ASSERT_TRUE(mesh);
    const Extent extent(mesh->mt());
    Buffers buffers(*mesh);
    const std::uint32_t roots = m.model.mt.rootTriangleCount(), finest = m.model.mt.finestTriangleCount();
    for (int round = 0; round < 20; ++round) {
      View view = randomView(extent, random);
      view.eye.z += extent.relief();
      view.nearDistance = 0.05 * extent.size();
      const auto budget = roots + std::uint32_t(random() % (finest - roots + 1)) / (1 + round % 3);
      const auto report = mesh->update(view, {.pixels = 0.5, .maxTriangles = budget});
      ASSERT_TRUE(report) << report.error().describe();
      buffers.apply(*mesh);
      buffers.expectLike(*mesh, m.name);
      EXPECT_LE(report->triangles, budget);
      bound += report->isComplete ? 0 : 1;
      finite += std::isfinite(report->pixels) ? 1 : 0;
      EXPECT_LE(worstOf(m.model, *mesh, buffers, view), report->pixels * (1 + 1e-5) + 2e-3)
          << m.name << " round " << round;
      // A picture that stands comes to rest, though the exchange under a budget may take a few updates.
      bool isStill = false;
      for (int again = 0; again < 20 && !isStill; ++again) {
        ASSERT_TRUE(mesh->update(view, {.pixels = 0.5, .maxTriangles = budget}));
        buffers.apply(*mesh);
        isStill = mesh->changedPlaces().empty() && mesh->heightChanges().empty();
        mostUpdates = std::max(mostUpdates, again + 1);
      }
      EXPECT_TRUE(isStill) << m.name << " round " << round;
    }
  }
  std::printf("still after %d updates at most\n", mostUpdates);
  EXPECT_GT(bound, 50u);
  EXPECT_GT(finite, 100u);
}

TEST(ViewMesh, StopsAtADeadlineSaysHowFarItCameAndGetsThereInTheEnd) {
  std::mt19937_64 random(72);
  std::size_t rounds = 0;
  for (const FamilyModel& m : familyModels()) {
    auto mesh = ViewMesh::create(m.model.mt);
    ASSERT_TRUE(mesh);
    Buffers buffers(*mesh);
    for (int place = 0; place < 2; ++place) {
      View view = randomView(Extent(mesh->mt()), random);
      view.nearDistance = 0.05 * Extent(mesh->mt()).size();
      bool isComplete = false;
      for (int round = 0; round < 3000 && !isComplete; ++round, ++rounds) {
        const auto report =
            mesh->update(view, {.pixels = 2, .deadline = strikeAfter(10 + int(random() % 40))});
        ASSERT_TRUE(report);
        buffers.apply(*mesh);
        isComplete = report->isComplete;
        if (round % 5 == 0 || isComplete) {
          buffers.expectLike(*mesh, m.name);
          EXPECT_LE(worstOf(m.model, *mesh, buffers, view), report->pixels * (1 + 1e-5) + 2e-3) << m.name;
        }
      }
      EXPECT_TRUE(isComplete) << m.name;
    }
  }
  EXPECT_GT(rounds, 100u);
}

TEST(ViewMesh, IsTheSameForAnyNumberOfThreads) {
  const MultiTriangulation& mt = familyModels().back().model.mt;
  std::vector<std::vector<std::array<float, 3>>> positions;
  std::vector<std::vector<std::uint32_t>> ids;
  for (const int threads : {1, 2, 4}) {
    RunContext context;
    context.threads = threads;
    std::mt19937_64 random(73);
    auto mesh = ViewMesh::create(mt);
    ASSERT_TRUE(mesh);
    for (int round = 0; round < 10; ++round)
      ASSERT_TRUE(mesh->update(randomView(Extent(mt), random), {.pixels = 3}, context));
    positions.push_back(mesh->positions());
    ids.emplace_back(mesh->triangleIds().begin(), mesh->triangleIds().end());
  }
  EXPECT_TRUE(positions[0] == positions[1] && positions[0] == positions[2]);
  EXPECT_TRUE(ids[0] == ids[1] && ids[0] == ids[2]);
}

TEST(ViewMesh, DoesNotShakeInCoordinatesOfMillions) {
  // Six kilometres of a tile of UTM.
  std::mt19937_64 random(74);
  std::uniform_real_distribution<double> unit(0, 1);
  PointHeightfield field;
  for (int i = 0; i < 4000; ++i) {
    const double x = 6000 * unit(random), y = 6000 * unit(random);
    field.positions.push_back({482000.123 + x, 5412000.456 + y});
    field.heights.push_back(1800 + 300 * std::sin(x / 700) * std::cos(y / 900));
  }
  const auto model = build(field);
  ASSERT_TRUE(model) << model.error().describe();
  auto mesh = ViewMesh::create(model->mt);
  ASSERT_TRUE(mesh);
  View view;
  view.eye = model->mt.arrays().metric.toMetric({485000, 5413000, 2500});
  view.forward = {0, 1, -0.2};
  ASSERT_TRUE(mesh->update(view, {.pixels = 1, .geomorph = false}));
  const auto positions = mesh->positions();
  double worst = 0;
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    const Vec3 exact = model->mt.arrays().metric.toMetric(model->mt.position(VertexId(v)));
    worst = std::max({worst, std::abs(positions[v][0] + mesh->origin().x - exact.x),
                      std::abs(positions[v][1] + mesh->origin().y - exact.y),
                      std::abs(positions[v][2] + mesh->origin().z - exact.z)});
  }
  EXPECT_LE(worst, 0.25e-3);
}

TEST(ViewMesh, RefusesWhatMakesNoSenseAndChangesNothing) {
  const MultiTriangulation& mt = familyModels().front().model.mt;
  const auto flat = ViewMesh::create(mt, {.heightScale = 0});
  ASSERT_FALSE(flat);
  EXPECT_NE(flat.error().describe().find("above 0"), std::string::npos);
  auto mesh = ViewMesh::create(mt);
  ASSERT_TRUE(mesh);
  View view;
  EXPECT_FALSE(mesh->update(view, {.pixels = 0}));
  EXPECT_FALSE(mesh->update(view, {.pixels = NAN}));
  EXPECT_FALSE(mesh->update(view, {.pixels = 1, .maxTriangles = 0}));
  view.eye.x = NAN;
  const auto refused = mesh->update(view, {});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().describe().find("finite"), std::string::npos);
  EXPECT_EQ(mesh->triangles().size(), mt.rootTriangleCount());
}

TEST(ExaggeratedMt, KeepsTheLawsAndTheHeights) {
  for (const FamilyModel& m : familyModels())
    for (const double factor : {0.1, 1.0, 3.0, 50.0}) {
      const MultiTriangulation mt = exaggerated(m.model.mt, factor);
      const auto valid = validate(mt);
      EXPECT_TRUE(valid) << m.name << " " << factor << " " << valid.error().describe();
      EXPECT_EQ(mt.vertexCount(), m.model.mt.vertexCount());
      EXPECT_DOUBLE_EQ(mt.arrays().metric.scale.z, factor * m.model.mt.arrays().metric.scale.z);
      if (factor != 1) continue;
      double widest = 0;
      for (std::uint32_t n = 0; n < mt.nodeCount(); ++n)
        widest =
            std::max<double>(widest, mt.arrays().sphere[n].radius / m.model.mt.arrays().sphere[n].radius);
      EXPECT_LE(widest, 1.2) << m.name;  // children come in another order
    }
}

}  // namespace
}  // namespace arete

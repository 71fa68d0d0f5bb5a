// SPDX-License-Identifier: GPL-3.0-or-later
//
// The mesh of a fit against scans of all samples, before and after removals of leaves.
#include "terrain/fit/mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "datasets/random.h"
#include "terrain/fit_fixture.h"
#include "terrain/model/plan_orientation.h"

namespace arete {
namespace {

using namespace fit_test;

std::array<Vec2, 3> planOf(const FitMesh& mesh, const FitMesh::Corners& corners) {
  return {mesh.plan(mesh.mtVertex(corners[0])), mesh.plan(mesh.mtVertex(corners[1])),
          mesh.plan(mesh.mtVertex(corners[2]))};
}

bool covers(const std::array<Vec2, 3>& p, Vec2 q) {
  return planOrientation(p[0], p[1], q) >= 0 && planOrientation(p[1], p[2], q) >= 0 &&
         planOrientation(p[2], p[0], q) >= 0;
}

/// max |z_TIN - z_sample| over all samples that a triangle covers, with exact weights.
double errorByScan(const FitMesh& mesh, std::uint32_t slot) {
  const FitMesh::Corners& corners = mesh.triangle(slot).corners;
  const std::array<Vec2, 3> p = planOf(mesh, corners);
  double worst = 0;
  for (std::uint32_t s = 0; s < mesh.mt().vertexCount(); ++s) {
    if (!covers(p, mesh.plan(s))) continue;
    const auto w = exactPlanWeights(p[0], p[1], p[2], mesh.plan(s));
    double z = 0;
    for (int i = 0; i < 3; ++i) z += w[i] * mesh.heights()[corners[i]];
    worst = std::max(worst, std::abs(z - mesh.mt().vertices().height(VertexId(s))));
  }
  return worst;
}

/// Stars and lists of samples agree with the triangles.
void expectConsistent(const FitMesh& mesh) {
  std::vector<std::multiset<std::uint32_t>> stars(mesh.vertexCount());
  std::vector<int> listed(mesh.mt().vertexCount(), 0);
  std::uint32_t live = 0;
  for (std::uint32_t t = 0; t < mesh.slotCount(); ++t) {
    if (!mesh.isLive(t)) continue;
    ++live;
    const auto p = planOf(mesh, mesh.triangle(t).corners);
    for (const std::uint32_t v : mesh.triangle(t).corners) stars[v].insert(t);
    mesh.forSamples(t, [&](std::uint32_t s) {
      ++listed[s];
      EXPECT_TRUE(covers(p, mesh.plan(s))) << "sample " << s << " of triangle " << t;
    });
  }
  EXPECT_EQ(live, mesh.triangleCount());
  for (const int count : listed) ASSERT_EQ(count, 1);
  for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v) {
    std::multiset<std::uint32_t> star;
    if (mesh.isIn(v)) mesh.forStar(v, [&](std::uint32_t t) { star.insert(t); });
    ASSERT_EQ(star, stars[v]) << "vertex " << v;
    EXPECT_EQ(mesh.isIn(v), !stars[v].empty());
    EXPECT_EQ(mesh.indexOf(mesh.mtVertex(v)), v);
  }
}

TEST(FitMesh, HasTheErrorsThatAScanOfAllSamplesFinds) {
  for (const CutOfModel& c : cutsOfAllFamilies(3)) {
    SCOPED_TRACE(c.name);
    const double bound = std::max(c.maxError, 1e-3);  // of flat ground 0
    FitMesh mesh = meshOf(c, bound);
    Random random(5);
    for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v) mesh.raise(v, random.between(-1, 1) * bound);
    const std::vector<double> errors = mesh.errors();
    const double slack = 1e-9 * (1 + c.model.mt.largestError());
    for (std::uint32_t t = 0; t < mesh.slotCount(); ++t) {
      ASSERT_NEAR(errors[t], errorByScan(mesh, t), slack) << "triangle " << t;
      ASSERT_LE(mesh.severity(t) * bound, errors[t] + slack);
    }
  }
}

TEST(FitMesh, GivesTheFloorBackWhenALeafIsRemoved) {
  for (const CutOfModel& c : cutsOfAllFamilies(4)) {
    SCOPED_TRACE(c.name);
    FitMesh mesh = meshOf(c, std::max(c.maxError, 1e-3));
    expectConsistent(mesh);
    for (int round = 0; round < 12; ++round) {
      const std::vector<NodeId> leaves = leavesOf(mesh);
      if (leaves.empty()) break;
      const NodeId leaf = leaves[std::size_t(round) % leaves.size()];
      const std::uint32_t apex = mesh.indexOf(c.model.mt.apex(leaf).index());
      std::vector<FitMesh::FloorTriangle> floor;
      for (const std::uint32_t id : c.model.mt.floor(leaf)) {
        const auto corners = c.model.mt.corners(TriangleId(id));
        floor.push_back({.id = id});
        for (int i = 0; i < 3; ++i) floor.back().corners[i] = mesh.indexOf(corners[i]);
      }
      bool isCovered = true;  // not where the model reaches over NODATA
      mesh.forStar(apex, [&](std::uint32_t t) {
        mesh.forSamples(t, [&](std::uint32_t s) {
          const auto over = std::ranges::find_if(
              floor, [&](const auto& f) { return covers(planOf(mesh, f.corners), mesh.plan(s)); });
          isCovered = isCovered && over != floor.end();
          if (over != floor.end()) over->samples.push_back(s);
        });
      });
      ASSERT_TRUE(isCovered);
      const std::uint32_t before = mesh.triangleCount();
      mesh.remove(leaf, floor);
      EXPECT_EQ(mesh.triangleCount(), before - (c.model.mt.isOpen(leaf) ? 1 : 2));
      EXPECT_FALSE(mesh.isIn(apex));
    }
    expectConsistent(mesh);
  }
}

}  // namespace
}  // namespace arete

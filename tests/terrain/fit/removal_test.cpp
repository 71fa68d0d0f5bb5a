// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a trial calls feasible is feasible: its removal and its heights leave all samples within their bounds.
#include "terrain/fit/removal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "terrain/fit_fixture.h"

namespace arete {
namespace {

using namespace fit_test;

constexpr double kAccepted = 1 + 1e-9;

TEST(FitPatches, RemoveLeavesOnlyWhereAllSamplesStayWithinTheirBounds) {
  int feasible = 0, refused = 0, moved = 0;
  for (const CutOfModel& c : cutsOfAllFamilies(5)) {
    SCOPED_TRACE(c.name);
    if (!(c.maxError > 0)) continue;
    FitMesh mesh = meshOf(c, c.maxError);
    mesh.setAccepted(kAccepted);
    if (worstSeverity(mesh) > kAccepted) continue;  // stored errors leave out rounding
    FitPatches patches(mesh);
    RemovalTrial trial;
    for (const NodeId leaf : leavesOf(mesh)) {
      const std::vector<double> heights = mesh.heights();
      patches.tryRemoval(leaf, 2, trial);
      ASSERT_EQ(mesh.heights(), heights) << "a trial leaves the mesh as it is";
      ASSERT_EQ(trial.node, leaf);
      ASSERT_EQ(trial.read[0], mesh.indexOf(c.model.mt.apex(leaf).index()));
      ++(trial.isFeasible ? feasible : refused);
      if (!trial.isFeasible) continue;
      ASSERT_EQ(trial.moved.size(), trial.rise.size());
      moved += trial.moved.empty() ? 0 : 1;
      for (const std::uint32_t v : trial.moved)
        EXPECT_TRUE(std::ranges::find(trial.read, v) != trial.read.end());
      FitMesh after = mesh;
      after.remove(leaf, {trial.floor.data(), trial.floorSize});
      for (std::size_t i = 0; i < trial.moved.size(); ++i) after.raise(trial.moved[i], trial.rise[i]);
      ASSERT_LE(worstSeverity(after), kAccepted + 1e-9) << "node " << leaf.index();
    }
  }
  EXPECT_GT(feasible, 20);
  EXPECT_GT(moved, 10);
  EXPECT_GT(refused, 20);
}

TEST(FitPatches, NeverMoveAFixedVertex) {
  for (const CutOfModel& c : cutsOfAllFamilies(6)) {
    SCOPED_TRACE(c.name);
    if (!(c.maxError > 0)) continue;
    FitMesh mesh = meshOf(c, c.maxError);
    mesh.setAccepted(kAccepted);
    for (std::uint32_t v = 0; v < mesh.vertexCount(); v += 2) mesh.fix(v);
    FitPatches patches(mesh);
    RemovalTrial trial;
    for (const NodeId leaf : leavesOf(mesh)) {
      patches.tryRemoval(leaf, 3, trial);
      for (const std::uint32_t v : trial.moved) ASSERT_FALSE(mesh.isFixed(v));
    }
  }
}

TEST(FitPatches, LowerTheErrorOfATriangleWithoutRaisingOtherViolations) {
  int lowered = 0;
  for (const CutOfModel& c : cutsOfAllFamilies(7)) {
    SCOPED_TRACE(c.name);
    if (!(c.maxError > 0)) continue;
    FitMesh mesh = meshOf(c, 0.9 * c.maxError);  // some triangles are beyond it
    FitPatches patches(mesh);
    for (std::uint32_t t = 0; t < mesh.slotCount(); ++t) {
      if (mesh.severity(t) <= 1 || !patches.tryTriangle(t, 2)) continue;
      ++lowered;
      FitMesh after = mesh;
      for (std::size_t i = 0; i < patches.moved().size(); ++i)
        after.raise(patches.moved()[i], patches.rises()[i]);
      ASSERT_LE(after.severity(t), 1 + 1e-9);
      for (std::uint32_t other = 0; other < mesh.slotCount(); ++other)
        ASSERT_LE(after.severity(other), std::max(1.0, mesh.severity(other)) + 1e-9) << "triangle " << other;
    }
  }
  EXPECT_GT(lowered, 3);
}

}  // namespace
}  // namespace arete

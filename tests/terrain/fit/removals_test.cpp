// SPDX-License-Identifier: GPL-3.0-or-later
//
// Removals on every family: bounds are kept, fixed vertices stay, the number of threads changes nothing.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <vector>

#include "terrain/fit/steps.h"
#include "terrain/fit_fixture.h"

namespace arete {
namespace {

using namespace fit_test;

constexpr double kAcceptedError = 1 + 1e-9;

TEST(RemoveWhatFits, KeepsTheBoundsAndRemovesATenthOfTheTriangles) {
  std::uint64_t before = 0, after = 0;
  for (const CutOfModel& c : cutsOfAllFamilies(8)) {
    SCOPED_TRACE(c.name);
    FitMesh mesh = meshOf(c, c.maxError);
    mesh.setAccepted(kAcceptedError);
    if (!(c.maxError > 0) || worstSeverity(mesh) > kAcceptedError) continue;
    before += mesh.triangleCount();
    ASSERT_TRUE(removeWhatFits(mesh, 2, {}));
    after += mesh.triangleCount();
    ASSERT_LE(worstSeverity(mesh), kAcceptedError + 1e-9);
  }
  EXPECT_LT(after, before * 9 / 10) << "at least a tenth of all triangles can go";
}

TEST(RemoveWhatFits, IsTheSameForAnyNumberOfThreads) {
  for (const CutOfModel& c : cutsOfAllFamilies(9)) {
    SCOPED_TRACE(c.name);
    if (!(c.maxError > 0)) continue;
    std::vector<double> first;
    for (const int threads : {1, 4}) {
      RunContext context;
      context.threads = threads;
      FitMesh mesh = meshOf(c, c.maxError);
      mesh.setAccepted(kAcceptedError);
      ASSERT_TRUE(removeWhatFits(mesh, 3, context));
      if (threads == 1)
        first = mesh.heights();
      else
        EXPECT_EQ(mesh.heights(), first);
    }
  }
}

TEST(RemoveWhatFits, KeepsFixedVerticesAndStopsWhenCancelled) {
  for (const CutOfModel& c : cutsOfAllFamilies(10)) {
    SCOPED_TRACE(c.name);
    if (!(c.maxError > 0)) continue;
    FitMesh mesh = meshOf(c, c.maxError);
    mesh.setAccepted(kAcceptedError);
    const std::vector<double> heights = mesh.heights();
    for (std::uint32_t v = 0; v < mesh.vertexCount(); v += 3) mesh.fix(v);
    ASSERT_TRUE(removeWhatFits(mesh, 2, {}));
    for (std::uint32_t v = 0; v < mesh.vertexCount(); v += 3) {
      EXPECT_TRUE(mesh.isIn(v));
      EXPECT_EQ(mesh.heights()[v], heights[v]);
    }
    const std::atomic<bool> cancel = true;
    RunContext context;
    context.cancel = &cancel;
    FitMesh other = meshOf(c, c.maxError);
    if (leavesOf(other).empty()) continue;
    const Status stopped = removeWhatFits(other, 2, context);
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, ErrorCode::interrupted);
  }
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every sample is in exactly one list, that of a triangle that covers it.
#include "terrain/fit/samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "terrain/fit_fixture.h"
#include "terrain/model/plan_orientation.h"

namespace arete {
namespace {

using namespace fit_test;

TEST(FitSamples, AreEachInTheListOfOneTriangleThatCoversThem) {
  for (const std::uint64_t seed : {1, 2})
    for (const CutOfModel& c : cutsOfAllFamilies(seed)) {
      SCOPED_TRACE(c.name);
      const MultiTriangulation& mt = c.model.mt;
      const NodeSet nodes = nodesOf(mt, c.cut);
      const auto sorted = [](std::vector<std::uint32_t> ids) {
        std::ranges::sort(ids);
        return ids;
      };
      EXPECT_EQ(sorted(front(mt, nodes).ids), sorted(c.cut.ids)) << "nodesOf() gives the nodes of the cut";
      for (const int threads : {1, 3}) {
        RunContext context;
        context.threads = threads;
        const auto samples = shareSamples(mt, c.cut, nodes, context);
        ASSERT_TRUE(samples) << samples.error().describe();
        std::vector<int> listed(mt.vertexCount(), 0);
        for (std::size_t t = 0; t < c.cut.triangles.size(); ++t) {
          std::array<Vec2, 3> p;
          for (int i = 0; i < 3; ++i)
            p[i] = mt.vertices().planPosition(VertexId(c.cut.vertices[c.cut.triangles[t][i]]));
          for (std::uint32_t s = samples->first[t]; s != FitSamples::kNone; s = samples->next[s]) {
            ++listed[s];
            const Vec2 q = mt.vertices().planPosition(VertexId(s));
            for (int i = 0; i < 3; ++i)
              ASSERT_GE(planOrientation(p[i], p[(i + 1) % 3], q), 0) << "sample " << s;
          }
        }
        for (std::uint32_t v = 0; v < mt.vertexCount(); ++v) ASSERT_EQ(listed[v], 1) << "sample " << v;
      }
    }
}

TEST(FitSamples, StopWhenCancelled) {
  const std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  for (const CutOfModel& c : cutsOfAllFamilies(1)) {
    const auto samples = shareSamples(c.model.mt, c.cut, nodesOf(c.model.mt, c.cut), context);
    ASSERT_FALSE(samples) << c.name;
    EXPECT_EQ(samples.error().code, ErrorCode::interrupted);
  }
}

TEST(FitSamples, AreRefusedWhereTrianglesAreNoTriangulation) {
  // As a file may say: two vertices in each other's place, all in one place, all on a line.
  for (const CutOfModel& c : cutsOfAllFamilies(3)) {
    const MtArrays& arrays = c.model.mt.arrays();
    const VertexArrays& vertices = arrays.vertices;
    for (const int kind : {0, 1, 2}) {
      SCOPED_TRACE(c.name + ", kind " + std::to_string(kind));
      std::vector<std::uint32_t> samples(vertices.samples.begin(), vertices.samples.end());
      std::vector<Vec2> plan(vertices.plan.begin(), vertices.plan.end());
      const auto change = [&](auto& of) {
        if (of.empty()) return;
        if (kind == 0) std::swap(of.front(), of.back());
        for (auto& each : of)
          if (kind == 1) each = of.front();
      };
      change(samples);
      change(plan);
      for (std::size_t i = 0; kind == 2 && i < plan.size(); ++i) plan[i].y = 2 * plan[i].x;
      for (std::size_t i = 0; kind == 2 && i < samples.size(); ++i) samples[i] %= vertices.columns;
      MtArrays changed = arrays;
      changed.vertices.samples = samples;
      changed.vertices.plan = plan;
      const MultiTriangulation mt(changed, nullptr);
      const auto shared = shareSamples(mt, c.cut, nodesOf(mt, c.cut), {});
      ASSERT_FALSE(shared);
      EXPECT_EQ(shared.error().code, ErrorCode::invalidData) << shared.error().describe();
    }
  }
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Spans of a leg over triangles of a multitriangulation, against the oracle's triangles of a front that holds
// them.
#include "terrain/sight/mt_crossing.h"

#include <gtest/gtest.h>

#include "datasets/families.h"
#include "datasets/random.h"
#include "engine/cut/cut.h"
#include "terrain/builder/build.h"
#include "terrain/sight_oracle.h"

namespace arete::test {
namespace {

void expectHeights(const std::vector<TriangleSpan>& spans, const SightLeg& leg, const SightOracle& oracle) {
  for (const TriangleSpan& span : spans) {
    ASSERT_LT(span.t0, span.t1);
    if (span.t1 - span.t0 < 1e-6) continue;
    const double t = span.t0 + 0.41 * (span.t1 - span.t0);
    const auto z = oracle.heightAt({leg.x + t * leg.dx, leg.y + t * leg.dy});
    ASSERT_TRUE(z) << t;
    EXPECT_NEAR(double(*z), span.at(t), 1e-6 * (1 + std::abs(span.at(t)))) << t;
  }
}

TEST(MtCrossing, RootSpansCoverALegInsideTheDomain) {
  constexpr std::uint64_t kSeed = 41;
  Random random(kSeed);
  const auto model = build(rasterFamilies()[3].make(33, 29, 5));
  ASSERT_TRUE(model);
  const TriangleLocator locator(model->mt);
  const SightOracle oracle(model->mt, frontOfPrefix(model->mt, 0));
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", leg " << i);
    const SightLeg leg({{random.between(0, 32), random.between(0, 28)}, 0},
                       {{random.between(0, 32), random.between(0, 28)}, 1});
    const MtCrossing crossing(locator, leg);
    std::vector<TriangleSpan> spans;
    crossing.addRoots(spans);
    MtCrossing::sort(spans);
    double done = 0;
    for (const TriangleSpan& span : spans) {
      EXPECT_LE(span.t0, done + 1e-9);
      done = std::max(done, span.t1);
    }
    EXPECT_NEAR(done, 1, 1e-9);
    expectHeights(spans, leg, oracle);
  }
}

TEST(MtCrossing, StarSpansLieOnTheTrianglesThatANodePutsInPlace) {
  constexpr std::uint64_t kSeed = 42;
  Random random(kSeed);
  const auto model = build(rasterFamilies()[3].make(33, 29, 6));
  ASSERT_TRUE(model);
  const TriangleLocator locator(model->mt);
  std::size_t found = 0;
  for (int i = 0; i < 60; ++i) {
    const std::uint32_t node = random.below(model->mt.nodeCount());
    // The last node of a prefix has its whole star in the front.
    const SightOracle oracle(model->mt, frontOfPrefix(model->mt, node + 1));
    const Vec2 apex = locator.planPosition(VertexId(model->mt.arrays().rootVertices + node));
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", node " << node);
    const SightLeg leg({{random.between(0, 32), random.between(0, 28)}, 0},
                       {{apex.x + 0.1, apex.y + 0.07}, 1});
    const MtCrossing crossing(locator, leg);
    std::vector<TriangleSpan> spans, part;
    crossing.addStar(node, 0, 1, spans);
    crossing.addStar(node, 0.95, 0.99, part);
    found += spans.size();
    expectHeights(spans, leg, oracle);
    for (const TriangleSpan& span : part) {
      EXPECT_GE(span.t0, 0.95);
      EXPECT_LE(span.t1, 0.99);
    }
  }
  EXPECT_GT(found, 100u);
}

TEST(MtCrossing, ClipsSpansAndSortsThemByWhereTheyBegin) {
  TriangleSpan span{0, 1, 10, 20, 7};
  span.cut(0.25, 0.5);
  EXPECT_EQ(span.t0, 0.25);
  EXPECT_EQ(span.t1, 0.5);
  EXPECT_DOUBLE_EQ(span.z0, 12.5);
  EXPECT_DOUBLE_EQ(span.z1, 15);
  std::vector<TriangleSpan> spans = {{0.5, 0.6, 0, 0, 1}, {0, 0.1, 0, 0, 2}, {0, 0.3, 0, 0, 3}};
  MtCrossing::sort(spans);
  EXPECT_EQ(spans[0].triangle, 3u);
  EXPECT_EQ(spans[1].triangle, 2u);
  EXPECT_EQ(spans[2].triangle, 1u);
}

}  // namespace
}  // namespace arete::test

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Costs against plain scans of the floor's triangles.
#include "terrain/simplify/cost.h"

#include <gtest/gtest.h>

#include "terrain/simplify_fixture.h"

namespace arete {
namespace {

using Cost = RemovalCost<LatticePlan, RasterError>;
using State = RemovalRecord::State;
constexpr double kHigh = SmallSimplification::kRange;

TEST(RemovalCost, IsTheLargestErrorOfTheFloorByAPlainScan) {
  for (const std::uint64_t seed : {1u, 2u}) {
    SmallSimplification small(11, 9, seed, HoleShape::delaunay);
    const Cost cost(small.state);
    int measured = 0;
    for (const VertexId v : small.vertices()) {
      Star star;
      RemovalRecord record{};
      MeasuredFloor floor;
      cost.evaluate(v, star, kHigh, record, floor);
      if (record.state == State::stuck) {
        EXPECT_TRUE(small.isFixed()[v]) << "only the raster's corners cannot be removed at first";
        continue;
      }
      ASSERT_EQ(record.state, State::exact);
      EXPECT_EQ(record.linkSize, small.linkOf(v).size());
      ASSERT_EQ(floor.triangulation.size, star.linkSize - 2);
      double worst = 0;
      for (int f = 0; f < floor.triangulation.size; ++f) {
        const auto [i, m, j] = floor.triangulation.triangles[f];
        const double plain = small.plainError(star.link[i], star.link[m], star.link[j]);
        EXPECT_NEAR(floor.errors[f], plain, 1e-9);
        worst = std::max(worst, plain);
      }
      EXPECT_NEAR(record.cost, worst, 1e-5);
      ++measured;
    }
    EXPECT_EQ(measured, 11 * 9 - 4);
  }
}

TEST(RemovalCost, OfTheFinestTriangulationIsWhatAnEvaluationFinds) {
  SmallSimplification small(11, 9, 3, HoleShape::delaunay);
  const Cost cost(small.state);
  int known = 0;
  for (const VertexId v : small.vertices()) {
    RemovalRecord byFormula{}, byEvaluation{};
    cost.evaluateInFinest(v, byFormula);
    if (byFormula.state == State::stale) continue;
    Star star;
    cost.evaluate(v, star, kHigh, byEvaluation);
    EXPECT_EQ(byFormula.state, State::exact);
    EXPECT_NEAR(byFormula.cost, byEvaluation.cost, 1e-5);
    EXPECT_EQ(byFormula.linkSize, byEvaluation.linkSize);
    ++known;
  }
  EXPECT_EQ(known, 9 * 7) << "all but the raster's border";
}

TEST(RemovalCost, AboveTheThresholdIsALowerBound) {
  for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent}) {
    SmallSimplification small(11, 9, 4, shape);
    const Cost cost(small.state);
    int bounded = 0;
    for (const VertexId v : small.vertices()) {
      Star star;
      RemovalRecord whole{}, early{};
      cost.evaluate(v, star, kHigh, whole);
      for (const double threshold : {0.01, 1.0, 3.0}) {
        early = {};
        cost.evaluate(v, star, threshold, early);
        if (early.state == State::exact) {
          EXPECT_NEAR(early.cost, whole.cost, 1e-4 * whole.cost + 1e-6);
        } else if (early.state == State::atLeast) {
          EXPECT_GT(early.cost, threshold) << "or it would be due at once";
          EXPECT_LE(early.cost, whole.cost * (1 + 1e-5));
          ++bounded;
        }
      }
    }
    EXPECT_GT(bounded, 50);
  }
}

TEST(RemovalCost, OfTheDataDependentShapeIsAtMostThatOfDelaunays) {
  SmallSimplification delaunay(11, 9, 5, HoleShape::delaunay), free(11, 9, 5, HoleShape::dataDependent);
  free.options.minimumAspect = 0;
  const Cost of(delaunay.state), ofFree(free.state);
  for (const VertexId v : free.vertices()) {
    Star star;
    RemovalRecord a{}, b{};
    of.evaluate(v, star, kHigh, a);
    ofFree.evaluate(v, star, kHigh, b);
    if (a.state == State::exact && b.state == State::exact) {
      EXPECT_LE(b.cost, a.cost * (1 + 1e-5)) << v.index();
    }
  }
}

}  // namespace
}  // namespace arete

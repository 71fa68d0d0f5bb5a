// SPDX-License-Identifier: GPL-3.0-or-later
//
// The curve against cuts, and the series of its tolerances.
#include "engine/cut/error_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "datasets/families.h"
#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

RasterHeightfield made(std::string_view name, std::uint32_t columns, std::uint32_t rows) {
  for (const RasterFamily& family : rasterFamilies())
    if (family.name == name) return family.make(columns, rows, 3);
  return {};
}

TEST(ErrorCurve, CountsWhatTheCutsHave) {
  const auto model = build(made("fractal", 40, 40));
  ASSERT_TRUE(model) << model.error().describe();
  const std::vector<double> ladder = toleranceLadder(model->mt, 100);
  ASSERT_GT(ladder.size(), 4u);
  const auto curve = errorCurve(model->mt, ladder);
  ASSERT_TRUE(curve);
  for (const CurvePoint& point : *curve)
    for (const CutMethod method : {CutMethod::minimal, CutMethod::saturated}) {
      const auto cut = takeCut(model->mt, UniformError(point.maxError), {.method = method});
      ASSERT_TRUE(cut);
      EXPECT_EQ(cut->triangles.size(),
                method == CutMethod::minimal ? point.minimalTriangles : point.saturatedTriangles);
    }
}

TEST(ErrorCurve, ClimbsInRoundSteps) {
  const auto model = build(made("fractal", 40, 40));
  ASSERT_TRUE(model);
  const std::vector<double> all = toleranceLadder(model->mt, 100), few = toleranceLadder(model->mt, 3);
  ASSERT_EQ(few.size(), 3u);
  EXPECT_TRUE(std::equal(few.begin(), few.end(), all.end() - 3));
  for (std::size_t i = 1; i < all.size(); ++i) {
    const double ratio = all[i] / all[i - 1];
    EXPECT_TRUE(std::abs(ratio - 2) < 1e-9 || std::abs(ratio - 2.5) < 1e-9) << all[i];
  }
  const auto flat = build(made("flat", 10, 10));
  ASSERT_TRUE(flat);
  EXPECT_TRUE(toleranceLadder(flat->mt, 10).empty());
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "datasets/families.h"
#include "terrain/builder/build.h"
#include "terrain/locate/ground_height.h"
#include "viewer/heights/contour_labels.h"
#include "viewer/heights/contour_levels.h"

namespace arete {
namespace {

TEST(ContourLevels, AreCountedFromAMultipleOfTheInterval) {
  for (const double interval : {0.1, 1.0, 20.0, 250.0})
    for (const double base : {-4321.0, 0.0, 3589.0, 1737400.0}) {
      const ContourLevels levels = contourLevels(interval, base, 4000);
      const double height = base + 12.34, level = (height - base) / interval + levels.shift;
      EXPECT_NEAR(std::remainder(level - height / interval, ContourLevels::kCycle), 0,
                  1e-6 * (1 + std::abs(base) / interval));
      EXPECT_GT(levels.lift, 0);
      EXPECT_LT(levels.lift * interval, std::max(1e-4 * interval, 0.002));
    }
}

TEST(ContourLabels, StandOnEveryFifthLineOfTheFinestTriangles) {
  for (const RasterFamily& family : rasterFamilies()) {
    SCOPED_TRACE(std::string(family.name) + " seed 4");
    auto model = build(family.make(90, 70, 4));
    ASSERT_TRUE(model);
    double low = INFINITY, high = -INFINITY;
    for (std::uint32_t v = 0; v < model->mt.vertexCount(); ++v) {
      low = std::min(low, model->mt.vertices().height(VertexId(v)));
      high = std::max(high, model->mt.vertices().height(VertexId(v)));
    }
    if (!(high > low)) continue;
    const double interval = (high - low) / 25;
    const auto labels = contourLabels(*model, interval);
    ASSERT_TRUE(labels);
    EXPECT_FALSE(labels->empty());
    const GroundHeights heights(*model);
    for (const ContourLabel& label : *labels) {
      EXPECT_NEAR(std::remainder(label.height, 5 * interval), 0, 1e-9 * (std::abs(high) + std::abs(low)));
      const auto ground = heights.at(label.xy);
      // Between samples without a cell there is no ground.
      EXPECT_NEAR(ground ? ground->height : label.height, label.height, 1e-6 * (high - low));
    }
  }
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/fronts/blended_order.h"

#include <gtest/gtest.h>

#include <random>

namespace arete {
namespace {

TEST(BlendedOrder, IsTheFarthestFirstAndRunsAreOfOneMaterial) {
  constexpr std::uint64_t kSeed = 61;
  std::mt19937_64 random(kSeed);
  for (int round = 0; round < 50; ++round) {
    SCOPED_TRACE("seed " + std::to_string(kSeed) + ", round " + std::to_string(round));
    BlendedOrder order;
    std::vector<double> depth;
    std::vector<std::uint32_t> material;
    const Vec3 eye{1, 2, 3}, forward = unit(Vec3{0.3, -0.4, 0.8});
    for (std::uint32_t i = 0; i < random() % 40; ++i) {
      const Vec3 middle{double(random() % 7), double(random() % 7), double(random() % 7)};
      material.push_back(std::uint32_t(random() % 3));
      depth.push_back(dot(middle - eye, forward));
      order.add({{i, i, i}, material.back(), middle});
    }
    order.sort(eye, forward);
    const auto corners = order.corners();
    ASSERT_EQ(corners.size(), depth.size());
    for (std::size_t i = 1; i < corners.size(); ++i) {
      const auto a = corners[i - 1][0], b = corners[i][0];
      EXPECT_TRUE(depth[a] > depth[b] || (depth[a] == depth[b] && a < b));
    }
    std::uint32_t at = 0;
    for (const BlendedOrder::Run& run : order.runs()) {
      EXPECT_EQ(run.first, at);
      for (std::uint32_t i = 0; i < run.count; ++i) EXPECT_EQ(material[corners[at++][0]], run.material);
    }
    EXPECT_EQ(at, corners.size());
  }
}

}  // namespace
}  // namespace arete

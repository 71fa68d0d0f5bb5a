// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/common/vertex_welder.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <tuple>
#include <vector>

namespace arete {
namespace {

TEST(VertexWelder, NumbersPositionsInTheOrderInWhichTheyCome) {
  std::mt19937 random(2);
  VertexWelder welder;
  std::map<std::tuple<double, double, double>, std::uint32_t> known;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p{double(random() % 20) / 3, double(random() % 20) * 1e6, random() % 2 ? 0.0 : -0.0};
    const auto [place, isNew] = known.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(known.size()));
    ASSERT_EQ(welder.add(p), place->second);
  }
  const std::vector<Vec3> positions = welder.take();
  ASSERT_EQ(positions.size(), known.size());
  for (const auto& [p, number] : known)
    EXPECT_EQ(positions[number], (Vec3{std::get<0>(p), std::get<1>(p), std::get<2>(p)}));
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The features of a raster against flooding (feature_surface.h), and against those of its triangles.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "datasets/families.h"
#include "terrain/feature_surface.h"
#include "terrain/features/features.h"

namespace arete {
namespace {

using namespace features_test;

TEST(FeaturesOfARaster, WithoutTrianglesAreNone) {
  for (const auto& [columns, rows] : {std::pair(0u, 0u), {1u, 1u}, {1u, 5u}, {5u, 1u}})
    EXPECT_TRUE(Surface(columns, rows, [](double c, double r) { return c + r; }).rankAsRaster().empty());
}

TEST(FeaturesOfARaster, AgreeWithFloodingOnRastersOfAllSmallSizes) {
  std::mt19937 random(31);
  for (std::uint32_t columns = 1; columns <= 7; ++columns)
    for (std::uint32_t rows = 1; rows <= 7; ++rows)
      for (const unsigned levels : {2u, 9u, 1000000u}) {
        const Surface s(columns, rows, [&](double, double) {
          return random() % 9 == 0 ? kNone : double(random() % levels);
        });
        ASSERT_EQ(s.rankAsRaster(), rankByFlooding(s))
            << columns << " x " << rows << ", " << levels << " levels";
      }
}

TEST(FeaturesOfARaster, AreThoseOfItsTrianglesOnEveryFamily) {
  for (const std::uint64_t seed : {1, 2})
    for (const RasterFamily& family : rasterFamilies()) {
      const RasterHeightfield field = family.make(41, 33, seed);
      const Surface s(field.columns, field.rows, field.heights);
      EXPECT_EQ(rankFeatures(field), s.rank()) << family.name << ", seed " << seed;
      const FeatureOptions options{.minimumPersistence = 2};
      EXPECT_EQ(rankFeatures(field, options), s.rank(options)) << family.name << ", seed " << seed;
    }
}

}  // namespace
}  // namespace arete

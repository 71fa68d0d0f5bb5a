// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/raster_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace arete {
namespace {

/// A raster with holes, and the errors of triangles over it by asking every sample.
struct Oracle {
  std::uint32_t columns, rows;
  std::vector<double> heights;

  /// A curved surface under noise of 0 to `noise`; one sample in `voidIn` is NODATA.
  Oracle(std::uint32_t width, std::uint32_t height, double noise, unsigned voidIn, std::mt19937& random)
      : columns(width), rows(height), heights(std::size_t(width) * height) {
    const double offset = random() % 2 == 0 ? 0 : 4e6, bend = double(random() % 100) / 1000;
    for (std::size_t i = 0; i < heights.size(); ++i) {
      const double x = double(i % width), y = double(i / width);
      heights[i] = offset + 3 * x - y + bend * (x * y - x * x) + noise * double(random() % 1000) / 1000;
    }
    for (double& z : heights)
      if (random() % voidIn == 0) z = std::numeric_limits<double>::quiet_NaN();
  }
  SignedBound bound(const RasterError::Corner& a, const RasterError::Corner& b,
                    const RasterError::Corner& c) const {
    SignedBound bound;
    const auto turn = [](const auto& u, const auto& v, int x, int y) {
      return (v.x - u.x) * (y - u.y) - (v.y - u.y) * (x - u.x);
    };
    const int area = turn(a, b, c.x, c.y);
    for (int y = 0; y < int(rows); ++y)
      for (int x = 0; x < int(columns); ++x) {
        const int atA = turn(b, c, x, y), atB = turn(c, a, x, y), atC = turn(a, b, x, y);
        const double z = heights[std::size_t(y) * columns + std::size_t(x)];
        if (atA >= 0 && atB >= 0 && atC >= 0 && !std::isnan(z))
          bound.include((atA * a.z + atB * b.z + atC * c.z) / area - z);
      }
    return bound;
  }
};

/// Triangles within `reach` of some sample, over rasters of up to `most` columns and rows.
void expectErrorsOfEverySample(std::uint32_t seed, std::uint32_t most, double noise, unsigned voidIn,
                               int triangles) {
  std::mt19937 random(seed);
  const std::uint32_t columns = 2 + random() % most, rows = 2 + random() % most, reach = 1 + random() % most;
  const Oracle oracle(columns, rows, noise, voidIn, random);
  const LatticePlan plan(columns, 1, 1);
  const RasterError errors(plan, oracle.heights, false);
  const auto some = [&](std::uint32_t of, std::int32_t near) {
    const std::int32_t x = near + int(random() % (2 * reach + 1)) - int(reach);
    return std::uint32_t(std::clamp(x, 0, int(of) - 1));
  };
  for (int k = 0; k < triangles; ++k) {
    const std::uint32_t x = random() % columns, y = random() % rows;
    const auto corner = [&] { return errors.corner(some(rows, int(y)) * columns + some(columns, int(x))); };
    const RasterError::Corner a = corner(), b = corner(), c = corner();
    if (std::isnan(a.z + b.z + c.z)) continue;
    if ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) <= 0) continue;
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", triangle (" << a.x << ", " << a.y << ") (" << b.x
                                    << ", " << b.y << ") (" << c.x << ", " << c.y << ")");
    const SignedBound expected = oracle.bound(a, b, c);
    const double error = std::max(expected.above, expected.below);
    SignedBound found;
    EXPECT_NEAR(errors.maximum(a, b, c, found), error, 1e-8);
    EXPECT_NEAR(found.above, expected.above, 1e-8);
    EXPECT_NEAR(found.below, expected.below, 1e-8);
    EXPECT_NEAR(errors.maximum(a, b, c, error + 1e-6), error, 1e-8);
    if (error > 1) {
      const double beyond = errors.maximum(a, b, c, error / 2);
      EXPECT_GT(beyond, error / 2);
      EXPECT_LE(beyond, error + 1e-8);
    }
  }
}

TEST(RasterError, ErrorsAreThoseOfEverySampleThatATriangleCovers) {
  for (std::uint32_t seed = 1; seed <= 60; ++seed) expectErrorsOfEverySample(seed, 30, 125, 16, 400);
}

TEST(RasterError, ErrorsOfWideTrianglesAreThoseOfEverySampleToo) {
  for (std::uint32_t seed = 1; seed <= 40; ++seed)
    for (const double noise : {0.0, 0.5, 40.0})
      for (const unsigned voidIn : {3u, 1000u, 1000000u})
        expectErrorsOfEverySample(seed, 90, noise, voidIn, 25);
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/error/raster_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace arete {
namespace {

/// A raster, and the errors of triangles over it by asking every sample.
struct Oracle {
  std::uint32_t columns, rows;
  std::vector<double> heights;
  double tolerance;  // of a difference found from these heights

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
          bound.include((atA * (a.z - z) + atB * (b.z - z) + atC * (c.z - z)) / area);
      }
    return bound;
  }
};

/// One sample in `voidIn` becomes NODATA.
void makeVoids(std::vector<double>& heights, unsigned voidIn, std::mt19937& random) {
  for (double& z : heights)
    if (random() % voidIn == 0) z = std::numeric_limits<double>::quiet_NaN();
}

/// Eighths of a unit without any order, and voids.
Oracle scattered(std::uint32_t columns, std::uint32_t rows, std::mt19937& random) {
  Oracle oracle{columns, rows, std::vector<double>(std::size_t(columns) * rows), 1e-9};
  for (double& z : oracle.heights) z = double(random() % 1000) / 8;
  makeVoids(oracle.heights, 16, random);
  return oracle;
}

/// A curved surface under noise of 0 to `noise`, near zero or high up, and voids.
Oracle curved(std::uint32_t columns, std::uint32_t rows, double noise, unsigned voidIn,
              std::mt19937& random) {
  const double offset = random() % 2 == 0 ? 0 : 4e6, bend = double(random() % 100) / 1000;
  // High up a last bit is 9e-10.
  Oracle oracle{columns, rows, std::vector<double>(std::size_t(columns) * rows), offset == 0 ? 1e-9 : 1e-8};
  for (std::size_t i = 0; i < oracle.heights.size(); ++i) {
    const double x = double(i % columns), y = double(i / columns);
    oracle.heights[i] = offset + 3 * x - y + bend * (x * y - x * x) + noise * double(random() % 1000) / 1000;
  }
  makeVoids(oracle.heights, voidIn, random);
  return oracle;
}

/// Of triangles within `reach` of some sample.
void expectErrorsOfEverySample(const Oracle& oracle, std::uint32_t reach, int triangles, std::uint32_t seed,
                               std::mt19937& random) {
  const std::uint32_t columns = oracle.columns, rows = oracle.rows;
  const LatticePlan plan(columns, 1, 1);
  const RasterError errors(plan, oracle.heights, false);
  const auto some = [&](std::uint32_t of, std::int32_t near) {
    const std::int32_t x = near + int(random() % (2 * reach + 1)) - int(reach);
    return std::uint32_t(std::clamp(x, 0, int(of) - 1));
  };
  for (int k = 0; k < triangles; ++k) {
    const std::uint32_t x = random() % columns, y = random() % rows;
    const auto corner = [&] {
      return errors.corner(VertexId(some(rows, int(y)) * columns + some(columns, int(x))));
    };
    const RasterError::Corner a = corner(), b = corner(), c = corner();
    if (std::isnan(a.z + b.z + c.z)) continue;
    if ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) <= 0) continue;
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", triangle (" << a.x << ", " << a.y << ") (" << b.x
                                    << ", " << b.y << ") (" << c.x << ", " << c.y << ")");
    const SignedBound expected = oracle.bound(a, b, c);
    const double error = std::max(expected.above, expected.below);
    SignedBound found;
    EXPECT_NEAR(errors.maximum(a, b, c, error + 1e-6, found), error, oracle.tolerance);
    EXPECT_NEAR(found.above, expected.above, oracle.tolerance);
    EXPECT_NEAR(found.below, expected.below, oracle.tolerance);
    EXPECT_NEAR(errors.maximum(a, b, c, error + 1e-6), error, oracle.tolerance);
    if (error > 1) {
      const double beyond = errors.maximum(a, b, c, error / 2);
      EXPECT_GT(beyond, error / 2);
      EXPECT_LE(beyond, error + oracle.tolerance);
    }
  }
}

TEST(RasterError, ErrorsAreThoseOfEverySampleThatATriangleCovers) {
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    std::mt19937 random(seed);
    const std::uint32_t columns = 2 + random() % 30, rows = 2 + random() % 30, reach = 1 + random() % 30;
    expectErrorsOfEverySample(scattered(columns, rows, random), reach, 400, seed, random);
  }
}

TEST(RasterError, ErrorsOfWideTrianglesAreThoseOfEverySampleToo) {
  for (std::uint32_t seed = 1; seed <= 40; ++seed)
    for (const double noise : {0.0, 0.5, 40.0})
      for (const unsigned voidIn : {3u, 1000u, 1000000u}) {
        std::mt19937 random(seed);
        const std::uint32_t columns = 2 + random() % 150, rows = 2 + random() % 150,
                            reach = 1 + random() % 150;
        expectErrorsOfEverySample(curved(columns, rows, noise, voidIn, random), reach, 25, seed, random);
      }
}

/// The greatest common divisor of a and b, and a x + b y = it.
struct Bezout {
  std::int64_t divisor, x, y;
};
Bezout bezout(std::int64_t a, std::int64_t b) {
  if (b == 0) return {std::abs(a), a < 0 ? -1 : 1, 0};
  const Bezout rest = bezout(b, a % b);
  return {rest.divisor, rest.y, rest.x - a / b * rest.y};
}

/// Triangles of thousands of columns and rows and an area of a few cells: their plane is known by differences
/// of large numbers. The oracle works in whole numbers of 128 bits.
TEST(RasterError, BoundsOfNeedlesAreNeverTooSmall) {
  __extension__ using Wide = __int128;
  constexpr std::int64_t kSide = 2048, kUnits = 1024;
  std::mt19937_64 random(20261123);
  std::vector<double> heights(std::size_t(kSide * kSide));
  for (double& z : heights) z = double(random() % 1'000'000) / kUnits;
  const LatticePlan plan(kSide, 1, 1);
  const RasterError errors(plan, heights, false);
  const auto units = [](double z) { return static_cast<std::int64_t>(z * kUnits); };
  const auto coordinate = [&] { return std::int64_t(random() % std::uint64_t(kSide)); };
  for (int needles = 0; needles < 5000;) {
    const std::int64_t ax = coordinate(), ay = coordinate(), bx = coordinate(), by = coordinate();
    const std::int64_t dx = bx - ax, dy = by - ay, area = 4 + std::int64_t(random() % 40);
    if (std::abs(dx) < 700 || std::abs(dy) < 700) continue;
    // c is near the middle of the segment: dx (cy - ay) - dy (cx - ax) = area.
    const Bezout one = bezout(dx, dy);
    if (one.divisor != 1) continue;
    std::int64_t cx = -area * one.y, cy = area * one.x;
    const std::int64_t along = std::llround((double(dx) / 2 - double(cx)) / double(dx));
    cx += ax + along * dx;
    cy += ay + along * dy;
    if (cx < 0 || cy < 0 || cx >= kSide || cy >= kSide) continue;
    ++needles;
    const auto corner = [&](std::int64_t x, std::int64_t y) {
      return errors.corner(VertexId(std::uint32_t(y * kSide + x)));
    };
    const RasterError::Corner a = corner(ax, ay), b = corner(bx, by), c = corner(cx, cy);
    SignedBound found;
    errors.maximum(a, b, c, 1e300, found);
    const auto turn = [](const auto& u, const auto& v, std::int64_t x, std::int64_t y) {
      return (v.x - u.x) * (y - u.y) - (v.y - u.y) * (x - u.x);
    };
    Wide most = 0, least = 0;
    for (std::int64_t y = std::min({ay, by, cy}); y <= std::max({ay, by, cy}); ++y) {
      const auto middle = std::int64_t(double(ax) + double(dx) * double(y - ay) / double(dy));
      for (std::int64_t x = std::max<std::int64_t>(0, middle - 3); x <= std::min(kSide - 1, middle + 3);
           ++x) {
        const std::int64_t atA = turn(b, c, x, y), atB = turn(c, a, x, y), atC = turn(a, b, x, y),
                           z = units(heights[std::size_t(y * kSide + x)]);
        if (atA < 0 || atB < 0 || atC < 0) continue;
        const Wide difference =
            Wide(atA) * (units(a.z) - z) + Wide(atB) * (units(b.z) - z) + Wide(atC) * (units(c.z) - z);
        most = std::max(most, difference);
        least = std::min(least, difference);
      }
    }
    const double unit = double(area * kUnits), slack = 2e-12;  // 8 ulp of the heights
    ASSERT_GE(found.above + slack, double(most) / unit) << "needle " << needles;
    ASSERT_GE(found.below + slack, -double(least) / unit) << "needle " << needles;
    ASSERT_LE(found.above, double(most) / unit + 1e-4) << "needle " << needles;
  }
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
// The curve of a flight: true to its points, its length and its heights.
#include "viewer/camera/path_curve.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "viewer/camera_models.h"

namespace arete {
namespace {

using test::apart;
using test::turned;

TEST(PathCurve, MeetsItsPointsAtTheirLengthsAndIsTrueToLength) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    std::vector<Vec3> points(2 + random.below(9));
    for (Vec3& p : points) p = {random.between(-1e3, 1e3), random.between(-1e3, 1e3), random.between(0, 500)};
    const bool isClosed = points.size() > 3 && seed % 2 == 0;
    if (isClosed) points.back() = points.front();
    const PathCurve path(points, isClosed);
    for (std::size_t i = 0; i < points.size(); ++i)
      ASSERT_LT(apart(path.at(path.lengthsAtPoints()[i]), points[i]), 1e-6) << "point " << i;
    // An inscribed polygon is shorter than the curve, by less and less; a side across a sharp bend is looked
    // at again with more corners.
    const auto polygon = [&](double from, double to, int sides) {
      double length = 0;
      for (int i = 0; i < sides; ++i)
        length +=
            apart(path.at(from + (to - from) * i / sides), path.at(from + (to - from) * (i + 1) / sides));
      return length;
    };
    const int n = 5000;
    const double side = path.length() / n;
    for (int i = 0; i < n; ++i) {
      const double chord = polygon(side * i, side * (i + 1), 1);
      ASSERT_LE(chord, side * (1 + 1e-6)) << "side " << i;
      if (chord < side * (1 - 1e-5)) {
        ASSERT_GE(polygon(side * i, side * (i + 1), 300), side * (1 - 1e-3)) << "side " << i;
      }
    }
  }
}

TEST(PathCurve, RunsStraightThroughPointsOnALineAndStaysBetweenHeights) {
  const std::vector<Vec3> line = {{0, 0, 0}, {3, 4, 0}, {30, 40, 0}, {36, 48, 0}};
  const PathCurve straight(line);
  EXPECT_NEAR(straight.length(), 60, 1e-9);
  for (double s = 0; s <= 60; s += 0.5) EXPECT_LT(apart(straight.at(s), {0.6 * s, 0.8 * s, 0}), 1e-9);
  const std::vector<Vec3> cliff = {{0, 0, 100}, {50, 0, 100}, {60, 0, 900}, {200, 0, 900}, {300, 0, 300}};
  const PathCurve climb(cliff);
  const auto at = climb.lengthsAtPoints();
  for (std::size_t leg = 0; leg + 1 < cliff.size(); ++leg)
    for (int i = 0; i <= 100; ++i) {
      const Vec3 p = climb.at(at[leg] + (at[leg + 1] - at[leg]) * i / 100);
      EXPECT_GE(p.z, std::min(cliff[leg].z, cliff[leg + 1].z) - 1e-9);
      EXPECT_LE(p.z, std::max(cliff[leg].z, cliff[leg + 1].z) + 1e-9);
    }
}

}  // namespace
}  // namespace arete

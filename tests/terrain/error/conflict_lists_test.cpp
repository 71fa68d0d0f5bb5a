// SPDX-License-Identifier: GPL-3.0-or-later
//
// Against CGAL's exact orientation and a plane solved by Cramer's rule in long doubles.
#include "terrain/error/conflict_lists.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace arete {
namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2;

struct Numbers {
  std::uint64_t state;
  double operator()(double from, double to) {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    return from + double(state >> 11) / 9007199254740992.0 * (to - from);
  }
};

int orientation(const Vec3& a, const Vec3& b, const Vec3& c) {
  return static_cast<int>(CGAL::orientation(Point(a.x, a.y), Point(b.x, b.y), Point(c.x, c.y)));
}
bool covers(const std::array<Vec3, 3>& t, const Vec3& p) {
  return orientation(t[0], t[1], p) >= 0 && orientation(t[1], t[2], p) >= 0 &&
         orientation(t[2], t[0], p) >= 0;
}
long double difference(const std::array<Vec3, 3>& t, const Vec3& p) {
  using Long = long double;
  const Long bx = Long(t[1].x) - t[0].x, by = Long(t[1].y) - t[0].y, cx = Long(t[2].x) - t[0].x,
             cy = Long(t[2].y) - t[0].y, x = Long(p.x) - t[0].x, y = Long(p.y) - t[0].y;
  const Long area = bx * cy - by * cx, u = (x * cy - y * cx) / area, w = (bx * y - by * x) / area;
  return t[0].z + u * (Long(t[1].z) - t[0].z) + w * (Long(t[2].z) - t[0].z) - p.z;
}

struct Case {
  Vec3 offset;
  double width, height, relief;
};

class ConflictListsTest : public testing::TestWithParam<Case> {
 protected:
  Vec3 somewhere(Numbers& number) const {
    const Case& c = GetParam();
    return {c.offset.x + number(0, c.width), c.offset.y + number(0, c.height),
            c.offset.z + number(0, c.relief)};
  }
};

TEST_P(ConflictListsTest, MissesNoCoveredPointBeyondTheBoundsAndIsCertainOfNoneOutside) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    Numbers number{seed};
    const Vec3 apex = somewhere(number);
    std::array<Vec3, 3> t{somewhere(number), somewhere(number), somewhere(number)};
    if (orientation(t[0], t[1], t[2]) < 0) std::swap(t[1], t[2]);
    if (orientation(t[0], t[1], t[2]) <= 0) continue;
    std::vector<Vec3> points = {apex};
    for (int i = 0; i < 400 + int(seed); ++i) {
      Vec3 p = somewhere(number);
      const auto along = [&](int from, int to) {  // within rounding of an edge
        const double s = number(0, 1);
        p.x = t[from].x + s * (t[to].x - t[from].x);
        p.y = t[from].y + s * (t[to].y - t[from].y);
      };
      if (i % 5 == 1) along(0, 1);
      if (i % 5 == 2) along(1, 2);
      if (i % 7 == 3) p = {t[2].x, t[2].y, p.z};
      points.push_back(p);
    }
    ConflictLists below;
    below.clear(apex);
    Vec3 reach;
    const auto reachTo = [&](const Vec3& p) {
      reach = {std::max(reach.x, std::abs(p.x - apex.x)), std::max(reach.y, std::abs(p.y - apex.y)),
               std::max(reach.z, std::abs(p.z - apex.z))};
    };
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      below.add(VertexId(i), points[i]);
      reachTo(points[i]);
    }
    for (const Vec3& corner : t) reachTo(corner);
    below.close(reach);
    ASSERT_EQ(below.size(), points.size());
    const ConflictLists::Triangle triangle(below, t[0], t[1], t[2]);

    std::vector<int> found(points.size(), 0);
    for (auto f = triangle.nextCovered(0); f.index != below.size(); f = triangle.nextCovered(f.index + 1)) {
      found[f.index] = 1;
      if (f.isCovered) {
        EXPECT_TRUE(covers(t, points[below[f.index].index()])) << "seed " << seed;
      }
    }
    for (std::size_t i = 0; i < points.size(); ++i)
      if (covers(t, points[i])) {
        EXPECT_TRUE(found[i]) << "seed " << seed << " point " << i;
      }

    const double bound = GetParam().relief / 5;
    std::vector<int> beyond(points.size(), 0);
    for (auto f = triangle.next(0, bound, bound / 2); f.index != below.size();
         f = triangle.next(f.index + 1, bound, bound / 2))
      beyond[f.index] = 1;
    std::size_t spared = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!covers(t, points[i])) continue;
      const long double d = difference(t, points[i]);
      if (d > bound || d < -bound / 2) {
        EXPECT_TRUE(beyond[i]) << "seed " << seed << " point " << i;
      }
      spared += beyond[i] == 0 ? 1 : 0;
    }
    if (GetParam().width == 100) {
      EXPECT_GT(spared, 0u) << "seed " << seed;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Places, ConflictListsTest,
                         testing::Values(Case{{0, 0, 0}, 100, 100, 50},
                                         Case{{4.5e5, 3.8e6, 2000}, 30, 30, 10},
                                         Case{{8.5, 46.5, 1e6}, 1e-4, 1e-4, 100},  // degrees
                                         Case{{1e7, 1e7, 0}, 1e5, 1e-6, 10},       // needles
                                         Case{{0, 0, 0}, 1e36, 1e36, 1e-11},       // slopes too small
                                         Case{{0, 0, 0}, 1e-43, 1e-43, 1e-5},      // places too small
                                         Case{{0, 0, 0}, 1e200, 1e200, 10},        // products that overflow
                                         Case{{0, 0, 0}, 1e-200, 1e-200, 10}));    // and that vanish

}  // namespace
}  // namespace arete

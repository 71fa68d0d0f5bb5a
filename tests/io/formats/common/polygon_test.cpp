// SPDX-License-Identifier: GPL-3.0-or-later
//
// Triangulations are judged by what every one of them must be, not by another triangulation: the sum of the
// areas is the polygon's by the shoelace formula, no triangle is turned over, each edge of the polygon is in
// one triangle in its own direction, and each other edge in two, in both directions.
#include "io/formats/common/polygon.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/vec.h"

namespace arete {
namespace {

using Corners = std::vector<Vec3>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

Vec3 areaVector(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = cross(b - a, c - a);
  return {n.x / 2, n.y / 2, n.z / 2};
}

/// Twice the shoelace area, in the plane z = 0.
double shoelace(const Corners& c, std::size_t from, std::size_t to) {
  double sum = 0;
  for (std::size_t i = from; i < to; ++i) {
    const Vec3 &p = c[i], &q = c[i + 1 < to ? i + 1 : from];
    sum += p.x * q.y - q.x * p.y;
  }
  return sum / 2;
}

double sumOfAreas(const Corners& c, const Triangles& triangles) {
  double sum = 0;
  for (const auto& t : triangles) {
    const Vec3 n = areaVector(c[t[0]], c[t[1]], c[t[2]]);
    sum += std::hypot(n.x, n.y, n.z);
  }
  return sum;
}

/// Each edge of the rings is in one triangle, in its direction (either direction of holes); each other edge
/// is in two, in both directions.
void expectConforming(const Corners& corners, std::vector<std::uint32_t> ends, const Triangles& triangles) {
  if (ends.empty()) ends.push_back(std::uint32_t(corners.size()));
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : triangles)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  std::uint32_t from = 0;
  for (const std::uint32_t end : ends) {
    const auto take = [&](bool reversed) {
      bool found = true;
      for (std::uint32_t i = from; i < end; ++i) {
        const std::uint32_t j = i + 1 < end ? i + 1 : from;
        found = found && edges.contains(reversed ? std::pair(j, i) : std::pair(i, j));
      }
      return found;
    };
    const bool isForward = take(false);
    ASSERT_TRUE(isForward || (from > 0 && take(true))) << "ring from " << from;
    for (std::uint32_t i = from; i < end; ++i) {
      const std::uint32_t j = i + 1 < end ? i + 1 : from;
      --edges[isForward ? std::pair(i, j) : std::pair(j, i)];
    }
    from = end;
  }
  for (const auto& [edge, count] : edges) {
    if (count == 0) continue;
    const auto back = edges.find({edge.second, edge.first});
    ASSERT_EQ(count, 1) << edge.first << ' ' << edge.second;
    ASSERT_TRUE(back != edges.end() && back->second == 1) << edge.first << ' ' << edge.second;
  }
}

struct Frame {
  Vec3 u{1, 0, 0}, v{0, 1, 0}, origin{};
  Vec3 operator()(const Vec3& p) const {
    const Vec3 n = cross(u, v);
    return {origin.x + p.x * u.x + p.y * v.x + p.z * n.x, origin.y + p.x * u.y + p.y * v.y + p.z * n.y,
            origin.z + p.x * u.z + p.y * v.z + p.z * n.z};
  }
};

Frame randomFrame(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    const Vec3 d{normal(random), normal(random), normal(random)};
    const double l = std::hypot(d.x, d.y, d.z);
    return Vec3{d.x / l, d.y / l, d.z / l};
  };
  Frame frame;
  frame.u = direction();
  const Vec3 w = cross(frame.u, direction());
  const double l = std::hypot(w.x, w.y, w.z);
  frame.v = {w.x / l, w.y / l, w.z / l};
  frame.origin = {5e5 * normal(random), 4e6 * normal(random), 1000 * normal(random)};
  return frame;
}

/// A polygon about the origin with radii at random: simple, mostly not convex.
Corners star(std::size_t n, std::mt19937& random, double smallest = 0.05) {
  std::uniform_real_distribution<double> radius(smallest, 1);
  Corners corners;
  for (std::size_t i = 0; i < n; ++i) {
    const double a = 2 * std::numbers::pi * double(i) / double(n), r = radius(random);
    corners.push_back({r * std::cos(a), r * std::sin(a), 0});
  }
  return corners;
}

/// A spiral of turns: not star-shaped from anywhere.
Corners spiral(std::size_t n, double turns) {
  Corners outer, inner;
  for (std::size_t i = 0; i <= n; ++i) {
    const double t = double(i) / double(n), a = 2 * std::numbers::pi * turns * t, r = 1 + 3 * turns * t;
    outer.push_back({(r + 1) * std::cos(a), (r + 1) * std::sin(a), 0});
    inner.push_back({r * std::cos(a), r * std::sin(a), 0});
  }
  outer.insert(outer.end(), inner.rbegin(), inner.rend());
  return outer;
}

Corners comb(std::size_t teeth) {
  Corners corners = {{double(2 * teeth), -1, 0}};
  for (std::size_t i = teeth; i-- > 0;) {
    corners.push_back({double(2 * i + 1), 9, 0});
    corners.push_back({double(2 * i), 0, 0});
  }
  corners.push_back({0, -1, 0});
  return corners;
}

TEST(Polygon, TriangulatesAnyShapeInAnyPlaneInEitherDirectionFromAnyCorner) {
  int cases = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    std::mt19937 random(seed);
    for (Corners flat :
         {star(4 + seed % 9, random), star(30, random), spiral(8 + seed % 7, 1.5), comb(1 + seed % 6)}) {
      std::rotate(flat.begin(), flat.begin() + std::ptrdiff_t(random() % flat.size()), flat.end());
      if (seed % 2 == 0) std::ranges::reverse(flat);
      const double area = shoelace(flat, 0, flat.size());
      const Frame frame = seed % 3 == 0 ? Frame{} : randomFrame(random);
      Corners corners;
      for (const Vec3& p : flat) corners.push_back(frame(p));
      SCOPED_TRACE(::testing::Message() << "seed " << seed << ", " << flat.size() << " corners");
      const PolygonTriangles polygon = triangulatePolygon(corners);
      EXPECT_TRUE(polygon.isSimple);
      EXPECT_EQ(polygon.triangles.size(), corners.size() - 2);
      for (std::uint32_t t = 0; t < polygon.triangles.size() && hasRightFan(corners); ++t)
        EXPECT_EQ(polygon.triangles[t], (std::array<std::uint32_t, 3>{0, t + 1, t + 2}));
      expectConforming(corners, {}, polygon.triangles);
      // Placed at 4e6, coordinates are rounded to 1e-9.
      EXPECT_NEAR(sumOfAreas(corners, polygon.triangles), std::abs(area), 1e-7 * (1 + std::abs(area)));
      const Vec3 normal = cross(frame.u, frame.v);
      for (const auto& [a, b, c] : polygon.triangles)
        EXPECT_GT(dot(areaVector(corners[a], corners[b], corners[c]), normal) * (area > 0 ? 1 : -1), -1e-8);
      ++cases;
    }
  }
  EXPECT_EQ(cases, 240);
}

TEST(Polygon, IsTheFanWhereThatIsRight) {
  const Corners convex = {{0, 0, 0.7}, {2, 0, 0.1}, {3, 1, 0.4}, {2, 3, 0.2}, {-1, 2, 0}};
  const Triangles fan = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  EXPECT_EQ(triangulatePolygon(convex).triangles, fan);
  // Not convex, but the first corner sees it all.
  const Corners arrow = {{0, 0, 0}, {4, 1, 0}, {1, 1, 0}, {1, 4, 0}};
  EXPECT_EQ(triangulatePolygon(arrow).triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(triangulatePolygon(Corners{{1, 1, 0}, {1, 4, 0}, {0, 0, 0}, {4, 1, 0}}).triangles.size(), 2u);
}

TEST(Polygon, FollowsABentOutline) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> up(-0.2, 0.2);
    Corners flat = star(12, random, 0.3), corners = flat;
    const Frame frame = randomFrame(random);
    for (std::size_t i = 0; i < flat.size(); ++i) {
      corners[i].z = up(random);
      corners[i] = frame(corners[i]);
    }
    const PolygonTriangles polygon = triangulatePolygon(corners);
    SCOPED_TRACE(seed);
    EXPECT_TRUE(polygon.isSimple);
    EXPECT_EQ(polygon.triangles.size(), 10u);
    expectConforming(corners, {}, polygon.triangles);
    // Seen along the normal of its plane it is the flat polygon, whatever is bent.
    double seen = 0;
    for (const auto& [a, b, c] : polygon.triangles)
      seen += dot(areaVector(corners[a], corners[b], corners[c]), cross(frame.u, frame.v));
    EXPECT_NEAR(seen, shoelace(flat, 0, flat.size()), 1e-7);
  }
}

TEST(Polygon, IsSeenFromAboveWhereItIsTerrain) {
  // In degrees, with heights in metres: the axis nearest to the normal is a horizontal one. From there the
  // quadrangle is an arrowhead whose diagonal is the other one, and lies outside it on the map.
  const Corners steep = {{0, 0, 900}, {1e-3, 0, 100}, {3e-4, 3e-4, 250}, {0, 1e-3, 800}};
  const double area = std::abs(shoelace(steep, 0, 4));
  const auto onMap = [&](const PolygonTriangles& polygon) {
    double sum = 0;
    for (const auto& [a, b, c] : polygon.triangles)
      sum += std::abs(shoelace({steep[a], steep[b], steep[c]}, 0, 3));
    return sum;
  };
  EXPECT_NEAR(onMap(triangulatePolygon(steep, PolygonView::above)), area, 1e-15);
  Corners turned = steep;
  for (int turn = 0; turn < 4; ++turn) {
    std::rotate(turned.begin(), turned.begin() + 1, turned.end());
    const PolygonTriangles polygon = triangulatePolygon(turned, PolygonView::above);
    double sum = 0;
    for (const auto& [a, b, c] : polygon.triangles)
      sum += std::abs(shoelace({turned[a], turned[b], turned[c]}, 0, 3));
    EXPECT_NEAR(sum, area, 1e-15);
  }
  // A wall has no area on the map.
  const Corners wall = {{1, 1, 0}, {3, 3, 0}, {3, 3, 2}, {2, 2, 1}, {1, 1, 2}};
  EXPECT_TRUE(triangulatePolygon(wall, PolygonView::above).isSimple);
  EXPECT_NEAR(sumOfAreas(wall, triangulatePolygon(wall, PolygonView::above).triangles), 3 * std::sqrt(2.0),
              1e-12);
}

/// A square with holes, each joined to it by a bridge that is followed there and back.
Corners keyhole(std::size_t holes) {
  Corners corners = {{0, 0, 0}};
  const double side = double(2 * holes + 1);
  // From the corner at the origin to each hole in turn and back.
  for (std::size_t h = 0; h < holes; ++h) {
    const double x = double(2 * h + 1), y = 1;
    for (const Vec3 p :
         {Vec3{x, y, 0}, Vec3{x, y + 0.5, 0}, Vec3{x + 0.5, y + 0.5, 0}, Vec3{x + 0.5, y, 0}, Vec3{x, y, 0}})
      corners.push_back(p);
    corners.push_back({0, 0, 0});
  }
  corners.push_back({side, 0, 0});
  corners.push_back({side, 3, 0});
  corners.push_back({0, 3, 0});
  return corners;
}

TEST(Polygon, FollowsBridgesToHoles) {
  // One hole only: the bridges from the origin to further holes would pass through the first.
  Corners corners = keyhole(1);
  const double area = 3 * 3 - 0.25;
  for (std::size_t turn = 0; turn < corners.size(); ++turn) {
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    SCOPED_TRACE(turn);
    const PolygonTriangles polygon = triangulatePolygon(corners);
    EXPECT_TRUE(polygon.isSimple);
    EXPECT_EQ(polygon.triangles.size(), corners.size() - 2);
    EXPECT_NEAR(sumOfAreas(corners, polygon.triangles), area, 1e-12);
    // The two corners at each end of the bridge have the triangles on their own side: all edges match.
    expectConforming(corners, {}, polygon.triangles);
  }
}

TEST(Polygon, LeavesHolesOpen) {
  for (unsigned seed = 1; seed <= 30; ++seed) {
    std::mt19937 random(seed);
    Corners corners = star(20, random, 0.8);
    std::vector<std::uint32_t> ends = {20};
    double area = shoelace(corners, 0, 20);
    for (const Vec3 middle : {Vec3{0.3, 0.3, 0}, Vec3{-0.3, 0.2, 0}, Vec3{0, -0.35, 0}}) {
      Corners hole = star(5, random, 0.3);
      for (Vec3& p : hole) p = {middle.x + 0.2 * p.x, middle.y + 0.2 * p.y, 0};
      if (random() % 2 == 0) std::ranges::reverse(hole);
      area -= std::abs(shoelace(hole, 0, hole.size()));
      corners.insert(corners.end(), hole.begin(), hole.end());
      ends.push_back(std::uint32_t(corners.size()));
    }
    const Frame frame = randomFrame(random);
    for (Vec3& p : corners) p = frame(p);
    SCOPED_TRACE(seed);
    const PolygonTriangles polygon = triangulatePolygon(corners, PolygonView::along, ends);
    EXPECT_TRUE(polygon.isSimple);
    EXPECT_EQ(polygon.triangles.size(), corners.size() + 2 * 3 - 2);
    EXPECT_NEAR(sumOfAreas(corners, polygon.triangles), area, 1e-7);
    expectConforming(corners, ends, polygon.triangles);
  }
}

TEST(Polygon, KeepsEveryCornerOfDegenerateOutlines) {
  struct Case {
    const char* name;
    Corners corners;
    double area;
    std::size_t triangles;
  };
  const std::vector<Case> cases = {
      {"corners on the edges",
       {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}},
       4,
       6},
      {"first corner on an edge", {{1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 0}}, 4, 3},
      {"a corner twice", {{0, 0, 0}, {2, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, 4, 3},
      {"a corner three times, first", {{0, 0, 0}, {0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 0, 0}}, 2, 3},
      {"all corners twice",
       {{0, 0, 0},
        {0, 0, 0},
        {2, 0, 0},
        {2, 0, 0},
        {2, 1, 0},
        {2, 1, 0},
        {1, 1, 0},
        {1, 1, 0},
        {1, 2, 0},
        {1, 2, 0},
        {0, 2, 0},
        {0, 2, 0}},
       3,
       10},
      {"two squares that share a corner",
       {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {1, 1, 0}, {0, 1, 0}},
       2,
       4},
      {"an L, vertical", {{0, 5, 0}, {2, 5, 0}, {2, 5, 1}, {1, 5, 1}, {1, 5, 2}, {0, 5, 2}}, 3, 4},
  };
  for (const Case& one : cases) {
    SCOPED_TRACE(one.name);
    const PolygonTriangles polygon = triangulatePolygon(one.corners);
    EXPECT_TRUE(polygon.isSimple);
    EXPECT_NEAR(sumOfAreas(one.corners, polygon.triangles), one.area, 1e-12);
    EXPECT_EQ(polygon.triangles.size(), one.triangles);
    if (one.triangles == one.corners.size() - 2) expectConforming(one.corners, {}, polygon.triangles);
  }
  // No area: a line, a point, a spike there and back.
  EXPECT_EQ(triangulatePolygon(Corners{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}).triangles.size(), 2u);
  EXPECT_TRUE(triangulatePolygon(Corners{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}).isSimple);
  EXPECT_TRUE(triangulatePolygon(Corners(5, Vec3{1, 2, 3})).isSimple);
  EXPECT_TRUE(triangulatePolygon(Corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 0, 0}}).triangles.empty());
  EXPECT_TRUE(triangulatePolygon(Corners(2)).triangles.empty());
}

TEST(Polygon, SaysWhereAnOutlineCrossesItself) {
  const Corners bow = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  const Corners twice = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  Corners pentagram;
  for (const int i : {0, 2, 4, 1, 3})
    pentagram.push_back({std::cos(i * 0.4 * std::numbers::pi), std::sin(i * 0.4 * std::numbers::pi), 0});
  Corners many;
  for (int i = 0; i < 101; ++i)
    many.push_back({std::cos(i * 4 * std::numbers::pi / 101), std::sin(i * 4 * std::numbers::pi / 101), 0});
  for (const Corners& corners : {bow, twice, pentagram, many}) {
    const PolygonTriangles polygon = triangulatePolygon(corners);
    EXPECT_FALSE(polygon.isSimple);
    EXPECT_EQ(polygon.triangles.size(), corners.size() - 2);
    expectConforming(corners, {}, polygon.triangles);
  }
  // A hole beyond the outline.
  const Corners outside = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 0}, {6, 5, 0}, {5, 6, 0}};
  EXPECT_FALSE(triangulatePolygon(outside, PolygonView::along, std::vector<std::uint32_t>{3, 6}).isSimple);
}

TEST(Polygon, HoldsAtTheEndsOfTheRangeOfDoubles) {
  for (const double size : {1e-300, 1.0, 1e300, 1.7e308}) {
    const Corners corners = {
        {-size, -size, 0}, {size, -size, 0}, {0, 0, 0}, {size, size, 0}, {-size, size, 0}};
    const PolygonTriangles polygon = triangulatePolygon(corners);
    EXPECT_TRUE(polygon.isSimple) << size;
    ASSERT_EQ(polygon.triangles.size(), 3u);
    expectConforming(corners, {}, polygon.triangles);
  }
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Polygons of a program and the same polygons of a file: both regions are what any of the polygons goes
// around. The oracle counts how often each ring goes around a place.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "io/georeference_fixture.h"
#include "io/io_fixture.h"
#include "io/query/extract/region_argument.h"
#include "io/query/extract/region_reader.h"

namespace arete {
namespace {

using test::contains;
using test::TemporaryFolder;

using Chain = std::vector<Vec2>;
using Polygon = std::vector<Chain>;
using Polygons = std::vector<Polygon>;

int winding(const Chain& ring, Vec2 p) {
  double angle = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a{ring[i].x - p.x, ring[i].y - p.y},
        b{ring[(i + 1) % ring.size()].x - p.x, ring[(i + 1) % ring.size()].y - p.y};
    angle += std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
  }
  return int(std::lround(angle / (2 * std::numbers::pi)));
}

bool isInAny(const Polygons& polygons, Vec2 p) {
  for (const Polygon& polygon : polygons) {
    bool isIn = winding(polygon[0], p) != 0;
    for (std::size_t hole = 1; hole < polygon.size(); ++hole) isIn = isIn && winding(polygon[hole], p) == 0;
    if (isIn) return true;
  }
  return false;
}

bool isInByEvenOdd(const std::vector<Chain>& rings, Vec2 p) {
  bool isIn = false;
  for (const Chain& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) isIn = !isIn;
    }
  return isIn;
}

bool isNearEdge(const Polygons& polygons, Vec2 p) {
  for (const Polygon& polygon : polygons)
    for (const Chain& ring : polygon)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = ring[i], b = ring[(i + 1) % ring.size()], d{b.x - a.x, b.y - a.y};
        const double length = d.x * d.x + d.y * d.y;
        const double t =
            length > 0 ? std::clamp(((p.x - a.x) * d.x + (p.y - a.y) * d.y) / length, 0.0, 1.0) : 0;
        if (std::hypot(a.x + t * d.x - p.x, a.y + t * d.y - p.y) < 1e-6) return true;
      }
  return false;
}

std::string geoJson(const Polygons& polygons) {
  std::string text =
      R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:32611"}},"features":[{"type":"Feature","properties":{},"geometry":{"type":"MultiPolygon","coordinates":[)";
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    text += k ? ",[" : "[";
    for (std::size_t r = 0; r < polygons[k].size(); ++r) {
      text += r ? ",[" : "[";
      Chain closed = polygons[k][r];
      closed.push_back(closed.front());
      for (std::size_t i = 0; i < closed.size(); ++i)
        text += (i ? ",[" : "[") + std::to_string(closed[i].x) + ',' + std::to_string(closed[i].y) + ']';
      text += ']';
    }
    text += ']';
  }
  return text + "]}}]}";
}

Chain box(double x, double y, double width, double height) {
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}

Chain star(Vec2 centre, double radius, int corners, int step, double turn) {
  Chain ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = turn + 2 * std::numbers::pi * (i * step % corners) / corners;
    ring.push_back({std::round(1e3 * (centre.x + radius * std::cos(angle))) / 1e3,
                    std::round(1e3 * (centre.y + radius * std::sin(angle))) / 1e3});
  }
  return ring;
}

Chain turned(Chain ring) {
  std::reverse(ring.begin(), ring.end());
  return ring;
}

void expectUnion(const std::string& what, const Polygons& polygons) {
  const TemporaryFolder folder;
  const auto stated = regionArgumentOf({.polygons = polygons}, test::georeferenceOf("EPSG:32611"), {});
  const auto read = readRegion(folder.write("a.geojson", geoJson(polygons)), "EPSG:32611");
  ASSERT_TRUE(stated) << what << ": " << stated.error().describe();
  ASSERT_TRUE(read) << what << ": " << read.error().describe();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-5, 105);
  for (int i = 0; i < 400; ++i) {
    const Vec2 p{place(random), place(random)};
    if (isNearEdge(polygons, p)) continue;
    const bool isIn = isInAny(polygons, p);
    EXPECT_EQ(isInByEvenOdd(stated->shape.rings, p), isIn) << what << " at " << p.x << ' ' << p.y;
    EXPECT_EQ(isInByEvenOdd(read->rings, p), isIn) << what << " of a file, at " << p.x << ' ' << p.y;
  }
}

TEST(RegionPolygons, AreUnitedHoweverTheyLie) {
  const Chain a = box(10, 10, 50, 50), b = box(30, 30, 60, 40), inside = box(20, 20, 10, 10),
              hole = box(15, 15, 30, 30);
  const std::vector<std::pair<std::string, Polygons>> cases = {
      {"overlapping", {{a}, {b}}},
      {"twice", {{a}, {a}}},
      {"three times", {{a}, {a}, {a}}},
      {"nested", {{a}, {inside}}},
      {"nested, the inner first", {{inside}, {a}}},
      {"turned", {{turned(a)}, {a}}},
      {"touching along an edge", {{box(0, 0, 50, 50)}, {box(50, 0, 50, 50)}}},
      {"touching in a corner", {{box(0, 0, 50, 50)}, {box(50, 50, 50, 50)}}},
      {"apart", {{box(0, 0, 20, 20)}, {box(50, 50, 20, 20)}}},
      {"with a hole", {{a, hole}}},
      {"with a hole that is turned", {{a, turned(hole)}}},
      {"an island in a hole", {{a, hole}, {inside}}},
      {"a hole that another covers", {{a, hole}, {hole}}},
      {"a hole that another overlaps", {{a, hole}, {b}}},
      {"a hole twice", {{a, hole, hole}}},
      {"holes that overlap", {{a, hole, box(30, 30, 25, 25)}}},
      {"a hole that leaves the ring", {{a, box(40, 40, 60, 10)}}},
      {"a bow tie", {{{{0, 0}, {100, 100}, {100, 0}, {0, 100}}}}},
      {"a bow tie over a box", {{{{0, 0}, {100, 100}, {100, 0}, {0, 100}}}, {a}}},
      {"a pentagram", {{star({50, 50}, 45, 5, 2, 0.1)}}},
      {"a pentagram twice", {{star({50, 50}, 45, 5, 2, 0.1)}, {star({50, 50}, 45, 5, 2, 0.1)}}},
      {"a ring that goes around twice",
       {{{{0, 0}, {90, 0}, {90, 90}, {0, 90}, {0, 0}, {40, 0}, {40, 40}, {0, 40}}}}},
      {"closed rings",
       {{{{0, 0}, {50, 0}, {50, 50}, {0, 50}, {0, 0}}}, {{{25, 25}, {75, 25}, {75, 75}, {25, 25}}}}},
      {"repeated vertices", {{{{0, 0}, {50, 0}, {50, 0}, {50, 50}, {0, 50}}}, {b}}},
  };
  for (const auto& [what, polygons] : cases) expectUnion(what, polygons);
}

TEST(RegionPolygons, AreUnitedAtRandom) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(15, 85), size(3, 40), angle(0, 6);
    Polygons polygons;
    const int count = 1 + int(random() % 5);
    for (int k = 0; k < count; ++k) {
      const Vec2 centre{place(random), place(random)};
      const int corners = 3 + int(random() % 7);
      const int step = 1 + int(random() % 2);
      Polygon polygon = {
          star(centre, size(random), corners, std::gcd(step, corners) == 1 ? step : 1, angle(random))};
      if (random() % 3 == 0) polygon.push_back(star(centre, size(random) / 4, 4, 1, angle(random)));
      if (random() % 2 == 0) polygon[0] = turned(polygon[0]);
      polygons.push_back(polygon);
      if (random() % 4 == 0) polygons.push_back(polygon);
    }
    expectUnion("seed " + std::to_string(seed), polygons);
  }
}

TEST(RegionPolygons, WithoutAnAreaAreRefused) {
  const Georeference dem = test::georeferenceOf("EPSG:32611");
  for (const Polygons& polygons : {Polygons{}, Polygons{{}}, Polygons{{{}}}, Polygons{{{{0, 0}, {1, 1}}}},
                                   Polygons{{{{0, 0}, {1, 1}, {0, 0}}}}}) {
    const auto region = regionArgumentOf({.polygons = polygons}, dem, {});
    ASSERT_FALSE(region);
    EXPECT_EQ(region.error().code, ErrorCode::usage);
    EXPECT_TRUE(contains(region.error().message, "no polygon")) << region.error().message;
  }
  EXPECT_FALSE(regionArgumentOf({.polygons = {{{{0, 0}, {1, std::nan("")}, {1, 1}}}}}, dem, {}));
  // An empty one beside another is left out.
  EXPECT_TRUE(regionArgumentOf({.polygons = {{}, {box(0, 0, 1, 1)}, {{}}}}, dem, {}));
}

TEST(RegionPolygons, ABoxOfAProgramIsThatOfAText) {
  const Georeference degrees = test::georeferenceOf("EPSG:4326"), metres = test::georeferenceOf("EPSG:32611");
  struct Case {
    std::array<double, 4> box;
    const char* text;
  };
  for (const Case& c :
       {Case{{1, 2, 3, 4}, "1,2,3,4"}, Case{{170, 2, -170, 4}, "170,2,-170,4"}, Case{{3, 2, 1, 4}, "3,2,1,4"},
        Case{{1, 4, 3, 2}, "1,4,3,2"}, Case{{1, 2, 1, 4}, "1,2,1,4"}})
    for (const Georeference& dem : {degrees, metres}) {
      const auto stated = regionArgumentOf({.box = c.box}, dem, {});
      const auto read = readRegionArgument({c.text}, dem, {});
      ASSERT_EQ(bool(stated), bool(read)) << c.text;
      if (stated) {
        EXPECT_EQ(stated->shape.rings, read->shape.rings) << c.text;
      }
    }
}

}  // namespace
}  // namespace arete

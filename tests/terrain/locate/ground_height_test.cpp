// SPDX-License-Identifier: GPL-3.0-or-later
//
// Heights against an oracle that knows nothing of triangulations: the cell of a place in the samples, its
// diagonal, and a plane. For points: every triangle of the finest front, one after the other.
#include "terrain/locate/ground_height.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string>

#include "datasets/families.h"
#include "datasets/random.h"
#include "engine/cut/cut.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The finest surface of a raster at (column, row), NaN off it: a cell's diagonal joins its upper-left and
/// lower-right samples; a cell with three samples is one triangle.
double latticeHeight(const RasterHeightfield& field, double column, double row) {
  const auto cellHeight = [&](double left, double top) {
    if (left < 0 || top < 0 || left + 1 >= field.columns || top + 1 >= field.rows) return kNone;
    const auto c = static_cast<std::uint32_t>(left), r = static_cast<std::uint32_t>(top);
    const double u = column - left, v = row - top;
    const double ul = field.at(c, r), ur = field.at(c + 1, r), ll = field.at(c, r + 1),
                 lr = field.at(c + 1, r + 1);
    const int missing = std::isnan(ul) + std::isnan(ur) + std::isnan(ll) + std::isnan(lr);
    if (missing > 1) return kNone;
    if (std::isnan(ul)) return u + v >= 1 ? lr + (1 - u) * (ll - lr) + (1 - v) * (ur - lr) : kNone;
    if (std::isnan(lr)) return u + v <= 1 ? ul + u * (ur - ul) + v * (ll - ul) : kNone;
    if (u >= v && !std::isnan(ur)) return ul + u * (ur - ul) + v * (lr - ur);
    if (u <= v && !std::isnan(ll)) return ul + v * (ll - ul) + u * (lr - ll);
    return kNone;
  };
  // A place on a grid line is in up to four cells.
  for (const double left : {std::floor(column), std::ceil(column) - 1})
    for (const double top : {std::floor(row), std::ceil(row) - 1})
      if (const double z = cellHeight(left, top); !std::isnan(z)) return z;
  return kNone;
}

Vec2 sourceOf(const RasterHeightfield& field, double column, double row) {
  const auto& g = field.georeference.geoTransform;
  return {g[0] + g[1] * (column + 0.5) + g[2] * (row + 0.5),
          g[3] + g[4] * (column + 0.5) + g[5] * (row + 0.5)};
}

double largestMagnitude(const std::vector<double>& heights) {
  double largest = 1;
  for (const double z : heights)
    if (!std::isnan(z)) largest = std::max(largest, std::abs(z));
  return largest;
}

/// Places of every kind: anywhere, also beyond the raster, on samples, on grid lines, on diagonals.
std::vector<Vec2> gridPlaces(const RasterHeightfield& field, std::uint64_t seed, int ofEachKind) {
  Random random(seed);
  const auto anywhere = [&](double size) { return random.unit() * (size + 1) - 1; };
  std::vector<Vec2> places;
  for (int i = 0; i < ofEachKind; ++i) {
    const double c = anywhere(field.columns), r = anywhere(field.rows);
    places.push_back({c, r});
    places.push_back({std::round(c), std::round(r)});
    places.push_back({std::round(c), r});
    places.push_back({c, std::round(r)});
    const double part = std::floor(random.unit() * 64) / 64;  // on a diagonal to the bit
    places.push_back({std::floor(c) + part, std::floor(r) + part});
    places.push_back({std::floor(c) + part, std::floor(r) + 1 - part});
  }
  return places;
}

struct Case {
  std::string name;
  RasterHeightfield field;
};

std::vector<Case> rasterCases() {
  std::vector<Case> cases;
  for (const RasterFamily& family : rasterFamilies())
    for (const auto& [columns, rows] : {std::pair{2u, 2u}, {23u, 17u}, {64u, 71u}})
      cases.push_back(
          {std::string(family.name) + " " + std::to_string(columns), family.make(columns, rows, columns)});
  for (Case& c : std::vector<Case>(cases)) {
    if (c.field.columns != 23) continue;
    c.name += ", turned and south up";
    c.field.georeference.geoTransform = {1000, 3, 1, -200, -1.5, 4};
    cases.push_back(std::move(c));
  }
  return cases;
}

TEST(GroundHeights, AtFullResolutionAreThoseOfTheSamplesCellByCell) {
  for (const Case& c : rasterCases())
    for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent}) {
      const auto model = build(c.field, {.shape = shape});
      ASSERT_TRUE(model) << c.name;
      const GroundHeights heights(*model);
      const double slack = 1e-9 * largestMagnitude(c.field.heights);
      for (const Vec2 p : gridPlaces(c.field, 5, 300)) {
        const double expected = latticeHeight(c.field, p.x, p.y);
        const auto found = heights.at(sourceOf(c.field, p.x, p.y));
        ASSERT_EQ(found.has_value(), !std::isnan(expected)) << c.name << " at " << p.x << ", " << p.y;
        if (!found) continue;
        ASSERT_NEAR(found->height, expected, slack) << c.name << " at " << p.x << ", " << p.y;
        ASSERT_EQ(found->below, 0);
        ASSERT_EQ(found->above, 0);
      }
    }
}

TEST(GroundHeights, GiveEverySampleWhereItsPlaceIsExact) {
  for (const RasterFamily& family : rasterFamilies()) {
    RasterHeightfield field = family.make(37, 29, 3);
    field.georeference.geoTransform = {0, 2, 0, 0, 0, 2};  // no rounding on the way to the grid and back
    const auto model = build(field);
    ASSERT_TRUE(model) << family.name;
    const GroundHeights heights(*model);
    const double magnitude = largestMagnitude(field.heights);
    for (std::uint32_t v = 0; v < model->mt.vertexCount(); ++v) {
      const Vec2 p = model->mt.vertices().planPosition(VertexId(v));
      const auto found = heights.at({2 * p.x + 1, 2 * p.y + 1});
      ASSERT_TRUE(found) << family.name << " at " << p.x << ", " << p.y;
      // A coarser triangle with the bound 0 is the same plane but for rounding.
      ASSERT_NEAR(found->height, field.at(std::uint32_t(p.x), std::uint32_t(p.y)), 1e-15 * magnitude)
          << family.name;
    }
  }
}

TEST(GroundHeights, WithinAToleranceStayWithinItAndWithinTheirOwnBound) {
  std::uint64_t visited = 0, visitedInFull = 0;
  for (const Case& c : rasterCases()) {
    const auto model = build(c.field);
    ASSERT_TRUE(model) << c.name;
    const GroundHeights heights(*model);
    const double slack = 1e-9 * largestMagnitude(c.field.heights);
    for (const double tolerance : {0.0, 0.3, 5.0, 80.0, std::numeric_limits<double>::infinity()})
      for (const Vec2 p : gridPlaces(c.field, 11, 40)) {
        const Vec2 place = sourceOf(c.field, p.x, p.y);
        const auto full = heights.at(place), found = heights.at(place, tolerance);
        ASSERT_EQ(found.has_value(), full.has_value()) << c.name;
        if (!found) continue;
        ASSERT_LE(found->below, tolerance);
        ASSERT_LE(found->above, tolerance);
        ASSERT_GE(found->height - full->height, -found->below - slack) << c.name << " " << tolerance;
        ASSERT_LE(found->height - full->height, found->above + slack) << c.name << " " << tolerance;
        ASSERT_LE(found->nodesVisited, full->nodesVisited);
        if (tolerance < 5) continue;
        visited += found->nodesVisited;
        visitedInFull += full->nodesVisited;
      }
  }
  EXPECT_LT(visited, visitedInFull / 2);
}

TEST(GroundHeights, CountAPlaceThatRoundingPutsBeyondABorderAsOnIt) {
  RasterHeightfield field;
  field.columns = 9;
  field.rows = 7;
  for (std::uint32_t r = 0; r < 7; ++r)
    for (std::uint32_t c = 0; c < 9; ++c) field.heights.push_back(10 * c + r);
  field.heights[field.index(4, 3)] = kNone;
  field.georeference.geoTransform = {-0.5, 1, 0, -0.5, 0, 1};
  const auto model = build(field);
  ASSERT_TRUE(model);
  const GroundHeights heights(*model);
  const auto near = [&](double x, double y) {
    const auto found = heights.at({x, y});
    return found ? found->height : kNone;
  };
  for (const double off : {0.0, 1e-12, 5e-10}) {
    EXPECT_NEAR(near(-off, 2.5), 2.5, 1e-7);
    EXPECT_NEAR(near(8 + off, 2.5), 82.5, 1e-7);
    EXPECT_NEAR(near(3.25, -off), 32.5, 1e-7);
    EXPECT_NEAR(near(3.25, 6 + off), 38.5, 1e-7);
    EXPECT_NEAR(near(-off, -off), 0, 1e-7);
    EXPECT_NEAR(near(3.5 + off, 2.5 + off), 37.5, 1e-7) << "the rim of the void, from inside it";
  }
  EXPECT_TRUE(std::isnan(near(-1e-6, 2.5)));
  EXPECT_TRUE(std::isnan(near(8 + 1e-6, 2.5)));
  EXPECT_TRUE(std::isnan(near(-1e-6, -1e-6)));
  EXPECT_TRUE(std::isnan(near(3.5 + 1e-6, 2.5 + 1e-6)));
  EXPECT_TRUE(std::isnan(near(4, 3)));
}

TEST(GroundHeights, HaveNoneAtPlacesThatAreNoPlaces) {
  const auto model = build(rasterFamilies()[3].make(20, 20, 1));
  ASSERT_TRUE(model);
  const GroundHeights heights(*model);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Vec2 p :
       {Vec2{kNone, 0}, {0, kNone}, {infinity, 0}, {-infinity, infinity}, {1e300, -1e300}, {0, 0}})
    EXPECT_FALSE(heights.at(p)) << p.x << ", " << p.y;
}

TEST(GroundHeights, NeverReachOverNodataThatARimToleranceHasFilled) {
  for (const RasterFamily& family : rasterFamilies()) {
    const RasterHeightfield field = family.make(61, 53, 4);
    const auto model = build(field, {.rimTolerance = 3});
    ASSERT_TRUE(model) << family.name;
    const GroundHeights heights(*model);
    const double slack = 1e-9 * largestMagnitude(field.heights);
    for (const double tolerance : {0.0, 20.0})
      for (const Vec2 p : gridPlaces(field, 8, 300)) {
        const double expected = latticeHeight(field, p.x, p.y);
        const auto found = heights.at(sourceOf(field, p.x, p.y), tolerance);
        ASSERT_EQ(found.has_value(), !std::isnan(expected)) << family.name << " at " << p.x << ", " << p.y;
        if (!found) continue;
        ASSERT_NEAR(found->height, expected, slack) << family.name;
      }
  }
}

TEST(GroundHeights, OfManyPlacesAreThoseOfEachForAnyNumberOfThreads) {
  for (const char* wanted : {"fractal", "nodata holes"})
    for (const RasterFamily& family : rasterFamilies()) {
      if (family.name != wanted) continue;
      const RasterHeightfield field = family.make(90, 80, 2);
      const auto model = build(field);
      ASSERT_TRUE(model);
      const GroundHeights heights(*model);
      std::vector<Vec2> places;
      for (const Vec2 p : gridPlaces(field, 21, 2000)) places.push_back(sourceOf(field, p.x, p.y));
      for (const int threads : {1, 2, 4}) {
        RunContext context;
        context.threads = threads;
        const auto many = heights.at(places, 1.0, context);
        ASSERT_TRUE(many);
        ASSERT_EQ(many->size(), places.size());
        for (std::size_t i = 0; i < places.size(); ++i) {
          const auto one = heights.at(places[i], 1.0);
          const auto& other = (*many)[i];
          ASSERT_EQ(one.has_value(), other.has_value()) << i;
          if (!one) continue;
          ASSERT_EQ(one->height, other->height) << i;
          ASSERT_EQ(one->triangle, other->triangle) << i;
        }
      }
    }
}

TEST(GroundHeights, OfManyPlacesStopWhenAskedTo) {
  const auto model = build(rasterFamilies()[3].make(20, 20, 1));
  ASSERT_TRUE(model);
  const std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  const auto answer = GroundHeights(*model).at(std::vector<Vec2>(10), 0, context);
  ASSERT_FALSE(answer);
  EXPECT_EQ(answer.error().code, ErrorCode::interrupted);
}

/// The finest front of a point model at p, by looking at each of its triangles.
double frontHeight(const TerrainModel& model, const Cut& finest, Vec2 p, double& leastWeight) {
  double best = kNone;
  leastWeight = -std::numeric_limits<double>::infinity();
  for (const auto& t : finest.triangles) {
    long double x[3], y[3], z[3], w[3];
    for (int i = 0; i < 3; ++i) {
      const Vec3 at = model.mt.position(VertexId(finest.vertices[t[i]]));
      x[i] = at.x;
      y[i] = at.y;
      z[i] = at.z;
    }
    const long double area = (x[1] - x[0]) * (y[2] - y[0]) - (y[1] - y[0]) * (x[2] - x[0]);
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      w[i] = ((x[j] - p.x) * (y[k] - p.y) - (y[j] - p.y) * (x[k] - p.x)) / area;
    }
    const double least = static_cast<double>(std::min({w[0], w[1], w[2]}));
    if (least <= leastWeight) continue;
    leastWeight = least;
    best = static_cast<double>(w[0] * z[0] + w[1] * z[1] + w[2] * z[2]);
  }
  return best;
}

TEST(GroundHeights, OfScatteredPointsAreThoseOfTheirFinestFront) {
  for (const PointFamily& family : pointFamilies())
    for (const std::uint32_t count : {4u, 30u, 500u}) {
      const PointHeightfield field = family.make(count, count);
      const auto model = build(field);
      ASSERT_TRUE(model) << family.name;
      const GroundHeights heights(*model);
      const Cut finest = frontOfPrefix(model->mt, model->mt.nodeCount());
      const Box2& box = heights.locator().roots().bounds();
      const double magnitude = largestMagnitude(field.heights);
      Random random(count);
      for (int i = 0; i < 300; ++i) {
        const Vec2 p = {box.xMin + (1.2 * random.unit() - 0.1) * (box.xMax - box.xMin),
                        box.yMin + (1.2 * random.unit() - 0.1) * (box.yMax - box.yMin)};
        double least = 0;
        const double expected = frontHeight(*model, finest, p, least);
        const auto found = heights.at(p);
        if (std::abs(least) <= 1e-6) continue;
        ASSERT_EQ(found.has_value(), least > 0) << family.name << " " << count;
        if (!found) continue;
        ASSERT_NEAR(found->height, expected, 1e-7 * magnitude) << family.name << count;
      }
      for (std::size_t i = 0; i < field.size(); ++i) {
        const auto found = heights.at(field.positions[i]);
        ASSERT_TRUE(found) << family.name << " point " << i;
        ASSERT_NEAR(found->height, field.heights[i], 1e-14 * magnitude) << family.name << " point " << i;
      }
      for (const double tolerance : {1.0, 30.0})
        for (int i = 0; i < 100; ++i) {
          const Vec2 p = {box.xMin + random.unit() * (box.xMax - box.xMin),
                          box.yMin + random.unit() * (box.yMax - box.yMin)};
          const auto full = heights.at(p), found = heights.at(p, tolerance);
          ASSERT_EQ(found.has_value(), full.has_value());
          if (!found) continue;
          ASSERT_LE(std::max(found->below, found->above), tolerance);
          ASSERT_GE(found->height - full->height, -found->below - 1e-7 * magnitude) << family.name;
          ASSERT_LE(found->height - full->height, found->above + 1e-7 * magnitude) << family.name;
        }
    }
}

TEST(GroundHeights, OfScatteredPointsHoldOnTheirEdges) {
  for (const PointFamily& family : pointFamilies()) {
    const auto model = build(family.make(200, 6));
    ASSERT_TRUE(model) << family.name;
    const GroundHeights heights(*model);
    const Cut finest = frontOfPrefix(model->mt, model->mt.nodeCount());
    for (const auto& t : finest.triangles)
      for (int i = 0; i < 3; ++i) {
        const Vec3 a = model->mt.position(VertexId(finest.vertices[t[i]])),
                   b = model->mt.position(VertexId(finest.vertices[t[(i + 1) % 3]]));
        const auto found = heights.at({(a.x + b.x) / 2, (a.y + b.y) / 2});
        ASSERT_TRUE(found) << family.name;
        // The middle is rounded: as far off the edge as the last bits, across the steepest slope.
        ASSERT_GE(found->height, std::min(a.z, b.z) - 1e-4) << family.name;
        ASSERT_LE(found->height, std::max(a.z, b.z) + 1e-4) << family.name;
      }
  }
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The laws on every generated family of points, for both hole shapes and any number of threads. Errors and
// bounds are held against plain oracles that look at every point, and every triangle, for every triangle.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "datasets/families.h"
#include "datasets/random.h"
#include "engine/laws/validate.h"
#include "terrain/build_fixture.h"
#include "terrain/builder/build.h"
#include "terrain/laws/validate_model.h"
#include "terrain/triangulation/finest_points.h"

namespace arete {
namespace {

TEST(BuildPoints, KeepsEveryLawOnEveryFamilyForBothShapes) {
  for (const PointFamily& family : pointFamilies())
    for (const std::uint32_t count : {4u, 25u, 400u})
      for (const std::uint64_t seed : seeds())
        for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent}) {
          const auto model = build(family.make(count, seed), withShape(shape));
          ASSERT_TRUE(model) << family.name << " " << count << ": " << model.error().describe();
          const Status status = validateModel(*model, {.randomFronts = 20, .seed = seed});
          EXPECT_TRUE(status) << family.name << " " << count << " seed " << seed << " " << toString(shape)
                              << ": " << status.error().describe();
        }
}

TEST(BuildPoints, GivesTheSameBytesForAnyNumberOfThreads) {
  for (const PointFamily& family : pointFamilies()) {
    const PointHeightfield field = family.make(3000, 9);
    RunContext context;
    context.threads = 1;
    const auto one = build(field, {}, context);
    ASSERT_TRUE(one) << family.name;
    for (const int threads : {2, 4}) {
      context.threads = threads;
      const auto many = build(field, {}, context);
      ASSERT_TRUE(many);
      expectSameArrays(one->mt, many->mt, std::string(family.name));
    }
  }
}

TEST(BuildPoints, KeepsEveryLawInTilesAndTheSameBytesForAnyNumberOfThreads) {
  for (const PointFamily& family : pointFamilies())
    for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent}) {
      const PointHeightfield field = family.make(test::isFull() ? 3000 : 1000, 5);
      RunContext context;
      context.threads = 1;
      const auto one = buildInTiles(field, withShape(shape), tilesOf(100), context);
      ASSERT_TRUE(one) << family.name << ": " << one.error().describe();
      const Status status = validateModel(*one);
      EXPECT_TRUE(status) << family.name << ": " << status.error().describe();
      for (const int threads : {2, 4}) {
        context.threads = threads;
        const auto many = buildInTiles(field, withShape(shape), tilesOf(100), context);
        ASSERT_TRUE(many);
        expectSameArrays(one->mt, many->mt, std::string(family.name) + " " + std::to_string(threads));
      }
    }
}

TEST(BuildPoints, StoresErrorsThatAreThoseOfAPlainScanRoundedOutwards) {
  for (const PointFamily& family : pointFamilies())
    for (const auto& [options, tiles] : eachWay()) {
      const PointHeightfield field = family.make(150, 3);
      const auto model = buildInTiles(field, options, tiles);
      ASSERT_TRUE(model) << family.name;
      const MultiTriangulation& mt = model->mt;
      double magnitude = 0, low = 1e300, high = -1e300;
      for (const double z : field.heights) {
        magnitude = std::max(magnitude, std::abs(z));
        low = std::min(low, z);
        high = std::max(high, z);
      }
      for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t) {
        const NodeId creator = mt.creator(TriangleId(t));
        if (creator.isValid() && mt.remover(TriangleId(t)) == creator) continue;
        const auto c = mt.corners(TriangleId(t));
        Vec3 p[3];
        for (int i = 0; i < 3; ++i) p[i] = mt.position(VertexId(c[i]));
        const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
        double inside = 0, around = 0;  // points well inside; points inside or within rounding of an edge
        for (std::size_t i = 0; i < field.size(); ++i) {
          const Vec2 q = field.positions[i];
          const double u = ((q.x - p[0].x) * (p[2].y - p[0].y) - (q.y - p[0].y) * (p[2].x - p[0].x)) / area;
          const double w = ((p[1].x - p[0].x) * (q.y - p[0].y) - (p[1].y - p[0].y) * (q.x - p[0].x)) / area;
          const double least = std::min({u, w, 1 - u - w});
          const double error =
              std::abs(p[0].z + u * (p[1].z - p[0].z) + w * (p[2].z - p[0].z) - field.heights[i]);
          if (least >= 1e-7) inside = std::max(inside, error);
          if (least >= -1e-7) around = std::max(around, error);
        }
        const double slack = 1e-6 * (high - low) + 1e-12 * magnitude;
        ASSERT_GE(mt.error(TriangleId(t)), inside - slack) << family.name << " triangle " << t;
        ASSERT_LE(mt.error(TriangleId(t)), around * (1 + 1.0 / 1024) + slack)
            << family.name << " triangle " << t;
      }
    }
}

/// The bound over the continuous triangle: random points of random triangles against the finest
/// triangulation, in which each is looked for among all triangles.
TEST(BuildPoints, StoresBoundsThatContainTheDifferenceEverywhereInATriangle) {
  Random random(5);
  for (const PointFamily& family : pointFamilies())
    for (const auto& [options, tiles] : eachWay()) {
      const PointHeightfield field = family.make(150, 4);
      const auto model = buildInTiles(field, options, tiles);
      ASSERT_TRUE(model) << family.name;
      const auto finest = finestPoints(field);
      ASSERT_TRUE(finest);
      const auto finestTriangles = finest->trianglesOfPoints();
      double magnitude = 0;
      for (const double z : field.heights) magnitude = std::max(magnitude, std::abs(z));
      /// Weights of the corners at x, y; the last number is twice the area.
      const auto weights = [&](const std::array<Vec3, 3>& p, double x, double y) {
        const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
        const double u = ((x - p[0].x) * (p[2].y - p[0].y) - (y - p[0].y) * (p[2].x - p[0].x)) / area;
        const double w = ((p[1].x - p[0].x) * (y - p[0].y) - (p[1].y - p[0].y) * (x - p[0].x)) / area;
        return std::array{1 - u - w, u, w, area};
      };
      const auto reference = [&](double x, double y) {
        for (const auto& t : finestTriangles) {
          std::array<Vec3, 3> p;
          for (std::size_t i = 0; i < 3; ++i)
            p[i] = {field.positions[t[i]].x, field.positions[t[i]].y, field.heights[t[i]]};
          const auto [a, b, c, area] = weights(p, x, y);
          if (!(std::min({a, b, c}) >= 1e-6)) continue;
          return a * p[0].z + b * p[1].z + c * p[2].z;
        }
        return std::nan("");  // on an edge, within rounding, or in a needle
      };
      const MultiTriangulation& mt = model->mt;
      for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t) {
        const NodeId creator = mt.creator(TriangleId(t));
        if (creator.isValid() && mt.remover(TriangleId(t)) == creator) continue;
        const auto corners = mt.corners(TriangleId(t));
        std::array<Vec3, 3> p;
        for (std::size_t i = 0; i < 3; ++i) p[i] = mt.position(VertexId(corners[i]));
        for (int k = 0; k < 9; ++k) {
          double u = random.unit(), w = random.unit();
          if (u + w > 1) u = 1 - u, w = 1 - w;
          if (k % 3 == 0) w *= 1e-3;  // beside an edge
          const double x = p[0].x + u * (p[1].x - p[0].x) + w * (p[2].x - p[0].x);
          const double y = p[0].y + u * (p[1].y - p[0].y) + w * (p[2].y - p[0].y);
          const auto [a, b, c, area] = weights(p, x, y);
          if (!(std::min({a, b, c}) >= 1e-6)) continue;
          const double z = reference(x, y);
          if (std::isnan(z)) continue;
          const double difference = a * p[0].z + b * p[1].z + c * p[2].z - z;
          const double slack = 1e-9 * magnitude;
          ASSERT_LE(difference, mt.arrays().scale.decode(mt.arrays().columns.of(kAbove)[t]) + slack)
              << family.name << " triangle " << t;
          ASSERT_GE(difference, -double(mt.arrays().scale.decode(mt.arrays().columns.of(kBelow)[t])) - slack)
              << family.name << " triangle " << t;
        }
      }
    }
}

/// The same points, told in another order.
TEST(BuildPoints, BuildsTheSameModificationsHoweverThePointsAreNumbered) {
  for (const PointFamily& family : pointFamilies()) {
    const PointHeightfield field = family.make(700, 3);
    PointHeightfield turned = field;
    std::ranges::reverse(turned.positions);
    std::ranges::reverse(turned.heights);
    const auto one = build(field), other = build(turned);
    ASSERT_TRUE(one) << family.name;
    ASSERT_TRUE(other) << family.name;
    expectSameArrays(one->mt, other->mt, std::string(family.name));
  }
}

TEST(BuildPoints, KeepsFixedVerticesInTheRoot) {
  const PointHeightfield field = pointFamilies().front().make(400, 2);
  BuildOptions options;
  options.fixedVertices = {3, 77, 200};
  const auto model = build(field, options);
  ASSERT_TRUE(model);
  ASSERT_EQ(model->options.fixedVertices.size(), 3u);
  std::vector<Vec2> kept, wanted;
  for (const std::uint32_t v : model->options.fixedVertices) {
    EXPECT_LT(v, model->mt.rootVertexCount());
    const Vec3 p = model->mt.position(VertexId(v));
    kept.push_back({p.x, p.y});
  }
  for (const std::uint32_t v : options.fixedVertices) wanted.push_back(field.positions[v]);
  EXPECT_TRUE(std::ranges::is_permutation(kept, wanted));
}

TEST(BuildPoints, KeepsEveryLawWherePointsStandInRowsThatDoublesBend) {
  for (const double slope : {0.37, 0.1, 1.0 / 3}) {
    PointHeightfield field;
    for (int i = 1; i <= 160; ++i)
      for (const double turn : {0.0, 0.1, 0.2}) {  // rows through the origin: not quite straight
        const double x = 0.7 * i;
        field.positions.push_back({x, (slope + turn) * x});
        field.heights.push_back(100 * std::sin(x / 5) + (i * 37 + int(50 * turn)) % 20);
      }
    for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent}) {
      const auto model = build(field, withShape(shape));
      ASSERT_TRUE(model) << slope << ": " << model.error().describe();
      const Status valid = validateModel(*model);
      EXPECT_TRUE(valid) << slope << ": " << valid.error().describe();
    }
  }
}

TEST(BuildPoints, RefusesAtOnceWhatPointsDoNotHave) {
  const PointHeightfield field = pointFamilies().front().make(100, 1);
  BuildOptions options;
  EXPECT_TRUE(checkBuild(field, options));
  options.rimTolerance = 1;
  const Status status = checkBuild(field, options);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, ErrorCode::usage);
  EXPECT_EQ(status.error().culprit, "rimTolerance");
  const auto model = build(field, options);
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().describe(), status.error().describe());
}

TEST(BuildPoints, RefusesWhatSpansMoreThanSpheresHold) {
  PointHeightfield field;
  for (const double unit : {1e35, 1e200}) {
    field.positions = {{0, 0}, {unit, 0}, {0, unit}, {unit, unit}, {0.4 * unit, 0.3 * unit}};
    field.heights = {1, 2, 3, 4, 5};
    const auto model = build(field);
    ASSERT_FALSE(model) << unit;
    EXPECT_EQ(model.error().code, ErrorCode::invalidData);
    EXPECT_NE(model.error().message.find("spans"), std::string::npos) << model.error().message;
  }
}

TEST(BuildPoints, AnswersDegenerateInputWithASentence) {
  for (const PointFamily& family : degeneratePointFamilies()) {
    const auto model = build(family.make(12, 1));
    ASSERT_FALSE(model) << family.name;
    EXPECT_EQ(model.error().code, ErrorCode::degenerate) << family.name << ": " << model.error().describe();
  }
}

TEST(BuildPoints, NamesBothPointsThatShareAPlaceAndNotAHeight) {
  PointHeightfield field;
  field.positions = {{0, 0}, {1, 0}, {0, 1}, {1, 0}};
  field.heights = {1, 2, 3, 4};
  const auto model = build(field);
  ASSERT_FALSE(model);
  EXPECT_NE(model.error().message.find("points 1 and 3"), std::string::npos) << model.error().message;
}

}  // namespace
}  // namespace arete

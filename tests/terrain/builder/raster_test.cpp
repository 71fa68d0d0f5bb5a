// SPDX-License-Identifier: GPL-3.0-or-later
//
// The laws on every generated family, for both hole shapes and any number of threads. Errors and bounds are
// held against a plain oracle that looks at every sample for every triangle.
#include "terrain/builder/build.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>

#include "datasets/families.h"
#include "datasets/random.h"
#include "engine/laws/validate.h"
#include "terrain/build_fixture.h"
#include "terrain/laws/validate_model.h"
#include "terrain/triangulation/finest_raster.h"

namespace arete {
namespace {

struct Shape {
  std::uint32_t columns, rows;
};
std::vector<Shape> shapes() {
  return {{2, 2}, {3, 2}, {2, 9}, {17, 17}, {41, 33}};
}

void forEachRaster(
    const std::function<void(const RasterFamily&, const RasterHeightfield&, const std::string&)>& run) {
  for (const RasterFamily& family : rasterFamilies())
    for (const Shape& shape : shapes())
      for (const std::uint64_t seed : seeds()) {
        const std::string name = std::string(family.name) + " " + std::to_string(shape.columns) + " x " +
                                 std::to_string(shape.rows) + " seed " + std::to_string(seed);
        run(family, family.make(shape.columns, shape.rows, seed), name);
      }
}

TEST(BuildRaster, KeepsEveryLawOnEveryFamilyForBothShapes) {
  forEachRaster([](const RasterFamily&, const RasterHeightfield& field, const std::string& name) {
    for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent}) {
      const auto model = build(field, withShape(shape));
      ASSERT_TRUE(model) << name << ": " << model.error().describe();
      const Status status = validateModel(*model);
      EXPECT_TRUE(status) << name << " " << toString(shape) << ": " << status.error().describe();
    }
  });
}

TEST(BuildRaster, KeepsLaws5And9OnAThousandRandomClosedSetsPerFamily) {
  const std::uint32_t fronts = 1000;
  for (const RasterFamily& family : rasterFamilies()) {
    const auto model = build(family.make(24, 19, 7));
    ASSERT_TRUE(model) << family.name;
    const Status status = validateModel(*model, {.randomFronts = fronts, .seed = 20260});
    EXPECT_TRUE(status) << family.name << ": " << status.error().describe();
    const auto fidelity = build(family.make(24, 19, 7), withShape(HoleShape::dataDependent));
    ASSERT_TRUE(fidelity) << family.name;
    const Status other = validateModel(*fidelity, {.randomFronts = fronts, .seed = 20261});
    EXPECT_TRUE(other) << family.name << ": " << other.error().describe();
  }
}

TEST(BuildRaster, GivesTheSameBytesForAnyNumberOfThreads) {
  for (const RasterFamily& family : rasterFamilies())
    for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent}) {
      const RasterHeightfield field = family.make(90, 70, 11);
      RunContext context;
      context.threads = 1;
      const auto one = build(field, withShape(shape), context);
      ASSERT_TRUE(one) << family.name;
      for (const int threads : {2, 4}) {
        context.threads = threads;
        const auto many = build(field, withShape(shape), context);
        ASSERT_TRUE(many);
        expectSameArrays(one->mt, many->mt, std::string(family.name) + " " + std::to_string(threads));
      }
    }
}

TEST(BuildRaster, KeepsEveryLawInTilesAndTheSameBytesForAnyNumberOfThreads) {
  for (const RasterFamily& family : rasterFamilies()) {
    const RasterHeightfield field = family.make(90, 70, 12);
    const auto finest = finestTriangulation(field);
    for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent})
      for (const std::uint32_t vertices : {20u, 300u}) {
        const std::string name = std::string(family.name) + " " + std::to_string(vertices);
        BuildOptions options = withShape(shape);
        for (std::size_t t = 0; t < finest.size(); t += 83) options.fixedVertices.push_back(finest[t][0]);
        RunContext context;
        context.threads = 1;
        const auto one = buildInTiles(field, options, tilesOf(vertices), context);
        ASSERT_TRUE(one) << name << ": " << one.error().describe();
        const Status status = validateModel(*one);
        EXPECT_TRUE(status) << name << ": " << status.error().describe();
        for (const int threads : {2, 4}) {
          context.threads = threads;
          const auto many = buildInTiles(field, options, tilesOf(vertices), context);
          ASSERT_TRUE(many);
          expectSameArrays(one->mt, many->mt, name + " " + std::to_string(threads));
        }
      }
  }
}

TEST(BuildRaster, KeepsTheLawsWithARimToleranceAndNeverUncoversASample) {
  forEachRaster([](const RasterFamily&, const RasterHeightfield& field, const std::string& name) {
    for (const double tolerance : {0.5, 1.5, 4.0}) {
      BuildOptions options;
      options.rimTolerance = tolerance;
      const auto model = build(field, options);
      ASSERT_TRUE(model) << name << ": " << model.error().describe();
      const Status status = validateModel(*model);
      EXPECT_TRUE(status) << name << " tolerance " << tolerance << ": " << status.error().describe();
      const MultiTriangulation& mt = model->mt;
      const double finest = domainExtent(mt).area;
      double root = 0;
      for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t) {
        const auto c = mt.corners(TriangleId(t));
        Vec2 p[3];
        for (int i = 0; i < 3; ++i) p[i] = mt.vertices().planPosition(VertexId(c[i]));
        root += ((p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x)) / 2;
      }
      EXPECT_GE(root, finest * (1 - 1e-12)) << name;
    }
  });
}

TEST(BuildRaster, ClosesAVoidBesideTheBorderWhoseRimPinches) {
  for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent})
    for (const std::uint32_t columns : {4u, 5u, 8u, 9u})
      for (const double tolerance : {1.0, 2.0, 8.0}) {
        SCOPED_TRACE(testing::Message() << columns << " columns, rim tolerance " << tolerance);
        RasterHeightfield field;
        field.columns = columns;
        field.rows = 7;
        field.heights.assign(std::size_t{7} * columns, 5.0);
        field.heights[3 * columns + columns - 2] = std::nan("");
        BuildOptions options;
        options.shape = shape;
        options.rimTolerance = tolerance;
        const auto model = build(field, options);
        ASSERT_TRUE(model) << model.error().describe();
        const Status status = validateModel(*model);
        EXPECT_TRUE(status) << status.error().describe();
        // The raster's corners, and the sample on its border that two fans share.
        if (tolerance >= 2) {
          EXPECT_EQ(model->mt.rootVertexCount(), 5u);
        }
      }
}

TEST(BuildRaster, EndsOnFlatGroundHoweverSmallItsHeight) {
  for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent})
    for (const double height : {1.7e-31, 1e-300, 0.1, 0.3, -1e30 / 3}) {
      SCOPED_TRACE(height);
      RasterHeightfield field;
      field.columns = field.rows = 5;
      field.heights.assign(25, height);
      BuildOptions options;
      options.shape = shape;
      options.fixedVertices = {0, 7, 11};
      const auto model = build(field, options);
      ASSERT_TRUE(model) << model.error().describe();
      EXPECT_EQ(model->mt.rootVertexCount(), 6u) << "corners and fixed vertices";
    }
}

TEST(BuildRaster, ReproducesEverySampleToTheBit) {
  forEachRaster([](const RasterFamily&, const RasterHeightfield& field, const std::string& name) {
    const auto model = build(field);
    ASSERT_TRUE(model) << name;
    const RasterHeightfield back = model->rasterSamples();
    ASSERT_EQ(back.heights.size(), field.heights.size());
    for (std::size_t i = 0; i < field.heights.size(); ++i) {
      if (std::isnan(field.heights[i]))
        ASSERT_TRUE(std::isnan(back.heights[i])) << name << " sample " << i;
      else
        ASSERT_EQ(std::memcmp(&back.heights[i], &field.heights[i], sizeof(double)), 0)
            << name << " sample " << i;
    }
  });
}

/// Every triangle of the MT against every sample, by plain barycentric coordinates.
TEST(BuildRaster, StoresErrorsThatAreThoseOfAPlainScanRoundedOutwards) {
  for (const RasterFamily& family : rasterFamilies())
    for (const auto& [options, tiles] : eachWay()) {
      const RasterHeightfield field = family.make(21, 18, 4);
      const auto model = buildInTiles(field, options, tiles);
      ASSERT_TRUE(model) << family.name;
      const MultiTriangulation& mt = model->mt;
      double magnitude = 0;
      for (const double z : field.heights)
        magnitude = std::isnan(z) ? magnitude : std::max(magnitude, std::abs(z));
      for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t) {
        const NodeId creator = mt.creator(TriangleId(t));
        if (creator.isValid() && mt.remover(TriangleId(t)) == creator) continue;
        const auto c = mt.corners(TriangleId(t));
        Vec3 p[3];
        for (int i = 0; i < 3; ++i) p[i] = mt.position(VertexId(c[i]));
        const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x);
        double error = 0, low = 0, high = 0;
        for (std::uint32_t row = 0; row < field.rows; ++row)
          for (std::uint32_t column = 0; column < field.columns; ++column) {
            const double z = field.at(column, row);
            if (std::isnan(z)) continue;
            const double x = column, y = row;
            const double u = ((x - p[0].x) * (p[2].y - p[0].y) - (y - p[0].y) * (p[2].x - p[0].x));
            const double w = ((p[1].x - p[0].x) * (y - p[0].y) - (p[1].y - p[0].y) * (x - p[0].x));
            if (u < 0 || w < 0 || u + w > area) continue;
            const double plane = p[0].z + u / area * (p[1].z - p[0].z) + w / area * (p[2].z - p[0].z);
            error = std::max(error, std::abs(plane - z));
            low = std::min(low, plane - z);
            high = std::max(high, plane - z);
          }
        const double slack = 1e-13 * magnitude;
        const double stored = mt.error(TriangleId(t));
        ASSERT_GE(stored, error - slack) << family.name << " triangle " << t;
        const double floorMagnitude = double(mt.arrays().scale.decode(1));
        ASSERT_LE(stored, std::max(error * (1 + 1.0 / 1024) + 100 * slack, floorMagnitude))
            << family.name << " triangle " << t;
        const double below = mt.arrays().scale.decode(mt.arrays().columns.of(kBelow)[t]),
                     above = mt.arrays().scale.decode(mt.arrays().columns.of(kAbove)[t]);
        ASSERT_GE(below, -low - slack) << family.name << " triangle " << t;
        ASSERT_GE(above, high - slack) << family.name << " triangle " << t;
      }
    }
}

/// The bound over the continuous triangle: random points of random triangles against the finest
/// triangulation.
TEST(BuildRaster, StoresBoundsThatContainTheDifferenceEverywhereInATriangle) {
  Random random(5);
  for (const RasterFamily& family : rasterFamilies())
    for (const double rimTolerance : {0.0, 2.0}) {
      const RasterHeightfield field = family.make(21, 18, 4);
      BuildOptions options;
      options.rimTolerance = rimTolerance;
      const auto model = build(field, options);
      ASSERT_TRUE(model) << family.name;
      const MultiTriangulation& mt = model->mt;
      const auto reference = [&](double x, double y) {
        const auto c = std::min(static_cast<std::uint32_t>(x), field.columns - 2);
        const auto r = std::min(static_cast<std::uint32_t>(y), field.rows - 2);
        const double fx = x - c, fy = y - r;
        const double ul = field.at(c, r), ur = field.at(c + 1, r), ll = field.at(c, r + 1),
                     lr = field.at(c + 1, r + 1);
        const bool split = !std::isnan(ul) && !std::isnan(lr);
        if (split && fx >= fy) return ul + fx * (ur - ul) + fy * (lr - ur);
        if (split) return ul + fy * (ll - ul) + fx * (lr - ll);
        if (!std::isnan(ul) && fx + fy <= 1) return ul + fx * (ur - ul) + fy * (ll - ul);
        if (!std::isnan(lr) && fx + fy >= 1) return lr + (1 - fx) * (ll - lr) + (1 - fy) * (ur - lr);
        return std::nan("");
      };
      double magnitude = 0;
      for (const double z : field.heights)
        magnitude = std::isnan(z) ? magnitude : std::max(magnitude, std::abs(z));
      for (std::uint32_t t = 0; t < mt.triangleIdCount(); ++t) {
        const NodeId creator = mt.creator(TriangleId(t));
        if (creator.isValid() && mt.remover(TriangleId(t)) == creator) continue;
        const auto c = mt.corners(TriangleId(t));
        Vec3 p[3];
        for (int i = 0; i < 3; ++i) p[i] = mt.position(VertexId(c[i]));
        for (int k = 0; k < 12; ++k) {
          double u = random.unit(), w = random.unit();
          if (u + w > 1) u = 1 - u, w = 1 - w;
          if (k % 3 == 0) w = 0;
          const double x = p[0].x + u * (p[1].x - p[0].x) + w * (p[2].x - p[0].x);
          const double y = p[0].y + u * (p[1].y - p[0].y) + w * (p[2].y - p[0].y);
          const double z = reference(x, y);
          if (std::isnan(z)) continue;
          const double difference = p[0].z + u * (p[1].z - p[0].z) + w * (p[2].z - p[0].z) - z;
          const double slack = 1e-11 * std::max(1.0, magnitude);
          ASSERT_LE(difference, mt.arrays().scale.decode(mt.arrays().columns.of(kAbove)[t]) + slack)
              << family.name << " triangle " << t;
          ASSERT_GE(difference, -double(mt.arrays().scale.decode(mt.arrays().columns.of(kBelow)[t])) - slack)
              << family.name << " triangle " << t;
        }
      }
    }
}

TEST(BuildRaster, TakesAPlaneDownToItsCorners) {
  for (const RasterFamily& family : rasterFamilies()) {
    if (family.name != "flat" && family.name != "ramp") continue;
    const auto model = build(family.make(40, 30, 1));
    ASSERT_TRUE(model);
    EXPECT_EQ(model->mt.rootTriangleCount(), 2u) << family.name;
    EXPECT_EQ(model->mt.rootVertexCount(), 4u) << family.name;
  }
}

TEST(BuildRaster, KeepsFixedVerticesInTheRoot) {
  const RasterHeightfield field = rasterFamilies()[0].make(30, 20, 2);
  BuildOptions options;
  options.fixedVertices = {field.index(7, 9), field.index(15, 3), field.index(0, 11)};
  const auto model = build(field, options);
  ASSERT_TRUE(model) << model.error().describe();
  const auto roots = model->mt.vertices().samples.subspan(0, model->mt.rootVertexCount());
  for (const std::uint32_t v : options.fixedVertices)
    EXPECT_NE(std::find(roots.begin(), roots.end(), v), roots.end()) << v;
  EXPECT_TRUE(validateModel(*model));
}

TEST(BuildRaster, AnswersDegenerateInputWithASentence) {
  for (const RasterFamily& family : degenerateFamilies()) {
    const auto model = build(family.make(12, 9, 1));
    ASSERT_FALSE(model) << family.name;
    EXPECT_EQ(model.error().code, ErrorCode::degenerate) << family.name;
    EXPECT_GT(model.error().message.size(), 10u) << family.name;
  }
}

TEST(BuildRaster, RefusesOptionsOutOfRangeAndNamesThem) {
  const RasterHeightfield field = rasterFamilies()[0].make(8, 8, 1);
  const auto culpritOf = [&](BuildOptions options) {
    const auto model = build(field, options);
    return model ? std::string("accepted") : model.error().culprit;
  };
  EXPECT_EQ(culpritOf({.maxDegree = 3}), "maxDegree");
  EXPECT_EQ(culpritOf({.thresholdRatio = 1.0}), "thresholdRatio");
  EXPECT_EQ(culpritOf({.thresholdRatio = NAN}), "thresholdRatio");
  EXPECT_EQ(culpritOf({.minimumAspect = -1}), "minimumAspect");
  EXPECT_EQ(culpritOf({.rimTolerance = -0.5}), "rimTolerance");
  EXPECT_EQ(culpritOf({.fixedVertices = {64}}), "fixedVertices");
}

TEST(BuildRaster, RecordsTheThresholdRatioThatItTookAndTakesTheOneThatIsStated) {
  RasterHeightfield field;
  field.columns = 40;
  field.rows = 30;
  Random random(3);
  for (std::uint32_t i = 0; i < field.columns * field.rows; ++i)
    field.heights.push_back(50 * std::sin(0.2 * (i % 40)) * std::cos(0.3 * (i / 40)) + random.between(0, 9));
  for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent}) {
    BuildOptions options = withShape(shape);
    const auto unstated = build(field, options);
    ASSERT_TRUE(unstated);
    EXPECT_EQ(unstated->options.thresholdRatio, defaultThresholdRatio(shape));
    options.thresholdRatio = defaultThresholdRatio(shape);
    const auto stated = build(field, options);
    ASSERT_TRUE(stated);
    expectSameArrays(unstated->mt, stated->mt, "the default, stated");
    options.thresholdRatio = 3;
    const auto fewerLevels = build(field, options);
    ASSERT_TRUE(fewerLevels);
    EXPECT_EQ(fewerLevels->options.thresholdRatio, 3);
    EXPECT_LT(fewerLevels->levels, stated->levels) << "larger steps";
  }
}

TEST(BuildRaster, StopsWhenAskedTo) {
  const std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  const auto model = build(rasterFamilies()[0].make(50, 50, 1), {}, context);
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().code, ErrorCode::interrupted);
}

TEST(BuildRaster, CountsIsolatedSamplesAndKeepsTheirHeights) {
  RasterHeightfield field;
  field.columns = 6;
  field.rows = 5;
  field.heights.assign(30, std::nan(""));
  for (std::uint32_t row = 0; row < 3; ++row)
    for (std::uint32_t column = 0; column < 3; ++column)
      field.heights[field.index(column, row)] = 10 + column * row;
  field.heights[field.index(5, 4)] = 77;
  const auto model = build(field);
  ASSERT_TRUE(model);
  ASSERT_EQ(model->isolated.size(), 1u);
  EXPECT_EQ(model->isolated[0].sample, field.index(5, 4));
  EXPECT_EQ(model->rasterSamples().at(5, 4), 77);
}

TEST(BuildRaster, RefusesWhatSpansMoreThanSpheresHold) {
  RasterHeightfield field;
  field.columns = field.rows = 3;
  field.heights.assign(9, 7);
  field.georeference.geoTransform = {0, 1e40, 0, 0, 0, -1e40};
  field.georeference.hasGeoTransform = true;
  const auto model = build(field);
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().code, ErrorCode::invalidData);
}

}  // namespace
}  // namespace arete

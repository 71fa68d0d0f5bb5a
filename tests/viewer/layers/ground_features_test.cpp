// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle of a draped line is the finest triangulation itself, asked at many places between the vertices.
#include "viewer/layers/ground_features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "datasets/families.h"
#include "datasets/random.h"
#include "terrain/builder/build.h"
#include "terrain/model/plan_box.h"
#include "terrain/sight/grid.h"

namespace arete {
namespace {

TerrainModel placedModel(RasterHeightfield field) {
  field.georeference = {};
  field.georeference.geoTransform = {512345.6, 30, 0, 5234567.8, 0, -30};
  field.georeference.hasGeoTransform = true;
  Result<TerrainModel> model = build(field);
  EXPECT_TRUE(model);
  return std::move(*model);
}

FeatureLayer randomLines(const TerrainModel& model, Random& random, int lines, int vertices) {
  FeatureLayer layer;
  layer.name = "random";
  const double columns = model.isRaster ? model.columns - 1.0 : 1,
               rows = model.isRaster ? model.rows - 1.0 : 1;
  for (int i = 0; i < lines; ++i) {
    layer.lines.push_back({layer.vertices.size(), std::uint64_t(vertices)});
    for (int k = 0; k < vertices; ++k)
      layer.vertices.push_back(
          model.toSource({random.between(-0.2, 1.2) * columns, random.between(-0.2, 1.2) * rows}));
  }
  return layer;
}

TEST(GroundFeatures, LinesFollowTheFinestTriangulation) {
  for (const RasterFamily& family : rasterFamilies())
    for (std::uint64_t seed : {1, 2}) {
      const TerrainModel model = placedModel(family.make(14, 11, seed));
      const GroundHeights heights(model);
      Random random(seed);
      const FeatureLayer layer = randomLines(model, random, 6, 4);
      for (const bool hasGrid : {false, true}) {
        const Profiles profiles(model, hasGrid ? std::make_shared<const SightGrid>(model) : nullptr);
        const auto ground = layOnGround(layer, profiles);
        if (!ground) continue;  // beside the terrain
        ASSERT_EQ(ground->begin.back(), ground->vertices.size());
        for (std::uint64_t line = 0; line < ground->lines(); ++line)
          for (std::uint64_t i = ground->begin[line] + 1; i < ground->begin[line + 1]; ++i)
            for (double t = 0.05; t < 1; t += 0.1) {
              const auto &a = ground->vertices[i - 1], &b = ground->vertices[i];
              const auto there = heights.at(a.xy + t * (b.xy - a.xy));
              ASSERT_TRUE(there) << family.name << " seed " << seed;
              const double relief = 1 + std::abs(there->height);
              EXPECT_NEAR(a.height + t * (b.height - a.height), there->height, 1e-6 * relief)
                  << family.name << " seed " << seed << " grid " << hasGrid;
            }
      }
    }
}

TEST(GroundFeatures, LinesFollowATriangulationOfPoints) {
  for (const PointFamily& family : pointFamilies()) {
    const PointHeightfield field = family.make(120, 3);
    const Result<TerrainModel> model = build(field);
    ASSERT_TRUE(model) << family.name;
    const Box2 box = planBox(*model);
    Random random(5);
    FeatureLayer layer;
    layer.name = family.name;
    for (int i = 0; i < 5; ++i) {
      layer.lines.push_back({layer.vertices.size(), 2});
      for (int k = 0; k < 2; ++k)
        layer.vertices.push_back({random.between(box.xMin, box.xMax), random.between(box.yMin, box.yMax)});
    }
    const Profiles profiles(*model);
    const auto ground = layOnGround(layer, profiles);
    if (!ground) continue;  // beside the terrain
    for (std::uint64_t line = 0; line < ground->lines(); ++line)
      for (std::uint64_t i = ground->begin[line] + 1; i < ground->begin[line + 1]; ++i)
        for (double t = 0.1; t < 1; t += 0.2) {
          const auto &a = ground->vertices[i - 1], &b = ground->vertices[i];
          const auto there = profiles.heights().at(a.xy + t * (b.xy - a.xy));
          ASSERT_TRUE(there) << family.name;
          EXPECT_NEAR(a.height + t * (b.height - a.height), there->height,
                      1e-6 * (1 + std::abs(there->height)))
              << family.name;
        }
  }
}

/// A plane of 8 by 8 samples with a hole in the middle.
TerrainModel withAHole() {
  RasterHeightfield field;
  field.columns = field.rows = 8;
  for (std::uint32_t row = 0; row < 8; ++row)
    for (std::uint32_t col = 0; col < 8; ++col)
      field.heights.push_back(row > 2 && row < 5 && col > 2 && col < 5 ? NAN : 10.0 * col);
  return placedModel(std::move(field));
}

TEST(GroundFeatures, CountsWhatIsBesideTheTerrainAndEndsLinesAtVoids) {
  const TerrainModel model = withAHole();
  FeatureLayer layer;
  layer.name = "a";
  const auto at = [&](double column, double row) { return model.toSource({column, row}); };
  layer.points = {{at(1, 1)}, {at(3.5, 3.5)}, {at(-4, 1)}};
  layer.vertices = {at(0.5, 3.5), at(6.5, 3.5), at(9, 9), at(12, 9)};
  layer.lines = {{0, 2}, {2, 2}};
  layer.labels = {{"way", {}, 0}, {"far", {}, 1}, {"peak", {at(1, 1)}}, {"hole", {at(3.5, 3.5)}}};
  const Profiles profiles(model);
  const auto ground = layOnGround(layer, profiles);
  ASSERT_TRUE(ground) << ground.error().describe();
  ASSERT_EQ(ground->points.size(), 1u);
  EXPECT_NEAR(ground->points[0].height, 10, 1e-9);
  EXPECT_EQ(ground->lines(), 2u) << "one run on either side of the hole";
  ASSERT_EQ(ground->labels.size(), 2u);
  EXPECT_EQ(ground->labels[0].text, "way");
  EXPECT_EQ(ground->labels[1].text, "peak");
  const auto says = [&](const std::string& sentence) {
    return std::ranges::any_of(ground->warnings, [&](const Warning& w) { return w.sentence == sentence; });
  };
  EXPECT_TRUE(says("2 of 3 points are not on the terrain and not drawn"));
  EXPECT_TRUE(says("1 of 2 lines is not on the terrain and not drawn"));
  EXPECT_TRUE(says("1 of 2 lines is not on the terrain everywhere and drawn where it is"));
  EXPECT_TRUE(says("2 of 4 labels have no place on the terrain and are not drawn"));
}

TEST(GroundFeatures, PutsTheLabelOfAPolygonIntoItsPartOnTheTerrain) {
  const TerrainModel model = withAHole();
  FeatureLayer layer;
  layer.name = "parks";
  const auto ring = [&](std::uint64_t polygon, const std::vector<Vec2>& corners) {
    layer.lines.push_back({layer.vertices.size(), corners.size() + 1, polygon});
    for (const Vec2& corner : corners) layer.vertices.push_back(model.toSource(corner));
    layer.vertices.push_back(model.toSource(corners.front()));
  };
  const auto square = [](double x, double y, double side) {
    return std::vector<Vec2>{{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
  };
  const auto label = [&](const std::string& text, std::uint64_t first, std::uint64_t end) {
    layer.labels.push_back({.text = text, .polygon = first, .firstPolygon = first, .endPolygon = end});
  };
  ring(0, square(0, 0, 2));  // with a hole of its own
  ring(0, square(0.6, 0.6, 0.8));
  label("holed", 0, 1);
  ring(1, {{0, 3}, {0.5, 3}, {0.5, 6.5}, {3, 6.5}, {3, 7}, {0, 7}});
  label("bent", 1, 2);
  ring(2, square(6, 0, 20));
  label("over the edge", 2, 3);
  ring(3, square(1.5, 1.5, 4));
  label("around the void", 3, 4);
  ring(4, square(50, 50, 9));
  ring(5, square(5, 5, 1));
  label("largest part elsewhere", 4, 6);
  ring(6, square(1.9, 1.9, 3.3));
  label("mostly void", 6, 7);
  ring(7, {{0, 0}, {7, 6.99}, {7, 7}});
  label("narrow", 7, 8);
  ring(8, square(50, 50, 9));
  label("elsewhere", 8, 9);
  const auto ground = layOnGround(layer, Profiles(model));
  ASSERT_TRUE(ground) << ground.error().describe();
  const GroundHeights heights(model);
  const auto isIn = [&](std::uint64_t polygon, Vec2 p) {
    bool in = false;
    for (const auto& line : layer.lines)
      for (std::uint64_t i = line.first + 1; line.polygon == polygon && i < line.first + line.count; ++i) {
        const Vec2 a = model.toPlan(layer.vertices[i - 1]), b = model.toPlan(layer.vertices[i]);
        if ((a.y <= p.y) != (b.y <= p.y) && a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) > p.x) in = !in;
      }
    return in;
  };
  ASSERT_EQ(ground->labels.size(), layer.labels.size() - 1) << "all but the one elsewhere";
  for (std::size_t i = 0; i < ground->labels.size(); ++i) {
    const auto& made = ground->labels[i];
    EXPECT_EQ(made.text, layer.labels[i].text);
    const Vec2 p = model.toPlan(made.at.xy);
    bool isInside = false;
    for (std::uint64_t k = layer.labels[i].firstPolygon; k < layer.labels[i].endPolygon; ++k)
      isInside = isInside || isIn(k, p);
    EXPECT_TRUE(isInside) << made.text << " at " << p.x << " " << p.y;
    const auto there = heights.at(made.at.xy);
    ASSERT_TRUE(there) << made.text;
    EXPECT_NEAR(made.at.height, there->height, 1e-9) << made.text;
  }
  const Vec2 edge = model.toPlan(ground->labels[2].at.xy);
  EXPECT_NEAR(edge.x, 6.5, 0.1) << "in the middle of the strip that is on the terrain";
  EXPECT_TRUE(std::ranges::any_of(ground->warnings, [](const Warning& w) {
    return w.sentence == "1 of 8 labels has no place on the terrain and is not drawn";
  }));
}

TEST(GroundFeatures, SaysThatALayerLiesOnVoids) {
  const TerrainModel model = withAHole();
  FeatureLayer layer;
  layer.name = "v";
  layer.points = {{model.toSource({3.5, 3.5})}};
  const auto ground = layOnGround(layer, Profiles(model));
  ASSERT_FALSE(ground);
  EXPECT_NE(ground.error().message.find("voids"), std::string::npos) << ground.error().message;
  EXPECT_EQ(ground.error().message.find("e+"), std::string::npos) << ground.error().message;
}

TEST(GroundFeatures, RefusesALayerThatIsElsewhereAndSaysWhere) {
  const TerrainModel model = withAHole();
  FeatureLayer layer;
  layer.name = "swapped";
  layer.points = {{{5234567.8, 512345.6}}};
  const Profiles profiles(model);
  const auto ground = layOnGround(layer, profiles);
  ASSERT_FALSE(ground);
  EXPECT_EQ(ground.error().code, ErrorCode::invalidData);
  EXPECT_NE(ground.error().message.find("5234568 512346"), std::string::npos) << ground.error().message;
}

TEST(GroundFeatures, PlacesStandAtTheirOwnHeightsIfAsked) {
  const TerrainModel model = withAHole();
  FeatureLayer layer;
  layer.name = "a";
  layer.points = {{model.toSource({3.5, 3.5}), 500}, {model.toSource({1, 1})}};
  layer.vertices = {model.toSource({0, 0}), model.toSource({7, 7})};
  layer.z = {100, 800};
  layer.lines = {{0, 2}};
  const Profiles profiles(model);
  const auto ground = layOnGround(layer, profiles, {.floats = true});
  ASSERT_TRUE(ground);
  ASSERT_EQ(ground->points.size(), 2u);
  EXPECT_EQ(ground->points[0].height, 500) << "over the hole as well";
  EXPECT_NEAR(ground->points[1].height, 10, 1e-9);
  EXPECT_EQ(ground->lines(), 1u);
  for (const auto& vertex : ground->vertices)
    EXPECT_NEAR(vertex.height, 100 + 700 * (vertex.xy.x - 512360.6) / 210, 1e-6);
}

TEST(GroundFeatures, JoinsThePiecesOfALongLine) {
  const TerrainModel model = placedModel(rasterFamilies()[0].make(40, 40, 1));
  FeatureLayer layer;
  layer.name = "spiral";
  constexpr int kCount = 5000;
  for (int i = 0; i < kCount; ++i) {
    const double angle = i * 0.02, radius = 18.0 * i / kCount;
    layer.vertices.push_back(
        model.toSource({19.5 + radius * std::cos(angle), 19.5 + radius * std::sin(angle)}));
  }
  layer.lines = {{0, kCount}};
  const Profiles profiles(model);
  const auto ground = layOnGround(layer, profiles);
  ASSERT_TRUE(ground);
  EXPECT_EQ(ground->lines(), 1u);
  EXPECT_GE(ground->vertices.size(), std::size_t(kCount));
  const auto refused = layOnGround(layer, profiles, {.mostVertices = 4000});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
}

}  // namespace
}  // namespace arete

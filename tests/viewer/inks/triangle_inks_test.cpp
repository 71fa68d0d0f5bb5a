// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/inks/triangle_inks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "surface/builder/build.h"
#include "surface/families.h"
#include "viewer/color/color_tables.h"
#include "viewer/inks/distance_colors.h"

namespace arete {
namespace {

/// A sheet in two charts; in the right one the picture is four times as dense in each direction.
SurfaceModel twoCharts() {
  SurfaceMesh mesh(shapes::sheet(12, 6));
  Attribute coords{.name = "texcoord",
                   .meaning = AttributeMeaning::textureCoords,
                   .type = ScalarType::float64,
                   .components = 2};
  for (const double scale : {0.01, 0.04})
    for (const Vec3& p : mesh.positions) coords.append(std::array{scale * p.x, scale * p.y});
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.wedgeCount = 2 * vertices;
  for (const auto& t : mesh.triangles) {
    double x = 0;
    for (const std::uint32_t v : t) x += mesh.positions[v].x / 3;
    mesh.wedges.push_back(t);
    if (x > 6)
      for (std::uint32_t& w : mesh.wedges.back()) w += vertices;
  }
  mesh.wedgeAttributes = {coords};
  return *buildSurface(mesh);
}

double middleX(const SurfaceModel& model, std::uint32_t t) {
  double x = 0;
  for (const std::uint32_t v : model.mt.corners(TriangleId(t))) x += model.mt.position(VertexId(v)).x / 3;
  return x;
}

/// The last slot of an open star is no triangle: its own node removes it.
bool isTriangle(const SurfaceModel& model, std::uint32_t t) {
  const NodeId remover = model.mt.remover(TriangleId(t));
  return !remover.isValid() || model.mt.creator(TriangleId(t)) != remover;
}

/// A coarse triangle may reach across the line, by no more than its error.
bool isOnOneSide(const SurfaceModel& model, std::uint32_t t) {
  const auto ids = model.mt.corners(TriangleId(t));
  const auto at = [&](std::size_t c) { return model.mt.position(VertexId(ids[c])).x; };
  const auto [low, high] = std::minmax({at(0), at(1), at(2)});
  return isTriangle(model, t) && (high <= 6 || low >= 6);
}

TEST(ChartInk, HasOneColourPerChartOnCoarseTrianglesToo) {
  const SurfaceModel model = twoCharts();
  const auto ink = chartInk(model);
  ASSERT_TRUE(ink) << ink.error().describe();
  EXPECT_EQ(ink->title, "charts: 2");
  ASSERT_EQ(ink->classes.size(), 2u);
  std::set<float> left, right;
  for (std::uint32_t t = 0; t < model.mt.triangleIdCount(); ++t)
    if (isOnOneSide(model, t)) (middleX(model, t) > 6 ? right : left).insert(ink->numbers[t]);
  ASSERT_EQ(left.size(), 1u);
  ASSERT_EQ(right.size(), 1u);
  EXPECT_NE(left, right);
  EXPECT_NE(ink->colors.at(*left.begin()), ink->colors.at(*right.begin()));
  std::set<std::size_t> shown;
  for (const float number : {*left.begin(), *right.begin()})
    for (std::size_t i = 0; i < 2; ++i)
      if (ink->classes[i].color == ink->colors.at(number)) shown.insert(i);
  EXPECT_EQ(shown.size(), 2u) << "the legend has other colours";
}

TEST(TriangleInks, OfASurfaceThatLacksThemAreRefusedByName) {
  const auto model = buildSurface(SurfaceMesh(shapes::sheet(3, 3)));
  ASSERT_TRUE(model);
  EXPECT_TRUE(inkNames(*model).empty());
  for (const char* const name : {"charts", "stretch", "error:uv", "error:", "heights"}) {
    const auto ink = inkNamed(*model, name);
    ASSERT_FALSE(ink) << name;
    EXPECT_EQ(ink.error().code, ErrorCode::usage);
    EXPECT_EQ(ink.error().culprit, name);
  }
}

TEST(StretchInk, IsOfTheAreaOnTheSurfaceForTheAreaInThePicture) {
  const SurfaceModel model = twoCharts();
  const auto ink = stretchInk(model);
  ASSERT_TRUE(ink) << ink.error().describe();
  // Areas: 36 squares of 1e-4 and 36 of 16e-4: the mean is 8.5e-4; the left is 8.5 times as stretched, and
  // every scale ends at eight times.
  for (std::uint32_t t = 0; t < model.mt.triangleIdCount(); ++t)
    if (isOnOneSide(model, t)) {
      EXPECT_NEAR(ink->numbers[t], middleX(model, t) > 6 ? std::log2(8.5 / 16) : 3, 1e-5);
    }
  EXPECT_EQ(ink->colors.at(3), colorTable("difference").at(1));
}

TEST(StretchInk, OfTrianglesWithoutAreaInThePictureIsTheMostAndOfThoseWithoutAnyNone) {
  SurfaceMesh mesh(TriangleMesh{.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                                .triangles = {{0, 1, 2}, {0, 2, 3}}});
  Attribute coords{.name = "texcoord",
                   .meaning = AttributeMeaning::textureCoords,
                   .type = ScalarType::float64,
                   .components = 2};
  for (const std::array<double, 2> uv :
       {std::array{0.0, 0.0}, std::array{1.0, 0.0}, std::array{1.0, 1.0}, std::array{0.5, 0.5}})
    coords.append(uv);
  mesh.vertexAttributes = {coords};
  const auto model = buildSurface(mesh);
  ASSERT_TRUE(model);
  const auto ink = stretchInk(*model);
  ASSERT_TRUE(ink) << ink.error().describe();
  // Both together have half the picture's area for the surface's 1: the mean is 2.
  std::multiset<float> numbers;
  for (std::uint32_t t = 0; t < model->mt.triangleIdCount(); ++t)
    if (!model->mt.remover(TriangleId(t)).isValid()) numbers.insert(ink->numbers[t]);
  EXPECT_EQ(numbers, (std::multiset<float>{-1, 3}));
}

/// The painted sheet, its colours wild on the right.
SurfaceModel boundedSheet() {
  SurfaceMesh mesh(shapes::sheet(12, 6));
  Attribute color{.name = "color",
                  .meaning = AttributeMeaning::color,
                  .type = ScalarType::uint8,
                  .components = 3,
                  .isNormalized = true};
  for (const Vec3& p : mesh.positions) {
    const double c = p.x > 6 && (int(p.x) + int(p.y)) % 2 != 0 ? 255 : 20;
    color.append(std::array{c, c, c});
  }
  mesh.vertexAttributes = {color};
  return *buildSurface(mesh, {.boundsAttributes = true});
}

TEST(AttributeErrorInk, IsWhatTheModelStatesOfEachTriangle) {
  const SurfaceModel model = boundedSheet();
  EXPECT_EQ(inkNames(model), (std::vector<std::string>{"error:color"}));
  const auto ink = inkNamed(model, "error:color");
  ASSERT_TRUE(ink) << ink.error().describe();
  EXPECT_EQ(ink->unit, "255ths");
  const AttributeErrors& stated = model.attributeErrors.at(0);
  double most = 0;
  for (std::uint32_t t = 0; t < model.mt.triangleIdCount(); ++t)
    if (std::isfinite(stated.of(t))) most = std::max(most, stated.of(t));
  ASSERT_GT(most, 0);
  EXPECT_NEAR(ink->ticks.back().first, std::log2(most), 1e-6);
  std::size_t cold = 0;
  for (std::uint32_t t = 0; t < model.mt.triangleIdCount(); ++t) {
    const double e = stated.of(t);
    if (!std::isfinite(e)) {
      EXPECT_TRUE(std::isnan(ink->numbers[t]));
      EXPECT_FALSE(ink->classes.empty());
      continue;
    }
    EXPECT_NEAR(ink->numbers[t], std::max(std::log2(e), std::log2(most) - 10), 1e-5);
    cold += e == 0 ? 1 : 0;
  }
  EXPECT_GT(cold, 0u) << "the left side and full resolution are off by nothing";
  EXPECT_EQ(attributeErrorInk(model, "uv").error().culprit, "error:uv");
}

TEST(AttributeErrorInk, OfADisplacedSurfaceIsRefused) {
  SurfaceModel model = boundedSheet();
  model.displacement.directions.resize(model.mt.vertexCount());
  EXPECT_TRUE(inkNames(model).empty());
  EXPECT_FALSE(attributeErrorInk(model, "color"));
}

TEST(DistanceColors, AreDarkWhereNothingIsApartAndHotAtTheLargest) {
  const TriangleMesh plane = shapes::sheet(4, 4);
  const auto found = distancesTo(plane, {{1, 1, 0}, {1, 1, 2}, {2, 3, -4}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->distances, (std::vector<float>{0, 2, 4}));
  EXPECT_EQ(found->largest, 4);
  EXPECT_EQ(found->mean, 2);
  const auto colors = distanceColors(*found, found->largest);
  const Rgba dark = colorTable("error").at(0), hot = colorTable("error").at(1);
  EXPECT_EQ(colors[0], dark.r);
  EXPECT_EQ(colors[8], hot.r);
  EXPECT_EQ(distanceLegend(4, "m").entries.front().label, "4");
  EXPECT_EQ(distanceColors(*found, 0)[4], dark.r);
}

}  // namespace
}  // namespace arete

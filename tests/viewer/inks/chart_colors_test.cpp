// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/inks/chart_colors.h"

#include <gtest/gtest.h>

#include <set>

#include "surface/builder/build.h"
#include "surface/families.h"
#include "viewer/color/color_tables.h"
#include "viewer/fronts/drawn_vertices.h"
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

std::array<std::uint8_t, 3> inkOf(const ComputedColors& of, std::size_t v) {
  return {of.colors[4 * v], of.colors[4 * v + 1], of.colors[4 * v + 2]};
}

TEST(ChartColors, AreOnePerChart) {
  const SurfaceModel model = twoCharts();
  const auto made = chartColors(model);
  ASSERT_TRUE(made) << made.error().describe();
  EXPECT_EQ(made->legend.title, "charts: 2");
  std::set<std::array<std::uint8_t, 3>> left, right;
  for (std::uint32_t t = 0; t < model.mt.triangleIdCount(); ++t) {
    if (model.mt.remover(TriangleId(t)).isValid()) continue;
    double x = 0;
    for (const std::uint32_t v : model.mt.corners(TriangleId(t))) x += model.mt.position(VertexId(v)).x / 3;
    for (const std::uint32_t w : model.wedgesOf[t]) (x > 6 ? right : left).insert(inkOf(*made, w));
  }
  EXPECT_EQ(left.size(), 1u);
  EXPECT_EQ(right.size(), 1u);
  EXPECT_NE(left, right);
}

TEST(ChartColors, OfASurfaceWithoutLinesAreRefused) {
  const auto model = buildSurface(SurfaceMesh(shapes::sheet(3, 3)));
  ASSERT_TRUE(model);
  EXPECT_EQ(chartColors(*model).error().code, ErrorCode::usage);
  EXPECT_EQ(stretchColors(*model).error().code, ErrorCode::usage);
}

TEST(StretchColors, AreOfTheAreaOnTheSurfaceForTheAreaInThePicture) {
  const SurfaceModel model = twoCharts();
  const auto made = stretchColors(model);
  ASSERT_TRUE(made) << made.error().describe();
  // Areas: 36 squares of 1e-4 and 36 of 16e-4: the mean is 8.5e-4; the left is 8.5 times as stretched.
  const ColorMap& map = colorTable("difference");
  const Rgba sparse = map.at(1), dense = map.at(std::log2(8.5 / 16) / 3);
  const std::vector<Vec3> places = drawnPlaces(model);
  ASSERT_EQ(4 * places.size(), made->colors.size());
  for (std::uint32_t t = 0; t < model.mt.triangleIdCount(); ++t) {
    if (model.mt.remover(TriangleId(t)).isValid()) continue;
    double x = 0;
    for (const std::uint32_t v : model.mt.corners(TriangleId(t))) x += model.mt.position(VertexId(v)).x / 3;
    const Rgba& expected = x > 6 ? dense : sparse;
    for (const std::uint32_t w : model.wedgesOf[t])
      EXPECT_EQ(inkOf(*made, w), (std::array{expected.r, expected.g, expected.b}));
  }
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

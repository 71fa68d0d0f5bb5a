// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/simplify/vertex_classes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

#include "terrain/grid_triangles.h"

namespace arete {
namespace {

using testing::gridHeights;
using testing::gridTriangles;

struct ClassGrid {
  std::uint32_t columns, rows;
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  ClassGrid(std::uint32_t columnCount, std::uint32_t rowCount,
            const std::function<double(double, double)>& height)
      : columns(columnCount), rows(rowCount) {
    const auto heights = gridHeights(columns, rows, height);
    triangles = gridTriangles(columns, rows, heights);
    for (std::uint32_t v = 0; v < heights.size(); ++v) {
      positions.push_back({double(v % columns), -double(v / columns), heights[v]});
    }
  }

  std::vector<VertexClass> classify(double angle) const {
    return classifyVertices(positions, triangles, angle);
  }
  std::uint32_t at(std::uint32_t column, std::uint32_t row) const { return row * columns + column; }
};

struct VertexClassCounts {
  std::size_t isolated = 0, simple = 0, boundary = 0, interiorEdge = 0, corner = 0;
  bool operator==(const VertexClassCounts&) const = default;
};

VertexClassCounts countClasses(const std::vector<VertexClass>& classes) {
  const auto count = [&](VertexClass c) { return std::size_t(std::ranges::count(classes, c)); };
  return {count(VertexClass::isolated), count(VertexClass::simple), count(VertexClass::boundary),
          count(VertexClass::interiorEdge), count(VertexClass::corner)};
}

TEST(VertexClasses, FlatGroundIsSimpleInsideABoundary) {
  const ClassGrid grid(6, 5, [](double, double) { return 3.0; });
  EXPECT_EQ(countClasses(grid.classify(1)), (VertexClassCounts{.simple = 12, .boundary = 18}));
}

TEST(VertexClasses, ARoofHasItsRidgeAsInteriorEdge) {
  // Both planes rise at 45 degrees towards column 3, so their normals differ by 90.
  const ClassGrid grid(7, 6, [](double c, double) { return 3 - std::abs(c - 3); });
  const auto classes = grid.classify(89);
  for (std::uint32_t r = 1; r < 5; ++r) EXPECT_EQ(classes[grid.at(3, r)], VertexClass::interiorEdge);
  EXPECT_EQ(classes[grid.at(3, 0)], VertexClass::boundary) << "a crease on the border is the border's";
  EXPECT_EQ(countClasses(classes), (VertexClassCounts{.simple = 16, .boundary = 22, .interiorEdge = 4}));
  EXPECT_EQ(countClasses(grid.classify(91)).interiorEdge, 0u);
}

TEST(VertexClasses, AHippedRoofHasACornerWhereItsRidgesMeet) {
  // A pyramid whose four faces meet in ridges along the diagonals; the grid's own diagonal carries one pair
  // of ridges, and the other pair runs across its cells, so build it by hand: an apex over a square.
  const std::vector<Vec3> positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}};
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  // The faces' normals (0,-1,1) and (1,0,1) make 60 degrees.
  EXPECT_EQ(classifyVertices(positions, triangles, 59.999)[4], VertexClass::corner);
  EXPECT_EQ(classifyVertices(positions, triangles, 60.001)[4], VertexClass::simple);
}

TEST(VertexClasses, ABoxIsCornersAndEdges) {
  // A closed cube of side 2, each face split in 2 x 2 squares: 8 corners, 12 edge middles, 6 face middles.
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::int64_t> known(27, -1);
  const auto vertex = [&](int x, int y, int z) {
    std::int64_t& id = known[std::size_t(x + 3 * y + 9 * z)];
    if (id < 0) {
      id = std::int64_t(positions.size());
      positions.push_back({double(x), double(y), double(z)});
    }
    return std::uint32_t(id);
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      for (int u = 0; u < 2; ++u) {
        for (int v = 0; v < 2; ++v) {
          const auto corner = [&](int du, int dv) {
            int p[3];
            p[axis] = 2 * side;
            p[(axis + 1) % 3] = u + du;
            p[(axis + 2) % 3] = v + dv;
            return vertex(p[0], p[1], p[2]);
          };
          const std::uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          triangles.push_back(side == 1 ? std::array{a, b, c} : std::array{a, c, b});
          triangles.push_back(side == 1 ? std::array{a, c, d} : std::array{a, d, c});
        }
      }
    }
  }
  const auto classes = classifyVertices(positions, triangles, 45);
  EXPECT_EQ(countClasses(classes), (VertexClassCounts{.simple = 6, .interiorEdge = 12, .corner = 8}));
  const auto byAccessor = classifyVertices(
      positions.size(), [&](std::uint32_t v) { return positions[v]; }, triangles, 45);
  EXPECT_EQ(byAccessor, classes);
}

TEST(VertexClasses, AnEndingCreaseIsACorner) {
  // Around the middle the height runs as |sin(angle / 2)|: a valley comes in along +x and fades on the other
  // side.
  std::vector<Vec3> positions = {{0, 0, 0}};
  std::vector<std::array<std::uint32_t, 3>> triangles;
  constexpr std::uint32_t kRing = 16;
  for (std::uint32_t i = 0; i < kRing; ++i) {
    const double angle = 2 * std::numbers::pi * i / kRing;
    positions.push_back({std::cos(angle), std::sin(angle), 2 * std::sin(angle / 2)});
    triangles.push_back({0, 1 + i, 1 + (i + 1) % kRing});
  }
  EXPECT_EQ(classifyVertices(positions, triangles, 45)[0], VertexClass::corner);
  EXPECT_EQ(classifyVertices(positions, triangles, 120)[0], VertexClass::simple);
}

TEST(VertexClasses, ARimOfNodataIsBoundaryAndALoneSampleIsolated) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  // Column 5 is cut off by the void in column 4: its samples are in no triangle.
  const ClassGrid grid(6, 4, [&](double c, double) { return c == 4 ? none : 0.0; });
  const auto classes = grid.classify(10);
  EXPECT_EQ(classes[grid.at(5, 2)], VertexClass::isolated);
  EXPECT_EQ(classes[grid.at(3, 2)], VertexClass::boundary);
  EXPECT_EQ(classes[grid.at(2, 2)], VertexClass::simple);
  EXPECT_EQ(countClasses(classes), (VertexClassCounts{.isolated = 8, .simple = 4, .boundary = 12}));
}

TEST(VertexClasses, AnEdgeOfThreeTrianglesIsACorner) {
  const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  const auto classes = classifyVertices(positions, triangles, 30);
  EXPECT_EQ(classes[0], VertexClass::corner);
  EXPECT_EQ(classes[4], VertexClass::boundary);
}

TEST(VertexClasses, AFlatTriangleWithoutAreaMakesNoCrease) {
  const std::vector<Vec3> positions = {{0, 0, 0}, {2, 0, 0}, {1, 0, 0}, {1, 1, 5}, {1, -1, 5}};
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 3}, {0, 2, 1}, {0, 4, 2}, {2, 4, 1}};
  EXPECT_EQ(countClasses(classifyVertices(positions, triangles, 10)),
            (VertexClassCounts{.simple = 1, .boundary = 4}));
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Polygons of rasters, held against the raster by counting crossings of a ray at every cell, and against
// GEOS, which says whether they are valid. The oracle for what is connected is a flood fill.
#include "io/geo/polygons/cell_polygons.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <ogr_geometry.h>

#include <atomic>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <vector>

namespace arete {
namespace {

struct Grid {
  std::uint32_t columns = 0, rows = 0;
  std::vector<double> values;
  CellValues view() const { return {columns, rows, values, columns}; }
};

Grid gridOf(const std::vector<std::string>& lines) {
  Grid grid{std::uint32_t(lines.front().size()), std::uint32_t(lines.size()), {}};
  for (const std::string& line : lines)
    for (const char c : line) grid.values.push_back(c == '.' ? std::nan("") : double(c - '0'));
  return grid;
}

std::vector<CellPolygon> polygonsOf(const Grid& grid) {
  std::vector<CellPolygon> polygons;
  const Status status = forCellPolygons(
      grid.view(), [](const CellRun& run) { return double(run.end - run.begin); },
      [&](CellPolygon polygon) {
        polygons.push_back(std::move(polygon));
        return Status();
      },
      "polygons", {});
  EXPECT_TRUE(status) << status.error().describe();
  return polygons;
}

OGRPolygon geometryOf(const CellPolygon& polygon) {
  OGRPolygon geometry;
  for (const auto& corners : polygon.rings) {
    OGRLinearRing ring;
    for (const CellCorner& corner : corners) ring.addPoint(corner.column, -double(corner.row));
    ring.closeRings();
    geometry.addRing(&ring);
  }
  return geometry;
}

/// Whether a cell is within, by the edges that a ray to the right of it crosses.
bool isWithin(const CellPolygon& polygon, std::uint32_t column, std::uint32_t row) {
  int crossings = 0;
  for (const auto& ring : polygon.rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const CellCorner &a = ring[i], &b = ring[(i + 1) % ring.size()];
      if (a.column != b.column || a.column <= column) continue;
      crossings += std::min(a.row, b.row) <= row && row < std::max(a.row, b.row);
    }
  return crossings % 2 == 1;
}

/// Cells of one value that are connected through edges, numbered; -1 where there is no value.
std::vector<int> floodFilled(const Grid& grid) {
  std::vector<int> part(grid.values.size(), -1);
  int parts = 0;
  for (std::size_t first = 0; first < part.size(); ++first) {
    if (part[first] >= 0 || std::isnan(grid.values[first])) continue;
    std::vector<std::size_t> open = {first};
    part[first] = parts;
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      const std::size_t c = at % grid.columns, r = at / grid.columns;
      const auto visit = [&](std::size_t to) {
        if (part[to] >= 0 || grid.values[to] != grid.values[at]) return;
        part[to] = parts;
        open.push_back(to);
      };
      if (c > 0) visit(at - 1);
      if (c + 1 < grid.columns) visit(at + 1);
      if (r > 0) visit(at - grid.columns);
      if (r + 1 < grid.rows) visit(at + grid.columns);
    }
    ++parts;
  }
  return part;
}

void expectThatTheyAreTheRaster(const Grid& grid, const std::string& name) {
  const std::vector<CellPolygon> polygons = polygonsOf(grid);
  const std::vector<int> parts = floodFilled(grid);
  std::vector<int> covered(grid.values.size(), -1);
  std::map<int, int> partOf;
  for (int p = 0; p < int(polygons.size()); ++p) {
    const CellPolygon& polygon = polygons[std::size_t(p)];
    const OGRPolygon geometry = geometryOf(polygon);
    EXPECT_TRUE(geometry.IsValid()) << name << ", polygon " << p;
    EXPECT_EQ(geometry.get_Area(), double(polygon.cells)) << name << ", polygon " << p;
    EXPECT_EQ(polygon.area, double(polygon.cells)) << name;
    EXPECT_FALSE(geometry.getExteriorRing()->isClockwise()) << name;
    for (int hole = 0; hole < geometry.getNumInteriorRings(); ++hole)
      EXPECT_TRUE(geometry.getInteriorRing(hole)->isClockwise()) << name;
    for (std::uint32_t row = 0; row < grid.rows; ++row)
      for (std::uint32_t column = 0; column < grid.columns; ++column) {
        if (!isWithin(polygon, column, row)) continue;
        const std::size_t at = std::size_t(row) * grid.columns + column;
        ASSERT_EQ(covered[at], -1) << name << ": a cell in two polygons";
        covered[at] = p;
        ASSERT_EQ(grid.values[at], polygon.value) << name;
        const auto known = partOf.try_emplace(p, parts[at]).first;
        ASSERT_EQ(known->second, parts[at]) << name << ": a polygon of cells that are not connected";
      }
  }
  std::set<int> seen;
  for (const auto& [polygon, part] : partOf)
    EXPECT_TRUE(seen.insert(part).second) << name << ": two polygons";
  for (std::size_t at = 0; at < covered.size(); ++at)
    ASSERT_EQ(covered[at] >= 0, !std::isnan(grid.values[at])) << name << ", cell " << at;
}

TEST(CellPolygons, AreTheRasterAgain) {
  expectThatTheyAreTheRaster(gridOf({"1"}), "one cell");
  expectThatTheyAreTheRaster(gridOf({"..", ".."}), "nothing");
  expectThatTheyAreTheRaster(gridOf({"111", "101", "111"}), "a hole");
  expectThatTheyAreTheRaster(gridOf({"11111", "10001", "10201", "10001", "11111"}), "a hole in a hole");
  expectThatTheyAreTheRaster(gridOf({"10", "01"}), "a checkerboard");
  expectThatTheyAreTheRaster(gridOf({"1111", "1010", "1101", "1111"}), "holes that meet in a corner");
  expectThatTheyAreTheRaster(gridOf({"110", "101", "111"}), "a hole that meets the outside in a corner");
  expectThatTheyAreTheRaster(gridOf({"0111", "1011", "1101", "1110"}), "a chain of corners");
  expectThatTheyAreTheRaster(gridOf({".1.1.", "1.1.1", ".1.1.", "1.1.1"}), "corners without values between");
}

TEST(CellPolygons, OfRandomRastersAreTheRasterAgain) {
  for (unsigned seed = 0; seed < 400; ++seed) {
    std::mt19937 random(seed);
    Grid grid{1 + std::uint32_t(random() % 12), 1 + std::uint32_t(random() % 12), {}};
    const unsigned kinds = 2 + random() % 3;
    for (std::uint32_t i = 0; i < grid.columns * grid.rows; ++i) {
      const unsigned kind = random() % kinds;
      grid.values.push_back(kind == 2 ? std::nan("") : double(kind));
    }
    expectThatTheyAreTheRaster(grid, fmt::format("{} x {}, seed {}", grid.columns, grid.rows, seed));
    if (HasFailure()) return;
  }
}

TEST(CellPolygons, AreHandedOverBeforeTheLastRowIsReached) {
  const Grid grid = gridOf({"11", "11", "00", "22"});
  std::vector<double> values;
  ASSERT_TRUE(forCellPolygons(
                  grid.view(), [](const CellRun&) { return 0.0; },
                  [&](const CellPolygon& polygon) -> Status {
                    values.push_back(polygon.value);
                    if (values.size() == 2) return failure(ErrorCode::unreadable, "full");
                    return {};
                  },
                  "polygons", {})
                  .error()
                  .code == ErrorCode::unreadable);
  EXPECT_EQ(values, (std::vector<double>{1, 0}));
}

TEST(CellPolygons, LeaveOutTheColumnsBeyondTheirs) {
  const std::vector<double> values = {1, 1, 9, 1, 1, 9};
  Grid grid;
  int polygons = 0;
  const CellValues view{2, 2, values, 3};
  ASSERT_TRUE(forCellPolygons(
      view, [](const CellRun&) { return 0.0; },
      [&](const CellPolygon& polygon) {
        EXPECT_EQ(polygon.cells, 4u);
        ++polygons;
        return Status();
      },
      "polygons", {}));
  EXPECT_EQ(polygons, 1);
}

TEST(CellPolygons, CanBeStopped) {
  const std::atomic<bool> cancel = true;
  RunContext context;
  context.cancel = &cancel;
  const Grid grid = gridOf({"10"});
  const Status status = forCellPolygons(
      grid.view(), [](const CellRun&) { return 0.0; }, [](const CellPolygon&) { return Status(); },
      "polygons", context);
  EXPECT_EQ(status.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace arete

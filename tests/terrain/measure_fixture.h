// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "terrain/measure/measure.h"

namespace arete::measuring_test {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

inline RasterHeightfield raster(std::uint32_t columns, std::uint32_t rows,
                                const std::function<double(double column, double row)>& height,
                                std::array<double, 6> geoTransform = {0, 1, 0, 0, 0, -1}) {
  RasterHeightfield dem;
  dem.columns = columns;
  dem.rows = rows;
  dem.georeference.geoTransform = geoTransform;
  dem.georeference.hasGeoTransform = true;
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c) dem.heights.push_back(height(c, r));
  return dem;
}

/// A vertex given in grid coordinates, as a mesh file would hold it.
inline Vec3 vertex(const RasterHeightfield& dem, double column, double row, double z) {
  const Vec2 p = dem.georeference.toSource(column, row);
  return {p.x, p.y, z};
}

/// Two triangles over the whole raster, at the heights of its corners.
inline TriangleMesh twoTriangles(const RasterHeightfield& dem) {
  const std::uint32_t c = dem.columns - 1, r = dem.rows - 1;
  TriangleMesh mesh;
  for (const auto& [column, row] : {std::array{0u, 0u}, {c, 0u}, {0u, r}, {c, r}})
    mesh.positions.push_back(vertex(dem, column, row, dem.at(column, row)));
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}};
  return mesh;
}

/// The finest triangulation, by the rule of the conventions: the diagonal joins upper left and lower right;
/// three valid corners give one triangle.
inline TriangleMesh finest(const RasterHeightfield& dem) {
  TriangleMesh mesh;
  for (std::uint32_t r = 0; r < dem.rows; ++r)
    for (std::uint32_t c = 0; c < dem.columns; ++c)
      mesh.positions.push_back(vertex(dem, c, r, dem.isValid(c, r) ? dem.at(c, r) : 0));
  for (std::uint32_t r = 0; r + 1 < dem.rows; ++r) {
    for (std::uint32_t c = 0; c + 1 < dem.columns; ++c) {
      const std::array<std::uint32_t, 4> corner = {dem.index(c, r), dem.index(c + 1, r), dem.index(c, r + 1),
                                                   dem.index(c + 1, r + 1)};
      std::vector<std::uint32_t> there;
      for (const std::uint32_t v : corner)
        if (!std::isnan(dem.heights[v])) there.push_back(v);
      if (there.size() == 3) mesh.triangles.push_back({there[0], there[1], there[2]});
      if (there.size() < 4) continue;
      mesh.triangles.push_back({corner[0], corner[2], corner[3]});
      mesh.triangles.push_back({corner[0], corner[3], corner[1]});
    }
  }
  return mesh;
}

inline double slope(double column, double row) {
  return 100 + 2 * column - 3 * row;
}

inline MeasureReport measured(const TriangleMesh& mesh, const RasterHeightfield& dem,
                              const MeasureOptions& options = {}) {
  const Result<MeasureReport> report = measure(mesh, dem, options);
  EXPECT_TRUE(report) << report.error().describe();
  return report.value_or(MeasureReport{});
}

}  // namespace arete::measuring_test

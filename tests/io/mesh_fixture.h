// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes that the tests of mesh formats write and read again.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "datasets/families.h"
#include "engine/base/triangle_mesh.h"
#include "io/formats/exchange/mesh_formats.h"
#include "io/io_fixture.h"

namespace arete::test {

/// Every valid cell of a raster as two triangles, in source coordinates, counter-clockwise on the map: made
/// without the builder. Every vertex is in a triangle.
inline TriangleMesh gridMesh(const RasterHeightfield& field) {
  TriangleMesh mesh;
  std::vector<std::uint32_t> number(field.size(), 0xFFFFFFFF);
  const auto vertex = [&](std::uint32_t column, std::uint32_t row) {
    std::uint32_t& v = number[field.index(column, row)];
    if (v == 0xFFFFFFFF) {
      v = static_cast<std::uint32_t>(mesh.positions.size());
      const Vec2 xy = field.georeference.toSource(column, row);
      mesh.positions.push_back({xy.x, xy.y, field.at(column, row)});
    }
    return v;
  };
  const bool flipped = field.georeference.determinant() < 0;
  for (std::uint32_t r = 0; r + 1 < field.rows; ++r)
    for (std::uint32_t c = 0; c + 1 < field.columns; ++c) {
      if (!field.isValid(c, r) || !field.isValid(c + 1, r) || !field.isValid(c, r + 1) ||
          !field.isValid(c + 1, r + 1))
        continue;
      const std::uint32_t a = vertex(c, r), b = vertex(c + 1, r), d = vertex(c, r + 1),
                          e = vertex(c + 1, r + 1);
      mesh.triangles.push_back(flipped ? std::array{a, e, b} : std::array{a, b, e});
      mesh.triangles.push_back(flipped ? std::array{a, d, e} : std::array{a, e, d});
    }
  return mesh;
}

/// The corners of every triangle lie within `rounding` of where they were, triangle by triangle: vertices may
/// be numbered anew.
inline void expectSameTriangles(const TriangleMesh& a, const TriangleMesh& b, const Vec3& rounding) {
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  for (std::size_t t = 0; t < a.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const Vec3& p = a.positions[a.triangles[t][k]];
      const Vec3& q = b.positions[b.triangles[t][k]];
      ASSERT_LE(std::abs(p.x - q.x), rounding.x) << "triangle " << t << " corner " << k;
      ASSERT_LE(std::abs(p.y - q.y), rounding.y) << "triangle " << t << " corner " << k;
      ASSERT_LE(std::abs(p.z - q.z), rounding.z) << "triangle " << t << " corner " << k;
    }
}

inline std::string bytesOf(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// What reading says is wrong; the file that it blames must be this one.
inline Error refusal(const std::string& path) {
  const Result<MeshFile> file = readMesh(path);
  if (file) {
    ADD_FAILURE() << path << " was read";
    return {};
  }
  EXPECT_EQ(file.error().culprit, path);
  EXPECT_FALSE(file.error().message.empty());
  return file.error();
}

}  // namespace arete::test

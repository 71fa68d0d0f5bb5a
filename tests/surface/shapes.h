// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "engine/base/triangle_mesh.h"

// Small meshes whose topology is known.
namespace arete::shapes {

using Triangle = std::array<std::uint32_t, 3>;

/// A grid of columns x rows squares whose opposite sides are joined as asked: a sheet, a tube, a torus, or
/// with a half twist a Moebius strip.
inline TriangleMesh sheet(std::uint32_t columns, std::uint32_t rows, bool joinsColumns = false,
                          bool joinsRows = false, bool isTwisted = false) {
  TriangleMesh mesh;
  const std::uint32_t across = columns + (joinsColumns ? 0 : 1), down = rows + (joinsRows ? 0 : 1);
  for (std::uint32_t r = 0; r < down; ++r)
    for (std::uint32_t c = 0; c < across; ++c) {
      const double u = 2 * std::numbers::pi * c / columns, v = 2 * std::numbers::pi * r / rows;
      if (isTwisted) {
        const double w = double(r) / rows - 0.5;
        mesh.positions.push_back({(3 + w * std::cos(u / 2)) * std::cos(u),
                                  (3 + w * std::cos(u / 2)) * std::sin(u), w * std::sin(u / 2)});
      } else if (joinsColumns && joinsRows) {
        mesh.positions.push_back(
            {(3 + std::cos(v)) * std::cos(u), (3 + std::cos(v)) * std::sin(u), std::sin(v)});
      } else if (joinsColumns) {
        mesh.positions.push_back({std::cos(u), std::sin(u), double(r)});
      } else {
        mesh.positions.push_back({double(c), double(r), 0});
      }
    }
  const auto at = [&](std::uint32_t c, std::uint32_t r) {
    if (isTwisted && c == columns) return (rows - r) * across;
    return r % down * across + c % across;
  };
  for (std::uint32_t r = 0; r < rows; ++r)
    for (std::uint32_t c = 0; c < columns; ++c) {
      mesh.triangles.push_back({at(c, r), at(c + 1, r), at(c + 1, r + 1)});
      mesh.triangles.push_back({at(c, r), at(c + 1, r + 1), at(c, r + 1)});
    }
  return mesh;
}

inline TriangleMesh tetrahedron(const Vec3& at = {}) {
  TriangleMesh mesh;
  mesh.positions = {at, at + Vec3{1, 0, 0}, at + Vec3{0, 1, 0}, at + Vec3{0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return mesh;
}

inline void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  for (const Triangle& t : other.triangles)
    mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

/// Triangles between few vertices at small whole coordinates, so that everything happens: double and
/// degenerate triangles, edges of many triangles, coplanar and crossing ones.
inline TriangleMesh anything(std::uint64_t seed, std::uint32_t vertices, std::uint32_t triangles,
                             int coordinates) {
  std::mt19937_64 random(seed);
  const auto below = [&](std::uint64_t n) { return random() % n; };
  TriangleMesh mesh;
  for (std::uint32_t v = 0; v < vertices; ++v)
    mesh.positions.push_back({double(below(std::uint64_t(coordinates))),
                              double(below(std::uint64_t(coordinates))),
                              double(below(std::uint64_t(coordinates)))});
  for (std::uint32_t t = 0; t < triangles; ++t)
    mesh.triangles.push_back({static_cast<std::uint32_t>(below(vertices)),
                              static_cast<std::uint32_t>(below(vertices)),
                              static_cast<std::uint32_t>(below(vertices))});
  return mesh;
}

}  // namespace arete::shapes

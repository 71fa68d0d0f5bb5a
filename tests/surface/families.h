// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "engine/base/triangle_mesh.h"
#include "surface/shapes.h"

// Surfaces of every topology that a build takes, from seeds.
namespace arete::shapes {

struct NamedMesh {
  std::string name;
  TriangleMesh mesh;
};

/// Moves every vertex by up to `by` in each direction.
inline TriangleMesh shaken(TriangleMesh mesh, std::uint64_t seed, double by) {
  std::mt19937_64 random(seed);
  const auto step = [&] { return by * (double(random() % 2001) / 1000 - 1); };
  for (Vec3& p : mesh.positions) p = p + Vec3{step(), step(), step()};
  return mesh;
}

/// A sphere of poles and rings: the poles have as many triangles as a ring has vertices.
inline TriangleMesh globe(std::uint32_t around, std::uint32_t rings) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 1}, {0, 0, -1}};
  for (std::uint32_t r = 0; r < rings; ++r)
    for (std::uint32_t c = 0; c < around; ++c) {
      const double u = 2 * std::numbers::pi * c / around, v = std::numbers::pi * (r + 1) / (rings + 1);
      mesh.positions.push_back({std::sin(v) * std::cos(u), std::sin(v) * std::sin(u), std::cos(v)});
    }
  const auto at = [&](std::uint32_t r, std::uint32_t c) { return 2 + r * around + c % around; };
  for (std::uint32_t c = 0; c < around; ++c) {
    mesh.triangles.push_back({0, at(0, c), at(0, c + 1)});
    mesh.triangles.push_back({1, at(rings - 1, c + 1), at(rings - 1, c)});
    for (std::uint32_t r = 0; r + 1 < rings; ++r) {
      mesh.triangles.push_back({at(r, c), at(r + 1, c), at(r + 1, c + 1)});
      mesh.triangles.push_back({at(r, c), at(r + 1, c + 1), at(r, c + 1)});
    }
  }
  return mesh;
}

/// A sheet that rises and falls.
inline TriangleMesh hills(std::uint32_t side, std::uint64_t seed) {
  TriangleMesh mesh = sheet(side, side);
  const double phase = double(seed % 1000) / 100;
  for (Vec3& p : mesh.positions) p.z = 2 * std::sin(p.x / 5 + phase) * std::cos(p.y / 4) + 0.02 * p.x * p.y;
  return mesh;
}

inline std::vector<NamedMesh> families(std::uint64_t seed) {
  std::vector<NamedMesh> all;
  const auto add = [&](const std::string& name, TriangleMesh mesh) {
    all.push_back({name + " of seed " + std::to_string(seed), std::move(mesh)});
  };
  add("flat sheet", sheet(12, 9));
  add("hills", hills(20, seed));
  add("tube", shaken(sheet(16, 14, true), seed, 0.05));
  add("torus", shaken(sheet(24, 15, true, true), seed + 1, 0.04));
  add("globe", shaken(globe(30, 12), seed + 2, 0.01));
  add("rough globe", shaken(globe(14, 10), seed + 3, 0.2));
  TriangleMesh several = globe(12, 7);
  append(several, tetrahedron({4, 0, 0}));
  append(several, shaken(sheet(9, 7), seed + 4, 0.1));
  for (std::size_t v = several.positions.size() - 80; v < several.positions.size(); ++v)
    several.positions[v].z += 5;
  add("several components", several);
  TriangleMesh holed = hills(18, seed + 5);
  std::mt19937_64 random(seed);
  std::erase_if(holed.triangles, [&](const Triangle& t) {
    const Vec3& p = holed.positions[t[0]];
    return std::hypot(p.x - 6, p.y - 6) < 2.5 || std::hypot(p.x - 12, p.y - 11) < 1.8;
  });
  add("hills with holes", holed);
  return all;
}

}  // namespace arete::shapes

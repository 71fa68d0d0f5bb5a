// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "engine/base/triangle_mesh.h"

// What tests of repair() measure for themselves, and the shapes that they damage.
namespace arete::measured {

/// What a closed mesh encloses, about its first vertex.
inline double volume(const TriangleMesh& mesh) {
  const Vec3 o = mesh.positions[mesh.triangles[0][0]];
  double six = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.positions[t[0]] - o, b = mesh.positions[t[1]] - o, c = mesh.positions[t[2]] - o;
    six += a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
  }
  return six / 6;
}

inline double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 u = mesh.positions[t[1]] - mesh.positions[t[0]],
               w = mesh.positions[t[2]] - mesh.positions[t[0]];
    sum += std::hypot(u.y * w.z - u.z * w.y, u.z * w.x - u.x * w.z, u.x * w.y - u.y * w.x) / 2;
  }
  return sum;
}

/// Edges between positions: of one triangle, and of more than two.
struct EdgesByPosition {
  std::size_t open = 0, crowded = 0;
  bool operator==(const EdgesByPosition&) const = default;
};
inline EdgesByPosition edges(const TriangleMesh& mesh) {
  using Place = std::array<double, 3>;
  std::map<std::pair<Place, Place>, int> count;
  for (const auto& t : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 &p = mesh.positions[t[i]], &q = mesh.positions[t[(i + 1) % 3]];
      Place a{p.x, p.y, p.z}, b{q.x, q.y, q.z};
      if (b < a) std::swap(a, b);
      ++count[{a, b}];
    }
  EdgesByPosition found;
  for (const auto& [edge, n] : count) {
    if (n == 1) ++found.open;
    if (n > 2) ++found.crowded;
  }
  return found;
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double unit() { return double(engine_() >> 11) * 0x1p-53; }
  std::size_t below(std::size_t n) { return engine_() % n; }

 private:
  std::mt19937_64 engine_;
};

/// Turned about z and x, made larger and moved.
inline TriangleMesh placed(TriangleMesh mesh, double a, double b, double scale, const Vec3& to) {
  for (Vec3& p : mesh.positions) {
    const Vec3 q{std::cos(a) * p.x - std::sin(a) * p.y, std::sin(a) * p.x + std::cos(a) * p.y, p.z};
    p = Vec3{q.x, std::cos(b) * q.y - std::sin(b) * q.z, std::sin(b) * q.y + std::cos(b) * q.z} * scale + to;
  }
  return mesh;
}

/// A box with n x n squares on each side, one vertex at each position, outwards.
inline TriangleMesh box(int n, const Vec3& half = {1, 1, 1}, const Vec3& middle = {}) {
  TriangleMesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> numbers;
  const auto vertex = [&](std::array<int, 3> at) {
    const auto [found, isNew] = numbers.try_emplace(at, std::uint32_t(mesh.positions.size()));
    const auto along = [&](int i) { return 2.0 * at[std::size_t(i)] / n - 1; };
    if (isNew)
      mesh.positions.push_back(Vec3{along(0) * half.x, along(1) * half.y, along(2) * half.z} + middle);
    return found->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int side : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto at = [&](int u, int w) {
            std::array<int, 3> place{};
            place[axis] = side;
            place[(axis + 1) % 3] = u;
            place[(axis + 2) % 3] = w;
            return vertex(place);
          };
          const std::array<std::uint32_t, 4> c = {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
          if (side == n) {
            mesh.triangles.push_back({c[0], c[1], c[2]});
            mesh.triangles.push_back({c[0], c[2], c[3]});
          } else {
            mesh.triangles.push_back({c[0], c[2], c[1]});
            mesh.triangles.push_back({c[0], c[3], c[2]});
          }
        }
  return mesh;
}

/// Turns every triangle with a probability. Returns how many it turned.
inline std::size_t turnSome(TriangleMesh& mesh, Random& random, double share) {
  std::size_t turned = 0;
  for (auto& t : mesh.triangles)
    if (random.unit() < share) {
      std::swap(t[1], t[2]);
      ++turned;
    }
  return turned;
}

/// Each triangle with vertices of its own.
inline TriangleMesh soup(const TriangleMesh& mesh) {
  TriangleMesh apart;
  for (const auto& t : mesh.triangles) {
    const auto first = std::uint32_t(apart.positions.size());
    for (const std::uint32_t v : t) apart.positions.push_back(mesh.positions[v]);
    apart.triangles.push_back({first, first + 1, first + 2});
  }
  return apart;
}

inline TriangleMesh asFloats(TriangleMesh mesh) {
  for (Vec3& p : mesh.positions) p = {double(float(p.x)), double(float(p.y)), double(float(p.z))};
  return mesh;
}

}  // namespace arete::measured

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Solids of flat faces and straight edges lose nothing as long as a budget has room for their corners.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "engine/criteria/criterion.h"
#include "engine/criteria/refine_order.h"
#include "engine/cut/cut.h"
#include "surface/builder/build.h"
#include "surface/shapes.h"

namespace arete {
namespace {

struct Solid {
  std::string name;
  TriangleMesh mesh;
  std::uint32_t least = 0;  ///< triangles: 2 V - 4 of V corners, without holes
};

/// The surface of some unit cubes, each side in n x n squares.
/// @param diagonals of the squares: 0 and 1 one way and the other, 2 by turns
TriangleMesh blocks(const std::array<int, 3>& size, const std::function<bool(int, int, int)>& isFilled, int n,
                    int diagonals) {
  TriangleMesh mesh;
  std::map<std::array<int, 3>, std::uint32_t> known;
  const auto vertex = [&](const std::array<int, 3>& p) {
    const auto [at, isNew] = known.try_emplace(p, static_cast<std::uint32_t>(mesh.positions.size()));
    if (isNew) mesh.positions.push_back({double(p[0]) / n, double(p[1]) / n, double(p[2]) / n});
    return at->second;
  };
  const auto isThere = [&](const std::array<int, 3>& c) {
    for (std::size_t i = 0; i < 3; ++i)
      if (c[i] < 0 || c[i] >= size[i]) return false;
    return isFilled(c[0], c[1], c[2]);
  };
  for (int i = 0; i < size[0] * size[1] * size[2]; ++i) {
    const std::array<int, 3> cube{i % size[0], i / size[0] % size[1], i / size[0] / size[1]};
    if (!isThere(cube)) continue;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        std::array<int, 3> beyond = cube;
        beyond[axis] += 2 * side - 1;
        if (isThere(beyond)) continue;
        for (int u = 0; u < n; ++u)
          for (int v = 0; v < n; ++v) {
            const auto at = [&](int a, int b) {
              std::array<int, 3> p{};
              p[axis] = (cube[axis] + side) * n;
              p[(axis + 1) % 3] = cube[(axis + 1) % 3] * n + a;
              p[(axis + 2) % 3] = cube[(axis + 2) % 3] * n + b;
              return vertex(p);
            };
            std::array<std::uint32_t, 4> q{at(u, v), at(u + 1, v), at(u + 1, v + 1), at(u, v + 1)};
            if (side == 0) std::swap(q[1], q[3]);
            if (diagonals == 1 || (diagonals == 2 && (u + v) % 2 == 1))
              std::rotate(q.begin(), q.begin() + 1, q.end());
            mesh.triangles.push_back({q[0], q[1], q[2]});
            mesh.triangles.push_back({q[0], q[2], q[3]});
          }
      }
  }
  return mesh;
}

/// Turned and, if asked, rounded to floats, which leaves no face quite flat.
TriangleMesh turned(TriangleMesh mesh, std::uint64_t seed, bool isRounded) {
  std::mt19937_64 random(seed);
  const double a = double(random() % 628) / 100, b = double(random() % 628) / 100;
  for (Vec3& p : mesh.positions) {
    const Vec3 q{p.x * std::cos(a) - p.y * std::sin(a), p.x * std::sin(a) + p.y * std::cos(a), p.z};
    p = {q.x, q.y * std::cos(b) - q.z * std::sin(b), q.y * std::sin(b) + q.z * std::cos(b)};
    if (isRounded) p = {double(float(p.x)), double(float(p.y)), double(float(p.z))};
  }
  return mesh;
}

std::vector<Solid> solids(int n, int diagonals) {
  const auto all = [](int, int, int) { return true; };
  return {{"cube", blocks({1, 1, 1}, all, n, diagonals), 12},
          {"box", blocks({1, 2, 3}, all, (n + 1) / 2, diagonals), 12},
          {"L",
           blocks(
               {2, 2, 1}, [](int x, int y, int) { return x + y < 2; }, n, diagonals),
           20},
          {"U",
           blocks(
               {3, 2, 1}, [](int x, int y, int) { return x != 1 || y != 1; }, n, diagonals),
           28},
          {"cube without a corner",
           blocks(
               {2, 2, 2}, [](int x, int y, int z) { return x + y + z < 3; }, n, diagonals),
           24}};
}

double volumeOf(const MultiTriangulation& mt, const Cut& cut) {
  double six = 0;
  for (const auto& t : cut.triangles) {
    const auto at = [&](std::size_t i) { return mt.position(VertexId(cut.vertices[t[i]])); };
    six += dot(at(0), cross(at(1), at(2)));
  }
  return six / 6;
}

/// Expects that budgets from little more than the least on leave the shape as it is.
void expectExact(const Solid& solid) {
  const Result<SurfaceModel> model = buildSurface(SurfaceMesh(solid.mesh));
  ASSERT_TRUE(model) << model.error().describe();
  const double whole = volumeOf(model->mt, frontOfPrefix(model->mt, model->mt.nodeCount()));
  // As commands spend a budget, and as a library may.
  for (const std::shared_ptr<const RefineOrder>& order :
       {std::shared_ptr<const RefineOrder>(std::make_shared<LargestSquaresFirst>()),
        std::shared_ptr<const RefineOrder>()})
    for (const std::uint32_t more : {4u, 6u, 20u}) {
      const Result<Cut> cut =
          takeCut(model->mt, UniformError(0), {.maxTriangles = solid.least + more, .order = order});
      ASSERT_TRUE(cut);
      EXPECT_LE(cut->triangles.size(), solid.least + more);
      EXPECT_LT(cut->achievedError, 1e-6 * model->diagonal) << solid.least + more;
      EXPECT_NEAR(volumeOf(model->mt, *cut), whole, 1e-6 * whole) << solid.least + more;
    }
}

TEST(FlatParts, OfSolidsKeepTheirCornersWithinABudget) {
  for (const int n : {1, 2, 4})
    for (const int diagonals : {0, 1, 2})
      for (Solid& solid : solids(n, diagonals)) {
        SCOPED_TRACE(solid.name + " of " + std::to_string(n) + ", diagonals " + std::to_string(diagonals));
        expectExact(solid);
      }
}

TEST(FlatParts, OfACubeOfTenSquaresASideKeepItsCorners) {
  for (const int diagonals : {0, 1, 2}) expectExact({"", solids(10, diagonals)[0].mesh, 12});
}

TEST(FlatParts, OfTurnedSolidsKeepTheirCornersAlsoRoundedToFloats) {
  for (const std::uint64_t seed : {1u, 2u})
    for (const bool isRounded : {false, true})
      for (Solid& solid : solids(2 + static_cast<int>(seed), static_cast<int>(seed) % 3)) {
        SCOPED_TRACE(solid.name + " of seed " + std::to_string(seed) + (isRounded ? ", rounded" : ""));
        solid.mesh = turned(std::move(solid.mesh), seed, isRounded);
        expectExact(solid);
      }
}

/// A tube of so many flat sides and rings, its ends closed by fans around a vertex.
TriangleMesh prism(std::uint32_t sides, std::uint32_t rings) {
  TriangleMesh mesh = shapes::sheet(sides, rings, true);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.push_back({0, 0, 0});
  mesh.positions.push_back({0, 0, double(rings)});
  for (std::uint32_t i = 0; i < sides; ++i) {
    const std::uint32_t next = (i + 1) % sides;
    mesh.triangles.push_back({first, next, i});
    mesh.triangles.push_back({first + 1, rings * sides + i, rings * sides + next});
  }
  return mesh;
}

TEST(FlatParts, OfPrismsKeepTheirCornersWithinABudget) {
  for (const std::uint32_t sides : {3u, 4u, 5u, 6u, 17u, 30u})
    for (const std::uint32_t rings : {1u, 2u, 6u}) {
      SCOPED_TRACE(std::to_string(sides) + " sides, " + std::to_string(rings) + " rings");
      expectExact({"", prism(sides, rings), 4 * sides - 4});
      expectExact({"", turned(prism(sides, rings), sides, true), 4 * sides - 4});
    }
}

}  // namespace
}  // namespace arete

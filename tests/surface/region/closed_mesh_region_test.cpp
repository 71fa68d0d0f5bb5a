// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle is the shape itself: a box and a ball known by their formulas.
#include "surface/region/closed_mesh_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "surface/families.h"

namespace arete {
namespace {

TriangleMesh cube(const Vec3& low, const Vec3& high) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  for (const auto& quad : {std::array<std::uint32_t, 4>{0, 2, 3, 1},
                           {4, 5, 7, 6},
                           {0, 1, 5, 4},
                           {2, 6, 7, 3},
                           {0, 4, 6, 2},
                           {1, 3, 7, 5}}) {
    mesh.triangles.push_back({quad[0], quad[1], quad[2]});
    mesh.triangles.push_back({quad[0], quad[2], quad[3]});
  }
  return mesh;
}

TEST(ClosedMeshRegion, OfACubeAnswersAsTheBoxDoes) {
  const Vec3 low{-0.4, -0.3, -0.5}, high{0.3, 0.5, 0.2};
  const auto region = ClosedMeshRegion::create(cube(low, high));
  ASSERT_TRUE(region) << region.error().describe();
  const BoxRegion box(low, high);
  const std::uint64_t seed = 7;
  std::mt19937_64 random(seed);
  const auto number = [&] { return double(random() % 2001) / 1000 - 1; };
  const auto point = [&] { return Vec3{number(), number(), number()}; };
  for (int i = 0; i < 3000; ++i) {
    const Vec3 a = point(), b = a + 0.5 * point(), c = a + 0.5 * point();
    EXPECT_EQ((*region)->meetsTriangle({a, b, c}, 0), box.meetsTriangle({a, b, c}, 0)) << i;
    const double widening = std::abs(number()) / 4;
    EXPECT_EQ((*region)->meetsTriangle({a, b, c}, widening), box.meetsTriangle({a, b, c}, widening)) << i;
    const double r = std::abs(number()) / 2 + 1e-6;
    EXPECT_EQ((*region)->meetsBall(a, r), box.meetsBall(a, r)) << i;
    EXPECT_EQ((*region)->holdsBall(a, r), box.holdsBall(a, r)) << i;
  }
}

TEST(ClosedMeshRegion, AShellWithinAShellIsAHoleWhateverTheirTurns) {
  for (const bool isTurned : {false, true}) {
    TriangleMesh mesh = cube({-3, -3, -3}, {3, 3, 3}), inner = cube({-1, -1, -1}, {1, 1, 1});
    if (isTurned)
      for (auto& t : inner.triangles) std::swap(t[0], t[1]);
    shapes::append(mesh, inner);
    const auto region = ClosedMeshRegion::create(mesh);
    ASSERT_TRUE(region) << region.error().describe();
    EXPECT_FALSE((*region)->meetsBall({0, 0, 0}, 0.5));
    EXPECT_TRUE((*region)->meetsBall({0, 0, 0}, 1.1));
    EXPECT_TRUE((*region)->holdsBall({2, 0, 0}, 0.9));
    EXPECT_FALSE((*region)->meetsTriangle({Vec3{0, 0, 0}, Vec3{0.5, 0, 0}, Vec3{0, 0.5, 0}}, 0));
    EXPECT_TRUE((*region)->meetsTriangle({Vec3{2, 0, 0}, Vec3{2.1, 0, 0}, Vec3{2, 0.1, 0}}, 0));
    EXPECT_TRUE((*region)->meetsTriangle({Vec3{2, 0, 0}, Vec3{2, 0, 0}, Vec3{2, 0, 0}}, 0));
  }
}

TEST(ClosedMeshRegion, RefusesWhatIsNotClosed) {
  TriangleMesh open = cube({0, 0, 0}, {1, 1, 1});
  open.triangles.pop_back();
  const auto region = ClosedMeshRegion::create(open);
  ASSERT_FALSE(region);
  EXPECT_NE(region.error().message.find("not closed"), std::string::npos) << region.error().message;
  EXPECT_FALSE(ClosedMeshRegion::create(TriangleMesh{}));
  TriangleMesh winged = cube({0, 0, 0}, {1, 1, 1});
  winged.positions.push_back({2, 2, 2});
  winged.triangles.push_back({winged.triangles[0][0], winged.triangles[0][1], 8});
  EXPECT_FALSE(ClosedMeshRegion::create(winged));
}

TEST(ClosedMeshRegion, TakesASoupWhoseCornersAreEqualNotShared) {
  const TriangleMesh whole = cube({0, 0, 0}, {1, 1, 1});
  TriangleMesh soup;
  for (const auto& t : whole.triangles) {
    const auto first = static_cast<std::uint32_t>(soup.positions.size());
    for (const std::uint32_t v : t) soup.positions.push_back(whole.positions[v]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_TRUE(ClosedMeshRegion::create(soup));
}

}  // namespace
}  // namespace arete

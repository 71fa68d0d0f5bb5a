// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "surface/families.h"
#include "surface/repair/measured.h"
#include "surface/repair/repair.h"
#include "surface/shapes.h"

namespace arete {
namespace {

using measured::Random;

/// A solid, outwards.
TriangleMesh solid(std::size_t kind, std::uint64_t seed) {
  TriangleMesh mesh;
  switch (kind % 5) {
    case 0:
      mesh = measured::box(1 + int(seed % 4));
      break;
    case 1:
      mesh = shapes::globe(8 + seed % 9, 5);
      break;
    case 2:
      mesh = shapes::sheet(12, 9, true, true);
      break;
    case 3:
      mesh = shapes::tetrahedron();
      break;
    default:
      mesh = measured::box(2, {5, 1, 0.01});
  }
  if (measured::volume(mesh) < 0)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

TEST(Orientation, OfAClosedPartIsOutwardsWhateverIsTurned) {
  constexpr std::array kShares = {0.0, 0.25, 0.5, 0.75, 0.95, 1.0};
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const Vec3 to = seed % 2 == 0 ? Vec3{} : Vec3{4e5, 5.2e6, 300};
    TriangleMesh mesh =
        measured::placed(solid(seed, seed), random.unit() * 6, random.unit() * 6, 1 + 10 * random.unit(), to);
    const double whole = measured::volume(mesh);
    const std::size_t turned = measured::turnSome(mesh, random, kShares[seed % kShares.size()]);
    const auto repaired = repair(mesh);
    ASSERT_TRUE(repaired);
    EXPECT_NEAR(measured::volume(repaired->mesh), whole, 1e-6 * whole);
    EXPECT_EQ(repaired->counts.turnedTriangles, turned);
    EXPECT_EQ(repaired->counts.turnedSolids, turned == mesh.triangles.size() ? 1u : 0u);
    EXPECT_EQ(repaired->diagnosis.turnedEdges.count, 0u);
    EXPECT_TRUE(repair(repaired->mesh)->counts.isNothing());
  }
}

TEST(Orientation, OfShellsInEachOtherAlternates) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    // Up to five shells around one middle, and cavities side by side in the innermost but one.
    TriangleMesh mesh;
    double expected = 0;
    const std::size_t depth = 2 + seed % 4;
    for (std::size_t i = 0; i < depth; ++i) {
      TriangleMesh shell =
          measured::placed(solid(i % 2 == 0 ? 0 : 1, seed), 0, 0, std::pow(0.5, double(i)), {});
      expected += (i % 2 == 0 ? 1 : -1) * measured::volume(shell);
      measured::turnSome(shell, random, double(random.below(3)) / 2);
      shapes::append(mesh, shell);
    }
    for (const double side : {-1.0, 1.0}) {
      TriangleMesh shell = measured::box(1, {0.02, 0.02, 0.02}, {0.8 * side, 0.8 * side, 0.8});
      expected -= measured::volume(shell);
      measured::turnSome(shell, random, double(random.below(3)) / 2);
      shapes::append(mesh, shell);
    }
    mesh = measured::placed(mesh, random.unit(), random.unit(), 1, {10, 20, 30});
    std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), std::mt19937_64(seed));
    const auto repaired = repair(mesh);
    ASSERT_TRUE(repaired);
    EXPECT_NEAR(measured::volume(repaired->mesh), expected, 1e-9);
    EXPECT_EQ(repaired->crossingParts, 0u);
    EXPECT_TRUE(repair(repaired->mesh)->counts.isNothing());
  }
}

TEST(Orientation, CountsWhatIsTurnedAsAWhole) {
  TriangleMesh mesh = measured::box(2), cavity = measured::box(2, {0.5, 0.5, 0.5});
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  shapes::append(mesh, cavity);
  const auto repaired = repair(mesh);
  ASSERT_TRUE(repaired);
  EXPECT_EQ(repaired->counts.turnedSolids, 1u);
  EXPECT_EQ(repaired->counts.turnedCavities, 1u);
  EXPECT_EQ(repaired->counts.turnedTriangles, 96u);
  EXPECT_NEAR(measured::volume(repaired->mesh), 7, 1e-12);
}

TEST(Orientation, OfAnotherObjectMakesNoCavity) {
  TriangleMesh mesh = measured::box(2), inner = measured::box(2, {0.5, 0.5, 0.5});
  shapes::append(mesh, inner);
  std::vector<std::uint32_t> objects(96, 0);
  std::fill(objects.begin() + 48, objects.end(), 1u);
  const auto repaired = repair(mesh, {.partOf = objects});
  ASSERT_TRUE(repaired);
  EXPECT_TRUE(repaired->counts.isNothing());
  EXPECT_NEAR(measured::volume(repaired->mesh), 9, 1e-12);
}

TEST(Orientation, OfPartsThatTouchIsOutwards) {
  // Beside each other, along an edge, at a corner; one of them, or both, inside out.
  for (const Vec3& to : {Vec3{2, 0, 0}, Vec3{2, 2, 0}, Vec3{2, 2, 2}, Vec3{2, 1, 0}, Vec3{2, 0.3, 0.7}})
    for (const int turned : {1, 2, 3}) {
      SCOPED_TRACE(testing::Message() << to.x << " " << to.y << " " << to.z << ", " << turned);
      TriangleMesh mesh = measured::box(2), other = measured::box(2, {1, 1, 1}, to);
      if (turned & 1)
        for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
      if (turned & 2)
        for (auto& t : other.triangles) std::swap(t[1], t[2]);
      shapes::append(mesh, other);
      const auto repaired = repair(mesh);
      ASSERT_TRUE(repaired);
      EXPECT_NEAR(measured::volume(repaired->mesh), 16, 1e-12);
    }
}

TEST(Orientation, OfACavityThatTouchesItsWallIsInwards) {
  // An octahedron whose corners are in the middles of the sides of a cube, and a box that stands on its
  // floor.
  TriangleMesh mesh = measured::box(3), octahedron,
               standing = measured::box(2, {0.5, 0.5, 0.5}, {0, 0, -0.5});
  octahedron.positions = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  octahedron.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4},
                          {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}};
  for (const TriangleMesh& inner : {octahedron, standing}) {
    TriangleMesh both = mesh;
    shapes::append(both, inner);
    const auto repaired = repair(both);
    ASSERT_TRUE(repaired);
    EXPECT_NEAR(measured::volume(repaired->mesh), 8 - measured::volume(inner), 1e-12);
    EXPECT_EQ(repaired->counts.turnedCavities, 1u);
  }
}

TEST(Orientation, OfPartsThatCrossIsKeptAmongThem) {
  const TriangleMesh large = measured::box(2), small = measured::box(2, {0.5, 0.5, 0.5}, {0.9, 0.13, 0.17});
  for (const int turned : {0, 1, 2, 3}) {
    SCOPED_TRACE(turned);
    TriangleMesh mesh = large, other = small;
    if (turned & 1)
      for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    if (turned & 2)
      for (auto& t : other.triangles) std::swap(t[1], t[2]);
    shapes::append(mesh, other);
    const auto repaired = repair(mesh);
    ASSERT_TRUE(repaired);
    EXPECT_EQ(repaired->crossingParts, 2u);
    // The large one faces outwards; the small one as it did beside it.
    EXPECT_NEAR(measured::volume(repaired->mesh), turned == 0 || turned == 3 ? 9 : 7, 1e-12);
  }
}

TEST(Orientation, OfPartsInOnePlaceIsOutwards) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    const TriangleMesh one = measured::placed(measured::box(2), 0.1 * double(seed), 0.3, 1, {1, 2, 3});
    TriangleMesh mesh = one;
    shapes::append(mesh, one);
    const auto repaired = repair(mesh);
    ASSERT_TRUE(repaired);
    EXPECT_NEAR(measured::volume(repaired->mesh), 16, 1e-9);
  }
}

TEST(Orientation, OfWhatEnclosesNothingIsThatOfMost) {
  // A sheet with two sides, and a disc.
  TriangleMesh card = shapes::sheet(3, 3);
  const std::size_t faces = card.triangles.size();
  for (std::size_t t = 0; t < faces; ++t)
    card.triangles.push_back({card.triangles[t][0], card.triangles[t][2], card.triangles[t][1]});
  EXPECT_EQ(repair(card)->counts.turnedTriangles, 0u);
  TriangleMesh disc = shapes::sheet(5, 5);
  for (std::size_t t = 0; t < 40; ++t) std::swap(disc.triangles[t][1], disc.triangles[t][2]);
  EXPECT_EQ(repair(disc)->counts.turnedTriangles, 10u);
}

TEST(Orientation, OfAPartThatAgreesStaysIfOutwardsIsNotAskedFor) {
  TriangleMesh room = measured::box(2);
  for (auto& t : room.triangles) std::swap(t[1], t[2]);
  EXPECT_TRUE(repair(room, {.turnsOutwards = false})->counts.isNothing());
  TriangleMesh most = measured::box(2);
  for (std::size_t t = 0; t < 36; ++t) std::swap(most.triangles[t][1], most.triangles[t][2]);
  const auto repaired = repair(most, {.turnsOutwards = false});
  EXPECT_EQ(repaired->counts.turnedTriangles, 36u);
  EXPECT_NEAR(measured::volume(repaired->mesh), 8, 1e-12);
}

TEST(Orientation, RefusesPartsThatDoNotFit) {
  const std::vector<std::uint32_t> few(3, 0);
  EXPECT_EQ(repair(measured::box(1), {.partOf = few}).error().culprit, "partOf");
}

}  // namespace
}  // namespace arete

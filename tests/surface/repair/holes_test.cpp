// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "surface/families.h"
#include "surface/repair/measured.h"
#include "surface/repair/repair.h"
#include "surface/shapes.h"

namespace arete {
namespace {

TEST(Repair, FillsHolesOfAtMostSoManyEdges) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    TriangleMesh mesh = shapes::sheet(24, 12, true, true);
    std::mt19937_64 random(seed);
    // Without all triangles of one vertex: a hole of six edges.
    const auto gone = static_cast<std::uint32_t>(random() % mesh.positions.size());
    std::erase_if(mesh.triangles, [&](const auto& t) { return std::ranges::find(t, gone) != t.end(); });
    EXPECT_EQ(repair(mesh, {.mostHoleEdges = 5})->counts.filledHoles, 0u);
    const auto filled = repair(mesh, {.mostHoleEdges = 6});
    ASSERT_TRUE(filled);
    EXPECT_EQ(filled->counts.filledHoles, 1u);
    EXPECT_EQ(filled->counts.fillingTriangles, 4u);
    EXPECT_TRUE(filled->diagnosis.borders.empty());
    EXPECT_EQ(filled->diagnosis.turnedEdges.count, 0u);
    EXPECT_EQ(filled->diagnosis.components[0].genus, 1);
    EXPECT_EQ(filled->triangleOf.back(), RepairedMesh::kNone);
  }
}

TEST(Repair, FillsNothingUnasked) {
  EXPECT_TRUE(repair(shapes::sheet(5, 4, true))->counts.isNothing());
}

TEST(Repair, DoesNotPutALidOnASingleTriangle) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(repair(mesh, {.mostHoleEdges = 100})->counts.filledHoles, 0u);
}

using measured::EdgesByPosition;

std::size_t shared(const shapes::Triangle& a, const shapes::Triangle& b) {
  return std::size_t(
      std::ranges::count_if(a, [&](std::uint32_t v) { return std::ranges::find(b, v) != b.end(); }));
}

TEST(Holes, ThatShareAVertexAreFilledEachForItself) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    const TriangleMesh whole = seed % 2 == 0 ? shapes::globe(10, 6) : measured::box(4, {1, 2, 3});
    measured::Random random(seed);
    // Up to three faces of which each two share one vertex, the same one.
    const std::size_t first = random.below(whole.triangles.size());
    std::vector<std::size_t> gone = {first};
    std::uint32_t common = RepairedMesh::kNone;
    for (std::size_t t = 0; t < whole.triangles.size() && gone.size() < 2 + seed % 2; ++t) {
      if (shared(whole.triangles[t], whole.triangles[first]) != 1 || t == first) continue;
      const auto it = std::ranges::find_if(whole.triangles[t], [&](std::uint32_t v) {
        return std::ranges::find(whole.triangles[first], v) != whole.triangles[first].end();
      });
      if (common != RepairedMesh::kNone && *it != common) continue;
      if (std::ranges::any_of(
              gone, [&](std::size_t g) { return shared(whole.triangles[t], whole.triangles[g]) > 1; }))
        continue;
      common = *it;
      gone.push_back(t);
    }
    ASSERT_GE(gone.size(), 2u);
    TriangleMesh holed = whole;
    for (const std::size_t t : gone) holed.triangles[t] = {0, 0, 0};
    std::erase(holed.triangles, shapes::Triangle{0, 0, 0});
    // Also where the fans of the vertex have got vertices of their own already.
    const TriangleMesh split = repair(holed)->mesh;
    EXPECT_GT(split.positions.size(), holed.positions.size());
    for (const TriangleMesh& mesh : {holed, split}) {
      const auto filled = repair(mesh, {.mostHoleEdges = 3});
      ASSERT_TRUE(filled);
      EXPECT_EQ(filled->counts.filledHoles, gone.size());
      EXPECT_EQ(filled->openHoles, 0u);
      EXPECT_EQ(measured::edges(filled->mesh), EdgesByPosition());
      EXPECT_NEAR(measured::volume(filled->mesh), measured::volume(whole), 1e-12);
      EXPECT_NEAR(measured::area(filled->mesh), measured::area(whole), 1e-12);
      EXPECT_EQ(filled->mesh.positions.size(), whole.positions.size());
    }
  }
}

TEST(Holes, AreFilledAlongTheDiagonalThatIsFree) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    measured::Random random(seed);
    TriangleMesh mesh = shapes::tetrahedron();
    for (Vec3& p : mesh.positions)
      p = p * (1 + 3 * random.unit()) + Vec3{random.unit(), random.unit(), random.unit()};
    const double whole = std::abs(measured::volume(mesh));
    // Without any two of its faces.
    mesh.triangles.erase(mesh.triangles.begin() + std::ptrdiff_t(random.below(4)));
    mesh.triangles.erase(mesh.triangles.begin() + std::ptrdiff_t(random.below(3)));
    const auto filled = repair(mesh, {.mostHoleEdges = 4});
    ASSERT_TRUE(filled);
    EXPECT_EQ(filled->counts.filledHoles, 1u);
    EXPECT_EQ(measured::edges(filled->mesh), EdgesByPosition());
    EXPECT_NEAR(measured::volume(filled->mesh), whole, 1e-12);
  }
}

TEST(Holes, OfAConvexSolidAreFilledWhateverIsGone) {
  // All faces at an edge, at a vertex or at three of a row: the rest is closed again, and no edge has four
  // faces.
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    measured::Random random(seed);
    const TriangleMesh whole = shapes::shaken(shapes::globe(6 + seed % 5, 3), seed, 0.01);
    TriangleMesh mesh = whole;
    const auto v = std::uint32_t(random.below(whole.positions.size()));
    const std::size_t least = 1 + seed % 2;
    const shapes::Triangle at = whole.triangles[random.below(whole.triangles.size())];
    std::erase_if(mesh.triangles, [&](const auto& t) {
      return seed % 3 == 0 ? std::ranges::find(t, v) != t.end() : shared(t, at) > least;
    });
    const auto filled = repair(mesh, {.mostHoleEdges = 20});
    ASSERT_TRUE(filled);
    EXPECT_EQ(measured::edges(filled->mesh), EdgesByPosition());
    EXPECT_EQ(filled->openHoles, 0u);
    EXPECT_NEAR(measured::volume(filled->mesh), measured::volume(whole), 0.3);
  }
}

/// A flat sheet without the squares for which isGone(column, row).
template <class IsGone>
TriangleMesh sheetWithout(std::uint32_t columns, std::uint32_t rows, const IsGone& isGone) {
  TriangleMesh mesh = shapes::sheet(columns, rows), kept;
  kept.positions = mesh.positions;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (!isGone(t / 2 % columns, t / 2 / columns)) kept.triangles.push_back(mesh.triangles[t]);
  return kept;
}

TEST(Holes, OfAFlatSheetAreFilledAndItsOutlineGetsNoLid) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    measured::Random random(seed);
    const auto columns = std::uint32_t(3 + random.below(6)), rows = std::uint32_t(3 + random.below(6));
    const auto c = std::uint32_t(1 + random.below(columns - 2)),
               r = std::uint32_t(1 + random.below(rows - 2));
    TriangleMesh mesh =
        sheetWithout(columns, rows, [&](auto x, auto y) { return seed % 4 > 0 && x == c && y == r; });
    for (Vec3& p : mesh.positions)
      if (seed % 3 == 1) p.x += 0.1 * p.y * p.y;  // sheared, still flat
    if (seed % 5 == 2)
      for (Vec3& p : mesh.positions) p.z += 0.3 * std::sin(p.x) * std::cos(2 * p.y);
    mesh = measured::placed(mesh, random.unit() * 6, random.unit() * 6, 1, {5, 6, 7});
    if (seed % 2 == 0) mesh = measured::asFloats(mesh);
    const auto filled = repair(mesh, {.mostHoleEdges = 1000});
    ASSERT_TRUE(filled);
    EXPECT_EQ(filled->counts.filledHoles, seed % 4 > 0 ? 1u : 0u);
    EXPECT_EQ(filled->openHoles, 1u);
    EXPECT_EQ(filled->mesh.triangles.size(), std::size_t{2} * columns * rows);
    EXPECT_EQ(measured::edges(filled->mesh).open, std::size_t{2} * (columns + rows));
    EXPECT_EQ(measured::edges(filled->mesh).crowded, 0u);
  }
}

TEST(Holes, OfASquareAndOfADiscAreNone) {
  TriangleMesh square = shapes::sheet(1, 1), disc;
  disc.positions.push_back({0, 0, 0});
  for (std::uint32_t i = 0; i < 12; ++i) {
    disc.positions.push_back({std::cos(i * 0.5236), std::sin(i * 0.5236), 0});
    disc.triangles.push_back({0, i + 1, (i + 1) % 12 + 1});
  }
  for (const TriangleMesh& mesh : {square, disc, shapes::sheet(2, 1)}) {
    const auto filled = repair(mesh, {.mostHoleEdges = 20});
    EXPECT_TRUE(filled->counts.isNothing());
    EXPECT_EQ(filled->openHoles, 1u);
  }
}

TEST(Holes, OfATubeAndOfABowlAreFilled) {
  for (const std::uint32_t around : {5u, 8u, 17u, 40u}) {
    const TriangleMesh tube = shapes::sheet(around, 3, true);
    const auto filled = repair(tube, {.mostHoleEdges = around});
    EXPECT_EQ(filled->counts.filledHoles, 2u);
    EXPECT_EQ(measured::edges(filled->mesh), EdgesByPosition());
    EXPECT_NEAR(measured::volume(filled->mesh), 3 * around / 2.0 * std::sin(2 * std::numbers::pi / around),
                1e-9);
    TriangleMesh bowl = shapes::globe(around, 5);
    std::erase_if(bowl.triangles, [&](const auto& t) {
      return std::ranges::any_of(t, [&](std::uint32_t v) { return bowl.positions[v].z > 0.1; });
    });
    EXPECT_EQ(repair(bowl, {.mostHoleEdges = around})->counts.filledHoles, 1u);
  }
}

TEST(Holes, BetweenTheSidesOfAFlatBagAreClosedByJoining) {
  // Two discs in one place, joined along their rims but for some edges.
  constexpr std::uint32_t kRim = 12;
  for (std::uint32_t open = 2; open < kRim; ++open) {
    SCOPED_TRACE(open);
    TriangleMesh bag;
    for (std::uint32_t i = 0; i < kRim; ++i)
      bag.positions.push_back({std::cos(i / 2.0), std::sin(i / 2.0), 0});
    bag.positions.insert(bag.positions.end(), {{0, 0, 0}, {0, 0, 0}});
    std::vector<std::uint32_t> back(kRim);
    for (std::uint32_t i = 0; i < kRim; ++i) {
      back[i] = i;
      if (i == 0 || i >= open) continue;
      back[i] = std::uint32_t(bag.positions.size());
      bag.positions.push_back(bag.positions[i]);
    }
    for (std::uint32_t i = 0; i < kRim; ++i) {
      const std::uint32_t next = (i + 1) % kRim;
      bag.triangles.push_back({i, next, kRim});
      bag.triangles.push_back({back[next], back[i], kRim + 1});
    }
    ASSERT_EQ(repair(bag, {.mostHoleEdges = 2 * open - 1})->diagnosis.borders.size(), 1u);
    const auto filled = repair(bag, {.mostHoleEdges = 2 * open});
    ASSERT_TRUE(filled);
    EXPECT_TRUE(filled->diagnosis.borders.empty());
    EXPECT_EQ(filled->counts.fillingTriangles, 0u);
    EXPECT_EQ(filled->counts.joinedVertices, open - 1);
    EXPECT_EQ(filled->mesh.triangles.size(), bag.triangles.size());
  }
}

}  // namespace
}  // namespace arete

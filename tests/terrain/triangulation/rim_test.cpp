// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/triangulation/rim.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "datasets/random.h"
#include "engine/ids_of.h"
#include "terrain/triangulation/finest_raster.h"

namespace arete {
namespace {

/// A raster with samples without data, and its finest mesh.
struct Ground {
  RasterHeightfield field;
  std::vector<VertexId> pinched;
  LiveMesh mesh;
  LatticePlan plan;

  explicit Ground(const std::vector<std::array<std::uint32_t, 2>>& voids)
      : field(with(voids)), mesh(finestMesh(field, pinched)), plan(field.columns, 1, 1) {}

  auto vertices() const { return test::idsBelow<VertexId>(field.size()); }

 private:
  static RasterHeightfield with(const std::vector<std::array<std::uint32_t, 2>>& voids) {
    RasterHeightfield field;
    field.columns = 12;
    field.rows = 10;
    field.heights.assign(120, 1.0);
    for (const auto& [column, row] : voids) field.heights[field.index(column, row)] = std::nan("");
    return field;
  }
};

TEST(Rim, AdmitsAReflexVertexWithinTheToleranceOnly) {
  // One sample without data: the rim around it is a diamond-like polygon, cut off at two corners by
  // diagonals.
  const Ground ground({{5, 5}});
  Star star;
  int admitted = 0, reflex = 0;
  for (const double tolerance : {0.2, 1.0, 3.0}) {
    const Rim rim(ground.mesh, ground.plan, tolerance);
    int here = 0;
    for (const VertexId v : ground.vertices()) {
      if (!ground.mesh.isInTriangle(v)) continue;
      ASSERT_TRUE(star.gather(ground.mesh, v, kMaxHoleCorners));
      const LatticePlan::Cell cell = ground.plan.cell(v);
      if (!star.isOpen || cell.column == 0 || cell.row == 0 || cell.column == 11 || cell.row == 9) continue;
      const VertexId after = star.link[0], before = star.link[star.linkSize - 1];
      if (ground.plan.orientation(before, v, after) >= 0) continue;
      ++reflex;
      if (!rim.mayFill(before, v, after)) continue;
      ++here;
      // The oracle: v itself, the only original rim vertex between the two, is within the tolerance.
      const Vec2 a = ground.plan.planPosition(before), b = ground.plan.planPosition(after),
                 p = ground.plan.planPosition(v);
      const double distance =
          std::abs((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / std::hypot(b.x - a.x, b.y - a.y);
      EXPECT_LE(distance, tolerance * (1 + 1e-9));
    }
    EXPECT_GE(here, admitted) << "a larger tolerance admits no fewer";
    admitted = here;
  }
  EXPECT_GT(reflex, 0);
  EXPECT_GT(admitted, 0);
}

TEST(Rim, RejectsEveryFillThatWouldCoverAVertex) {
  Random random(4);
  int covered = 0, free = 0;
  for (int trial = 0; trial < 100; ++trial) {
    std::vector<std::array<std::uint32_t, 2>> voids;
    for (int i = 0; i < 5; ++i) voids.push_back({3 + random.below(6), 3 + random.below(4)});
    const Ground ground(voids);
    if (!ground.pinched.empty()) continue;
    const Rim rim(ground.mesh, ground.plan, 1e6);  // the distance excludes nothing
    std::map<VertexId, VertexId> next, previous;
    for (const LiveMesh::Triangle& t : ground.mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i)
        if (!t.twin[i].isValid()) {
          next[t.corners[i]] = t.corners[(i + 1) % 3];
          previous[t.corners[(i + 1) % 3]] = t.corners[i];
        }
    // Fills of a rim whose other vertices between the three are removed: the original chain is longer.
    for (const auto& entry : next)
      for (int forth = 1; forth <= 4; ++forth)
        for (int back = 1; back <= 4; ++back) {
          const VertexId v = entry.first;
          VertexId before = v, after = v;
          for (int i = 0; i < forth; ++i) after = next.at(after);
          for (int i = 0; i < back; ++i) before = previous.at(before);
          if (before == after || before == v || after == v) continue;
          if (ground.plan.orientation(before, v, after) >= 0) continue;
          bool isCovered = false;
          for (const VertexId u : ground.vertices())
            if (u != before && u != v && u != after && ground.mesh.isInTriangle(u))
              isCovered = isCovered || (ground.plan.orientation(v, before, u) >= 0 &&
                                        ground.plan.orientation(after, v, u) >= 0 &&
                                        ground.plan.orientation(before, after, u) >= 0);
          EXPECT_EQ(rim.mayFill(before, v, after), !isCovered)
              << "trial " << trial << ": " << before.index() << ", " << v.index() << ", " << after.index();
          ++(isCovered ? covered : free);
        }
  }
  EXPECT_GT(covered, 100);
  EXPECT_GT(free, 100);
}

TEST(Rim, LetsOneFillOfALevelHaveAVertex) {
  const Ground ground({{5, 5}});
  Rim rim(ground.mesh, ground.plan, 1);
  const VertexId a(1), b(2), c(3), d(4);
  EXPECT_TRUE(rim.claim(a, b, 7));
  EXPECT_FALSE(rim.claim(b, c, 7)) << "b is taken";
  EXPECT_TRUE(rim.claim(c, d, 7)) << "a rejected claim takes neither end";
  EXPECT_TRUE(rim.claim(b, c, 8)) << "another level";
}

TEST(Rim, ClosesASlitBetweenTwoVertices) {
  // Two triangles side by side that do not know each other: 0-1-2 and 2-1-3.
  std::vector<VertexId> pinched;
  LiveMesh mesh = LiveMesh::fromTriangles({{0, 1, 2}, {2, 1, 3}}, 4, pinched);
  const SlotId first(0), second(1);
  const HalfedgeId h = LiveMesh::halfedge(first, 1), g = LiveMesh::halfedge(second, 0);  // 1 -> 2 and 2 -> 1
  ASSERT_EQ(mesh.twinOf(h), g);
  mesh.setTwin(h, HalfedgeId());
  mesh.setTwin(g, HalfedgeId());
  mesh.vertexHalfedge[VertexId(2)] = g;
  Rim::closeVoid(mesh, h);
  EXPECT_EQ(mesh.twinOf(h), g);
  EXPECT_EQ(mesh.twinOf(g), h);

  const HalfedgeId outer = LiveMesh::halfedge(first, 0);  // 0 -> 1: nothing runs back
  Rim::closeVoid(mesh, outer);
  EXPECT_FALSE(mesh.twinOf(outer).isValid());
}

}  // namespace
}  // namespace arete

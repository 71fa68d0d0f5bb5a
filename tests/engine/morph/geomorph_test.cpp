// SPDX-License-Identifier: GPL-3.0-or-later
//
// The oracle is morph_oracle.h. Tolerances and jumps are checked at every sample of generated terrains, seen
// by cameras at random and along slow flights.
#include "engine/morph/geomorph.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "datasets/families.h"
#include "engine/cut_promises.h"
#include "engine/family_models.h"
#include "engine/morph/geomorphed_cut.h"
#include "engine/morph_flight.h"
#include "engine/morph_oracle.h"

namespace arete {
namespace {

TEST(MorphNodes, PlaceEveryVertexOnTheFloorThatItRefines) {
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    const std::vector<MorphNode> nodes = makeMorphNodes(mt);
    ASSERT_EQ(nodes.size(), mt.nodeCount());
    RunContext one;
    one.threads = 1;
    const std::vector<MorphNode> again = makeMorphNodes(mt, one);
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      const MorphNode& node = nodes[n];
      EXPECT_EQ(std::memcmp(&node, &again[n], sizeof node), 0);
      bool isFloor = false;
      for (const std::uint32_t t : mt.floor(NodeId(n)))
        isFloor = isFloor || mt.corners(TriangleId(t)) == node.corner;
      EXPECT_TRUE(isFloor) << m.name << " node " << n;
      const Vec3 v = mt.position(mt.apex(NodeId(n)));
      std::array<Vec3, 3> p;
      for (int i = 0; i < 3; ++i) p[i] = mt.position(VertexId(node.corner[i]));
      EXPECT_GE(std::min({node.weight[0], node.weight[1], 1 - node.weight[0] - node.weight[1]}), -1e-7f);
      EXPECT_NEAR(node.interpolate(p[0].x, p[1].x, p[2].x), v.x, 1e-5) << m.name << " node " << n;
      EXPECT_NEAR(node.interpolate(p[0].y, p[1].y, p[2].y), v.y, 1e-5) << m.name << " node " << n;
      const double slack = 1e-6 * (1 + std::abs(p[0].z) + std::abs(p[1].z) + std::abs(p[2].z));
      EXPECT_NEAR(v.z - node.interpolate(p[0].z, p[1].z, p[2].z), node.detail, slack) << m.name;
      EXPECT_LE(std::abs(node.detail), mt.saturatedError(NodeId(n)) + slack) << m.name << " node " << n;
    }
  }
}

TEST(MorphNodes, StandOnTheirFloorsAmongPointsAndOnRimsThatWereStraightened) {
  std::vector<FamilyModel> models;
  for (const PointFamily& family : pointFamilies())
    if (Result<TerrainModel> made = build(family.make(300, 7)))
      models.push_back({std::string(family.name), *made});
  for (const RasterFamily& family : rasterFamilies()) {
    BuildOptions options;
    options.rimTolerance = 2;
    if (Result<TerrainModel> made = build(family.make(30, 25, 3), options))
      models.push_back({std::string(family.name) + " straightened", *made});
  }
  EXPECT_GT(models.size(), 10u);
  for (const FamilyModel& m : models) {
    const MultiTriangulation& mt = m.model.mt;
    const Extent extent(mt);
    const std::vector<MorphNode> nodes = makeMorphNodes(mt);
    for (std::uint32_t n = 0; n < nodes.size(); ++n) {
      const MorphNode& node = nodes[n];
      const Vec3 v = mt.position(mt.apex(NodeId(n)));
      std::array<Vec3, 3> p;
      for (int i = 0; i < 3; ++i) p[i] = mt.position(VertexId(node.corner[i]));
      EXPECT_GE(std::min({node.weight[0], node.weight[1], 1 - node.weight[0] - node.weight[1]}), -1e-7f);
      const double slack = 1e-6 * (extent.plan.xMax - extent.plan.xMin + extent.plan.yMax - extent.plan.yMin);
      EXPECT_NEAR(node.interpolate(p[0].x, p[1].x, p[2].x), v.x, slack) << m.name << " node " << n;
      EXPECT_NEAR(node.interpolate(p[0].y, p[1].y, p[2].y), v.y, slack) << m.name << " node " << n;
      EXPECT_LE(std::abs(node.detail), mt.saturatedError(NodeId(n)) + 1e-6 * extent.relief()) << m.name;
    }
    if (!m.model.isRaster) continue;
    std::mt19937_64 random(65);
    const RasterHeightfield field = m.model.rasterSamples();
    for (int round = 0; round < 5; ++round) {
      const MorphFlight flight(mt, 100, random);
      const MorphCamera camera({.view = flight.view, .pixels = flight.pixels}, mt.arrays().metric);
      IncrementalCut cut(mt);
      GeomorphedTerrain surface(mt);
      follow(cut, flight.view, camera);
      surface.update(camera, cut);
      const auto over = heightsOver(m.model, cut.triangles(), [&](std::uint32_t v) {
        return mt.position(VertexId(v)).z + surface.offset(VertexId(v));
      });
      EXPECT_LE(worstPixels(m.model, PlainCamera(flight.view), field.heights, over),
                flight.pixels * (1 + 1e-6) + 1e-5)
          << m.name;
    }
  }
}

TEST(MorphCamera, SaysTheSameOfManyBallsAsOfEach) {
  std::mt19937_64 random(60);
  for (const FamilyModel& m : familyModels()) {
    const MultiTriangulation& mt = m.model.mt;
    View view = randomView(Extent(mt), random);
    if (random() % 2) view.nearDistance = 0.05 * Extent(mt).size();
    const MorphCamera camera({.view = view}, mt.arrays().metric);
    const ViewError criterion({.view = view, .pixels = 1}, mt.arrays().metric);
    std::vector<double> pixels(mt.nodeCount());
    camera.pixelsPerHeight(mt.arrays().sphere, pixels);
    std::size_t off = 0;
    for (std::uint32_t n = 0; n < mt.nodeCount(); ++n) {
      const Sphere& ball = mt.arrays().sphere[n];
      const double one = camera.pixelsPerHeight(ball), expected = 1 / criterion.allowedError(ball);
      const auto close = [&](double a) { return a == expected || std::abs(a - expected) <= 1e-6 * expected; };
      off += close(one) && close(pixels[n]) ? 0 : 1;
    }
    EXPECT_EQ(off, 0u) << m.name << " of " << mt.nodeCount();
  }
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lines of sight through placed surfaces against all of their triangles, by code of its own: places by
// matrices of the angles, intersections in long doubles.
#include "io/query/scene/object_sight.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "surface/builder/build.h"
#include "surface/families.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

using Real = long double;
using Place = std::array<Real, 3>;

Place minus(const Place& a, const Place& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Place crossed(const Place& a, const Place& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Real dotted(const Place& a, const Place& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// A position of a file (z up) where an object has it: rolled, pitched, headed, one after the other.
Place where(const Vec3& p, const PlacedObject& object) {
  const auto turned = [](Real a, Real b, Real degrees) {
    const Real t = degrees * std::numbers::pi_v<Real> / 180;
    return std::array{a * std::cos(t) - b * std::sin(t), a * std::sin(t) + b * std::cos(t)};
  };
  const Turn& turn = object.stated.turn;
  Place q{p.x, p.y, p.z};
  const auto rolled = turned(q[2], q[0], turn.roll);  // up goes to the right
  q = {rolled[1], q[1], rolled[0]};
  const auto pitched = turned(q[1], q[2], turn.pitch);  // the front goes up
  q = {q[0], pitched[0], pitched[1]};
  const auto headed = turned(q[1], q[0], turn.heading);  // the front goes to the right
  q = {headed[1], headed[0], q[2]};
  for (Real& c : q) c *= object.stated.scale;
  return {q[0] + object.xy.x, q[1] + object.xy.y, q[2] + object.height};
}

/// The first triangle on a way, as a share of it.
std::optional<Real> bruteForce(const std::vector<std::array<Place, 3>>& triangles, const Place& from,
                               const Place& to) {
  std::optional<Real> first;
  const Place way = minus(to, from);
  for (const auto& [a, b, c] : triangles) {
    const Place u = minus(b, a), v = minus(c, a), n = crossed(u, v);
    const Real across = dotted(n, way);
    if (across == 0) continue;
    const Real t = dotted(n, minus(a, from)) / across;
    if (t < 0 || t > 1) continue;
    const Place p = {from[0] + t * way[0], from[1] + t * way[1], from[2] + t * way[2]};
    const auto side = [&](const Place& k, const Place& l) {
      return dotted(n, crossed(minus(l, k), minus(p, k)));
    };
    if (side(a, b) >= 0 && side(b, c) >= 0 && side(c, a) >= 0 && (!first || t < *first)) first = t;
  }
  return first;
}

/// Flat ground of 2 km by 2 km, and surfaces of every family on it.
struct Field {
  OpenScene scene;
  std::vector<std::vector<std::array<Place, 3>>> triangles;  // by object

  explicit Field(std::uint64_t seed) {
    RasterHeightfield field;
    field.columns = field.rows = 21;
    field.heights.assign(441, 50);
    field.georeference.geoTransform = {500000, 100, 0, 5300000, 0, -100};
    field.georeference.hasGeoTransform = true;
    scene.models.push_back(std::make_shared<const Model>(std::move(*build(field))));
    scene.objects.emplace_back();
    scene.objects.back().stated.name = "ground";
    scene.ground = 0;
    triangles.emplace_back();
    std::mt19937_64 random(seed);
    const auto from = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (const auto& family : shapes::families(seed)) {
      auto model = buildSurface(SurfaceMesh(family.mesh));
      if (!model) continue;
      double size = 0;
      for (const Vec3& p : family.mesh.positions) size = std::max(size, norm(p));
      PlacedObject object;
      object.stated.name = family.name;
      object.stated.turn = {from(-180, 180), from(-90, 90), from(-180, 180)};
      object.stated.scale = from(20, 80) / size;
      object.model = scene.models.size();
      object.xy = {500000 + from(200, 1800), 5300000 - from(200, 1800)};
      object.height = from(50, 200);
      std::vector<std::array<Place, 3>> placed;
      for (const auto& t : family.mesh.triangles)
        placed.push_back({where(family.mesh.positions[t[0]], object),
                          where(family.mesh.positions[t[1]], object),
                          where(family.mesh.positions[t[2]], object)});
      triangles.push_back(std::move(placed));
      scene.models.push_back(std::make_shared<const Model>(std::move(*model)));
      scene.objects.push_back(std::move(object));
    }
  }
};

TEST(ObjectSight, MeetsTheTriangleThatAllOfThemSay) {
  for (const std::uint64_t seed : {1u, 2u}) {
    const Field field(seed);
    const TerrainModel& terrain = *field.scene.terrain();
    ASSERT_GT(field.triangles.size(), 5u);
    std::mt19937_64 random(seed + 100);
    const auto from = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    std::vector<SightPath> paths;
    std::vector<std::array<Place, 2>> ends;
    for (int i = 0; i < 600; ++i) {
      // Towards one of the objects, past it or through it.
      const PlacedObject& goal = field.scene.objects[1 + i % (field.scene.objects.size() - 1)];
      const Vec2 a{500000 + from(0, 2000), 5300000 - from(0, 2000)};
      const Vec2 through{goal.xy.x + from(-40, 40), goal.xy.y + from(-40, 40)};
      const double reach = from(0.9, 1.6);
      const Vec2 b{a.x + (through.x - a.x) * reach, a.y + (through.y - a.y) * reach};
      const double h = from(60, 250), k = h + (goal.height + from(-40, 40) - h) * reach;
      paths.push_back({sightPlan(terrain, a), sightPlan(terrain, b), h, k});
      ends.push_back({Place{a.x, a.y, h}, Place{b.x, b.y, k}});
    }
    const auto hits = hitObjects(paths, *makePlaneEarth(terrain), field.scene);
    ASSERT_TRUE(hits) << hits.error().describe();
    int blocked = 0;
    for (std::size_t i = 0; i < paths.size(); ++i) {
      std::optional<Real> first;
      std::size_t object = 0;
      for (std::size_t o = 1; o < field.triangles.size(); ++o)
        if (const auto t = bruteForce(field.triangles[o], ends[i][0], ends[i][1]);
            t && (!first || *t < *first))
          first = t, object = o;
      const auto& hit = (*hits)[i];
      ASSERT_EQ(hit.has_value(), first.has_value()) << "seed " << seed << ", line " << i;
      if (!hit) continue;
      ++blocked;
      EXPECT_EQ(hit->object, object) << "seed " << seed << ", line " << i;
      const Place way = minus(ends[i][1], ends[i][0]);
      EXPECT_NEAR(hit->place.distance, double(*first) * std::hypot(double(way[0]), double(way[1])), 1e-5);
      EXPECT_NEAR(hit->place.sightHeight, double(ends[i][0][2] + *first * way[2]), 1e-5);
    }
    EXPECT_GT(blocked, 50);
    EXPECT_LT(blocked, 550);
  }
}

TEST(ObjectSight, AnEndOnAnObjectIsNotBlockedByThatPlace) {
  Field field(3);
  const TerrainModel& terrain = *field.scene.terrain();
  // A tetrahedron of 10 m on its base; its top is a place to look from.
  SurfaceMesh mesh;
  mesh.positions = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {0, 0, 10}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  field.scene.models.push_back(std::make_shared<const Model>(std::move(*buildSurface(std::move(mesh)))));
  PlacedObject mast;
  mast.model = field.scene.models.size() - 1;
  mast.xy = {501000, 5299000};
  mast.height = 50;
  field.scene.objects = {field.scene.objects[0], mast};
  const auto hit = [&](const Vec3& a, const Vec3& b) {
    const SightPath path{sightPlan(terrain, {a.x, a.y}), sightPlan(terrain, {b.x, b.y}), a.z, b.z};
    const auto hits = hitObjects(std::span(&path, 1), *makePlaneEarth(terrain), field.scene);
    return hits && (*hits)[0];
  };
  const Vec3 top{501000, 5299000, 60};
  EXPECT_FALSE(hit(top, {501000 - 300, 5299000 - 300, 60}));
  EXPECT_FALSE(hit({501000 - 300, 5299000 - 300, 60}, top));
  EXPECT_TRUE(hit(top, {501000 + 300, 5299000 + 300, -600})) << "through the mast itself";
  EXPECT_TRUE(hit({501000 - 20, 5298999.99, 55}, {501000 + 40, 5299002, 55}));
  // Straight up beside it and through it.
  EXPECT_FALSE(hit({501000 - 1, 5299000 - 1, 50}, {501000 - 1, 5299000 - 1, 90}));
  EXPECT_TRUE(hit({501000 + 2, 5299000 + 2, 50.5}, {501000 + 2, 5299000 + 2, 90}));
  field.scene.objects[1].stated.isShown = false;
  EXPECT_FALSE(hit(top, {501000 + 300, 5299000 + 300, -600}));
}

TEST(ObjectSight, AHitBlocksWhateverTheTerrainSaysAndTheNearerObstructionCounts) {
  const auto at = [](double distance) {
    SightPlace place;
    place.distance = distance;
    return place;
  };
  SightAnswer visible;
  EXPECT_TRUE(joinHit(visible, {.object = 2, .place = at(30)}));
  EXPECT_EQ(visible.verdict, SightVerdict::blocked);
  EXPECT_EQ(visible.obstruction->distance, 30);
  EXPECT_FALSE(joinHit(visible, {.object = 1, .place = at(40)}));
  EXPECT_EQ(visible.obstruction->distance, 30);
  SightAnswer unknown;
  unknown.verdict = SightVerdict::unknown;
  joinHit(unknown, {.object = 2, .place = at(30)});
  EXPECT_EQ(unknown.verdict, SightVerdict::blocked);
}

}  // namespace
}  // namespace arete

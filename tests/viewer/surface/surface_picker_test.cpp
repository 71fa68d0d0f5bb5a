// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/surface/surface_picker.h"

#include <gtest/gtest.h>

#include <array>

#include <cmath>
#include <numbers>

#include "datasets/random.h"
#include "surface/builder/build.h"
#include "surface/families.h"
#include "surface/front/front.h"

namespace arete {
namespace {

/// The nearest meeting of a ray with the triangles of a mesh, by areas: where the ray meets the plane of a
/// triangle, the three triangles to its sides cover no more than it does. In lengths of the direction.
std::optional<double> nearestOf(const std::vector<Vec3>& upright, const SurfaceMesh& mesh, const Vec3& eye,
                                const Vec3& d) {
  std::optional<double> nearest;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = upright[std::size_t(t[0])], b = upright[std::size_t(t[1])], c = upright[std::size_t(t[2])];
    const Vec3 normal = cross(b - a, c - a);
    if (dot(normal, d) == 0) continue;
    const double along = dot(normal, a - eye) / dot(normal, d);
    if (along < 0) continue;
    const Vec3 p = eye + along * d;
    const double whole = norm(normal);
    const double parts = norm(cross(a - p, b - p)) + norm(cross(b - p, c - p)) + norm(cross(c - p, a - p));
    if (parts > whole * (1 + 1e-8)) continue;
    if (!nearest || along < *nearest) nearest = along;
  }
  return nearest;
}

TEST(SurfacePicker, MeetsTheNearestOfAllTrianglesFromOutsideAndInside) {
  for (const std::uint64_t seed : {1u})
    for (const shapes::NamedMesh& family : shapes::families(seed))
      for (const char* up : {"z", "y"}) {
        auto built = buildSurface(SurfaceMesh(family.mesh), {});
        ASSERT_TRUE(built) << family.name << ": " << built.error().describe();
        SurfaceModel& model = *built;
        model.up = up;
        const ZUpFrame upright(model);
        const SurfacePicker picker(model, upright);
        const SurfaceMesh finest = finestSurfaceOf(model).mesh;
        std::vector<Vec3> places;
        Vec3 low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
        for (const Vec3& p : finest.positions) {
          places.push_back(upright.fromFile(p));
          const Vec3& q = places.back();
          low = {std::min(low.x, q.x), std::min(low.y, q.y), std::min(low.z, q.z)};
          high = {std::max(high.x, q.x), std::max(high.y, q.y), std::max(high.z, q.z)};
        }
        const double size = norm(high - low);
        Random random(seed + 77);
        int hits = 0;
        for (int i = 0; i < 40; ++i) {
          const double far = i % 3 == 0 ? 0.2 : 3;
          const Vec3 middle = (low + high) / 2;
          const Vec3 eye =
              middle + far * size * Vec3{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
          const Vec3 target{random.between(low.x, high.x), random.between(low.y, high.y),
                            random.between(low.z, high.z)};
          const Vec3 d = random.between(0.1, 5) * (target - eye);
          const auto wanted = nearestOf(places, finest, eye, d);
          const auto pick = picker.along(eye, d);
          ASSERT_EQ(pick.has_value(), wanted.has_value())
              << family.name << ", " << up << " up, seed " << seed << ", ray " << i;
          if (!pick) continue;
          ++hits;
          EXPECT_NEAR(pick->length, *wanted * norm(d), 1e-6 * size)
              << family.name << ", " << up << " up, seed " << seed << ", ray " << i;
          EXPECT_LT(norm(pick->place - (eye + *wanted * d)), 1e-6 * size);
        }
        EXPECT_GT(hits, 0) << family.name;
      }
}

TEST(SurfacePicker, NamesTheMaterialTheGroupAndTheLabelsThatTheFaceHas) {
  SurfaceMesh mesh(shapes::sheet(9, 9));
  mesh.materials = {Material{.name = "red"}, Material{.name = "green"}};
  mesh.groups = {"west", "east"};
  mesh.triangleAttributes = {Attribute{.name = "class", .type = ScalarType::uint8}};
  for (const auto& t : mesh.triangles) {
    double x = 0;
    for (const std::uint32_t v : t) x += mesh.positions[v].x / 3;
    mesh.materialOf.push_back(x < 4 ? 0 : 1);
    mesh.groupOf.push_back(x < 4 ? 0 : 1);
    mesh.triangleAttributes[0].append(std::array{x < 4 ? 2.0 : 6.0});
  }
  auto model = buildSurface(std::move(mesh), {});
  ASSERT_TRUE(model) << model.error().describe();
  const ZUpFrame upright(*model);
  const SurfacePicker picker(*model, upright);
  for (const double x : {0.3, 2.2, 3.7, 4.4, 7.6}) {
    const auto pick = picker.along(upright.fromFile({x, 3.3, 50}), {0, 0, -1});
    ASSERT_TRUE(pick);
    EXPECT_EQ(picker.materialOf(pick->triangle), x < 4 ? "red" : "green") << x;
    EXPECT_EQ(picker.partsOf(pick->triangle), x < 4 ? "group west, class 2" : "group east, class 6") << x;
    const Vec3 place = upright.toFile(pick->place);
    EXPECT_NEAR(place.x, x, 1e-9);
    EXPECT_NEAR(place.y, 3.3, 1e-9);
  }
  EXPECT_FALSE(picker.along(upright.fromFile({20, 3, 50}), {0, 0, -1}));
  EXPECT_FALSE(picker.along(upright.fromFile({3, 3, 50}), {0, 0, 1}));
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// How many samples each triangle gets, and their moments within a triangle against the integrals.
#include "measure/surface_samples.h"

#include <gtest/gtest.h>

#include <vector>

#include "terrain/measure_meshes.h"

namespace arete {
namespace {

using namespace measuring_test;

TEST(SurfaceSamples, GiveEachTriangleItsShareAndStayOnIt) {
  for (const std::uint64_t count : {1u, 7u, 1000u, 20000u}) {
    TriangleMesh mesh = soup(60, count);
    const SurfaceSamples samples(mesh, count, 5);
    ASSERT_EQ(samples.count(), count);
    std::vector<std::uint64_t> share(mesh.triangles.size());
    std::uint32_t walked = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      std::uint32_t triangle = samples.triangleOf(i);
      const Vec3 p = samples.at(i, triangle), again = samples.at(i, walked);
      ASSERT_EQ(p, again);
      ASSERT_EQ(triangle, walked);
      const auto& t = mesh.triangles[triangle];
      ASSERT_LT(distanceTo(p, mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]), 1e-14L);
      ++share[triangle];
    }
    const double area = surfaceArea(mesh);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      TriangleMesh one;
      one.positions = mesh.positions;
      one.triangles = {mesh.triangles[t]};
      EXPECT_NEAR(double(share[t]), surfaceArea(one) / area * double(count), 1 + 1e-9) << "triangle " << t;
    }
  }
}

TEST(SurfaceSamples, FillATriangleEvenly) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const SurfaceSamples samples(mesh, 10000, seed);
    double x = 0, y = 0, xx = 0, xy = 0;
    std::uint32_t triangle = 0;
    for (std::uint64_t i = 0; i < samples.count(); ++i) {
      const Vec3 p = samples.at(i, triangle);
      x += p.x / 1e4, y += p.y / 1e4, xx += p.x * p.x / 1e4, xy += p.x * p.y / 1e4;
    }
    EXPECT_NEAR(x, 1.0 / 3, 1e-3);
    EXPECT_NEAR(y, 1.0 / 3, 1e-3);
    EXPECT_NEAR(xx, 1.0 / 6, 1e-3);
    EXPECT_NEAR(xy, 1.0 / 12, 1e-3);
  }
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/packed/surface/rounded_surface.h"

#include <gtest/gtest.h>

#include <cmath>

#include "surface/builder/build.h"
#include "surface/families.h"

namespace arete::packed {
namespace {

SurfaceModel modelOf(TriangleMesh mesh) {
  Result<SurfaceModel> model = buildSurface(SurfaceMesh(std::move(mesh)));
  if (!model) throw std::runtime_error(model.error().message);
  return std::move(*model);
}

TEST(RoundedSurface, FindsTheStepThatAllCoordinatesAreMultiplesOf) {
  TriangleMesh mesh = shapes::sheet(9, 7);
  for (Vec3& p : mesh.positions) p = {p.x * 0.375, p.y, 1000 + 0.125 * p.x * p.y};
  const SurfaceModel model = modelOf(mesh);
  const auto rounded = roundedSurface(model.mt, 0);
  ASSERT_TRUE(rounded);
  EXPECT_EQ(rounded->step, 0.125);
  EXPECT_EQ(rounded->moved, 0);
}

TEST(RoundedSurface, FindsNoStepWhereItWouldTakeMoreBitsThanTheNumbersHave) {
  TriangleMesh mesh = shapes::globe(12, 7);
  EXPECT_EQ(roundedSurface(modelOf(mesh).mt, 0)->step, 0);
  // A zero below zero would lose its sign.
  mesh = shapes::sheet(5, 5);
  mesh.positions[3].z = -0.0;
  const SurfaceModel model = modelOf(mesh);
  EXPECT_EQ(roundedSurface(model.mt, 0)->step, 0);
}

TEST(RoundedSurface, HasAsManyStepsAsItsBitsAllowAndErrorsThatGrowByTwiceTheMove) {
  for (const double offset : {0.0, 1e6, -3e9})
    for (const int bits : {8, 11, 16, 24}) {
      TriangleMesh mesh = shapes::shaken(shapes::globe(20, 9), 3, 0.02);
      for (Vec3& p : mesh.positions) p = p + Vec3{offset, 0, -offset / 7};
      const SurfaceModel model = modelOf(mesh);
      const auto rounded = roundedSurface(model.mt, bits);
      ASSERT_TRUE(rounded);
      if (offset == -3e9 && bits == 24) {  // the places have no bits that fine
        EXPECT_EQ(rounded->moved, 0);
        continue;
      }
      const VertexArrays &before = model.mt.vertices(), &after = rounded->mt.vertices();
      Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high = -low;
      double moved = 0;
      for (std::uint32_t v = 0; v < before.size(); ++v) {
        const Vec3 p = after.place(VertexId(v));
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
        moved = std::max(moved, norm(p - before.place(VertexId(v))));
        for (const double x : {p.x, p.y, p.z}) EXPECT_EQ(std::fmod(x, rounded->step), 0);
      }
      const double steps = std::max({high.x - low.x, high.y - low.y, high.z - low.z}) / rounded->step;
      EXPECT_LT(steps, std::ldexp(1, bits));
      EXPECT_GE(steps, std::ldexp(1, bits - 1) - 3);
      EXPECT_GE(rounded->moved, moved);
      EXPECT_LE(rounded->moved, moved * (1 + 1e-12));
      const MtArrays &a = model.mt.arrays(), &b = rounded->mt.arrays();
      for (std::size_t t = 0; t < a.error.size(); ++t) {
        const double was = a.scale.decode(a.error[t]), is = b.scale.decode(b.error[t]);
        EXPECT_GE(is, was + 2 * rounded->moved);
        EXPECT_LE(is, (was + 2 * rounded->moved) * 1.009);
        EXPECT_GE(b.scale.decode(b.columns.of(kRms)[t]),
                  a.scale.decode(a.columns.of(kRms)[t]) + 2 * rounded->moved);
      }
    }
}

TEST(RoundedSurface, RefusesBitsOutOfRange) {
  const SurfaceModel model = modelOf(shapes::globe(8, 4));
  for (const int bits : {-1, 7, 25}) EXPECT_FALSE(roundedSurface(model.mt, bits)) << bits;
}

}  // namespace
}  // namespace arete::packed

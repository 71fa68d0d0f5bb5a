// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/diagnosis/sizes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "surface/shapes.h"

namespace arete {
namespace {

TEST(Sizes, OfATetrahedronAreThoseOfTheFormula) {
  for (const Vec3& at : {Vec3{}, Vec3{1e6, -2e6, 3e5}}) {
    TriangleMesh mesh = shapes::tetrahedron(at);
    EXPECT_NEAR(areaOf(mesh), 1.5 + std::sqrt(3) / 2, 1e-9);
    EXPECT_NEAR(volumeOf(mesh), 1. / 6, 1e-9);
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
    EXPECT_NEAR(volumeOf(mesh), -1. / 6, 1e-9);
  }
  EXPECT_EQ(areaOf({}), 0);
  EXPECT_EQ(volumeOf({}), 0);
}

}  // namespace
}  // namespace arete

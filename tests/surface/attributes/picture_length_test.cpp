// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/attributes/picture_length.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "surface/shapes.h"

namespace arete {
namespace {

TEST(PictureLength, IsHowLongAUnitIsOnTheSurface) {
  SurfaceMesh mesh(shapes::sheet(10, 6));
  for (Vec3& p : mesh.positions) p.z = 0;
  Attribute coords{.name = "texcoord",
                   .meaning = AttributeMeaning::textureCoords,
                   .type = ScalarType::float64,
                   .components = 2};
  Attribute broken = coords;
  for (const Vec3& p : mesh.positions) {
    coords.append(std::array{p.x / 2, p.y / 8});
    // What is not finite says nothing.
    broken.append(std::array{p.x == 3 ? std::nan("") : p.x / 2, p.y / 8});
  }
  EXPECT_NEAR(lengthOfPictureUnit(mesh, coords, false), 4, 1e-12);
  EXPECT_NEAR(lengthOfPictureUnit(mesh, broken, false), 4, 1e-12);
}

TEST(PictureLength, IsNothingWithoutAreaInThePicture) {
  SurfaceMesh mesh(shapes::sheet(3, 3));
  Attribute coords{.name = "texcoord", .meaning = AttributeMeaning::textureCoords, .components = 2};
  for (const Vec3& p : mesh.positions) coords.append(std::array{p.x, p.x});
  EXPECT_EQ(lengthOfPictureUnit(mesh, coords, false), 0);
}

}  // namespace
}  // namespace arete

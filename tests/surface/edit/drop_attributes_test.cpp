// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/edit/drop_attributes.h"

#include <gtest/gtest.h>

#include <vector>

#include "surface/edit/joined_surface.h"

namespace arete {
namespace {

/// Two triangles on one edge, whose corners differ there in `seam` and agree in "smooth".
SurfaceMesh withSeam(std::string seam) {
  SurfaceMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.wedges = {{0, 1, 2}, {3, 4, 5}};
  mesh.wedgeCount = 6;
  Attribute differs{.name = std::move(seam), .type = ScalarType::float32}, agrees{.name = "smooth"};
  for (double value = 0; value < 6; ++value) differs.append(std::span(&value, 1));
  for (const double value : {0., 1., 2., 0., 2., 3.}) agrees.append(std::span(&value, 1));
  mesh.wedgeAttributes = {differs, agrees};
  mesh.vertexAttributes = {Attribute{.name = "weight"}};
  for (double value = 0; value < 4; ++value) mesh.vertexAttributes[0].append(std::span(&value, 1));
  mesh.objects = {"o"};
  mesh.objectOf = {0, 0};
  return mesh;
}

TEST(DropAttributes, LeavesOutByNameAndJoinsCorners) {
  SurfaceMesh mesh = withSeam("normal");
  EXPECT_EQ(countSeamEdges(mesh), 1u);
  ASSERT_TRUE(dropAttributes(mesh, std::vector<std::string>{"normal"}));
  EXPECT_TRUE(mesh.validate());
  EXPECT_EQ(countSeamEdges(mesh), 0u);
  EXPECT_EQ(droppableNames(mesh), (std::vector<std::string>{"weight", "smooth", "objects"}));
  ASSERT_TRUE(dropAttributes(mesh, std::vector<std::string>{"weight", "objects", "smooth"}));
  EXPECT_TRUE(droppableNames(mesh).empty());
  EXPECT_EQ(mesh.triangles.size(), 2u);
}

TEST(DropAttributes, NamesWhatThereIsWhereANameIsUnknown) {
  SurfaceMesh mesh = withSeam("texcoord");
  const Status refused = dropAttributes(mesh, std::vector<std::string>{"smooth", "nrm"});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::usage);
  EXPECT_EQ(refused.error().culprit, "nrm");
  EXPECT_NE(refused.error().message.find("weight, texcoord, smooth, objects"), std::string::npos)
      << refused.error().message;
  EXPECT_EQ(mesh.wedgeAttributes.size(), 2u) << "nothing is left out then";
  SurfaceMesh plain;
  EXPECT_NE(dropAttributes(plain, std::vector<std::string>{"materials"}).error().message.find("has none"),
            std::string::npos);
}

}  // namespace
}  // namespace arete

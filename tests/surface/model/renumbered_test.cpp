// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/model/renumbered.h"

#include <gtest/gtest.h>

#include <numeric>

#include "surface/builder/build.h"
#include "surface/shapes.h"

namespace arete {
namespace {

TEST(Renumbered, GivesWedgesTheOrderInWhichCornersNameThemAndKeepsTheirAttributes) {
  SurfaceMesh mesh(shapes::sheet(6, 5));
  Attribute texcoord{.name = "texcoord", .meaning = AttributeMeaning::textureCoords};
  const auto count = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {  // backwards, apart in two halves
    const std::uint32_t last = (t < mesh.triangles.size() / 2 ? 1 : 2) * count - 1;
    const auto& [i, j, k] = mesh.triangles[t];
    mesh.wedges.push_back({last - i, last - j, last - k});
  }
  mesh.wedgeCount = 2 * count;
  for (std::uint32_t w = 0; w < mesh.wedgeCount; ++w) texcoord.append(std::vector<double>{double(w)});
  mesh.wedgeAttributes = {texcoord};
  const Result<SurfaceModel> model = buildSurface(mesh);
  ASSERT_TRUE(model);
  ASSERT_TRUE(model->hasWedges());
  std::vector<std::uint32_t> vertices(model->mt.vertexCount()), triangles(model->mt.triangleIdCount());
  std::iota(vertices.begin(), vertices.end(), 0u);
  std::iota(triangles.begin(), triangles.end(), 0u);
  const SurfaceModel again = renumbered(*model, model->mt, vertices, triangles);
  ASSERT_TRUE(again.validate());
  EXPECT_EQ(again.vertexOf, model->vertexOf);
  std::uint32_t next = 0;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (const NodeId creator = again.mt.creator(TriangleId(t));
        creator.isValid() && again.mt.remover(TriangleId(t)) == creator)
      continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t is = again.wedgesOf[t][c], was = model->wedgesOf[t][c];
      EXPECT_LE(is, next);
      next = std::max(next, is + 1);
      EXPECT_EQ(again.attributes.wedgeAttributes[0].numbers(is),
                model->attributes.wedgeAttributes[0].numbers(was));
    }
  }
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/mesh/mend.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "io/query/mesh/facts.h"
#include "surface/families.h"

namespace arete {
namespace {

MeshInput inputOf(TriangleMesh mesh) {
  MeshInput input;
  input.file.mesh = SurfaceMesh(std::move(mesh));
  return input;
}

TEST(Mending, JoinsWhatIsNearAndSaysHowFarItMoved) {
  TriangleMesh mesh = shapes::globe(12, 7);
  // The first triangle gets corners of its own, a little off.
  for (std::uint32_t& corner : mesh.triangles[0]) {
    mesh.positions.push_back(mesh.positions[corner] + Vec3{1e-4, 0, 0});
    corner = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  }
  MeshInput input = inputOf(mesh);
  const auto mended = mendMesh(input, {.weld = 1e-3});
  ASSERT_TRUE(mended) << mended.error().describe();
  ASSERT_TRUE(mended->welded);
  EXPECT_EQ(mended->welded->vertices, 3u);
  EXPECT_LE(mended->welded->farthestMove, 1.01e-4);
  EXPECT_TRUE(mended->repaired.diagnosis.borders.empty());
  MeshInput open = inputOf(mesh);
  const auto left = mendMesh(open, {});
  ASSERT_TRUE(left);
  EXPECT_FALSE(left->welded);
  EXPECT_FALSE(left->repaired.diagnosis.borders.empty());
}

TEST(Mending, KeepsErrorsThatStillHoldAndLeavesOutTheOthers) {
  TriangleMesh mesh = shapes::globe(12, 7);
  mesh.triangles.push_back(mesh.triangles[4]);
  MeshInput input = inputOf(mesh);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) input.file.triangleErrors.push_back(float(t));
  MeshInput holed = input;
  holed.file.mesh.triangles.erase(holed.file.mesh.triangles.begin());
  holed.file.triangleErrors.pop_back();
  ASSERT_TRUE(mendMesh(input, {}));
  EXPECT_EQ(input.file.triangleErrors.size(), mesh.triangles.size() - 1);
  EXPECT_EQ(input.file.triangleErrors[4], 4);
  const auto filled = mendMesh(holed, {.repair = {.mostHoleEdges = 3}});
  ASSERT_TRUE(filled);
  EXPECT_EQ(mendJson(*filled, 0)["mended"]["filledHoles"], 1);
  EXPECT_TRUE(holed.file.triangleErrors.empty());
  ASSERT_EQ(holed.file.warnings.size(), 1u);
  EXPECT_EQ(holed.file.warnings[0].code, WarningCode::omitted);
}

TEST(MeshFacts, OfASolidHaveItsVolumeAndOfASheetNone) {
  const auto ball = meshFactsOf(SurfaceMesh(shapes::globe(48, 24)), {});
  ASSERT_TRUE(ball);
  ASSERT_TRUE(ball->volume);
  EXPECT_NEAR(*ball->volume, 4.18879, 0.05);
  const auto sheet = meshFactsOf(SurfaceMesh(shapes::hills(9, 3)), {});
  ASSERT_TRUE(sheet);
  EXPECT_FALSE(sheet->volume);
}

}  // namespace
}  // namespace arete

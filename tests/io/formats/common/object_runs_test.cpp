// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/common/object_runs.h"

#include <gtest/gtest.h>

namespace arete {
namespace {

constexpr std::uint32_t kNone = MeshAttributes::kNone;

SurfaceMesh meshOf(std::size_t objects, const std::vector<std::uint32_t>& objectOf, std::size_t triangles) {
  SurfaceMesh mesh;
  mesh.positions.resize(3);
  mesh.triangles.resize(triangles, {0, 1, 2});
  mesh.objects.resize(objects);
  mesh.objectOf = objectOf;
  return mesh;
}

std::vector<std::array<std::size_t, 3>> listOf(const ObjectRuns& runs) {
  std::vector<std::array<std::size_t, 3>> list;
  for (const ObjectRun& run : runs.runs) list.push_back({run.object, run.first, run.end});
  return list;
}
using List = std::vector<std::array<std::size_t, 3>>;

TEST(ObjectRuns, AreTheTrianglesInTheirOrder) {
  EXPECT_EQ(listOf(ObjectRuns(meshOf(0, {}, 4))), (List{{kNone, 0, 4}}));
  EXPECT_EQ(listOf(ObjectRuns(meshOf(0, {}, 0))), List{});
  EXPECT_EQ(listOf(ObjectRuns(meshOf(2, {}, 3))), (List{{kNone, 0, 3}, {0, 3, 3}, {1, 3, 3}}));
  const ObjectRuns plain(meshOf(4, {kNone, 1, 1, 2}, 4));
  EXPECT_EQ(listOf(plain), (List{{kNone, 0, 1}, {0, 1, 1}, {1, 1, 3}, {2, 3, 4}, {3, 4, 4}}));
  EXPECT_FALSE(plain.areDivided || plain.isAnyBehind);
  const ObjectRuns divided(meshOf(2, {1, 0, 1, kNone}, 4));
  EXPECT_EQ(listOf(divided), (List{{1, 0, 1}, {0, 1, 2}, {1, 2, 3}, {kNone, 3, 4}}));
  EXPECT_TRUE(divided.areDivided && divided.isAnyBehind);
}

TEST(ObjectRuns, NamesAreMadeToFitOneLine) {
  EXPECT_EQ(nameOnOneLine(" a  b\t"), "a  b");
  EXPECT_EQ(nameOnOneLine("a \r\n b"), "a b");
  EXPECT_EQ(nameOnOneLine(" \n "), "");
}

}  // namespace
}  // namespace arete

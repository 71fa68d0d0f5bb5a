// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/triangulation/finest_raster.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "datasets/families.h"
#include "engine/cut/cut.h"
#include "engine/ids_of.h"
#include "terrain/builder/build.h"
#include "terrain/laws/validate_model.h"

namespace arete {
namespace {

using test::idsBelow;

TEST(FinestRaster, SplitsWholeCellsFromUpperLeftToLowerRightAndKeepsHalfCells) {
  RasterHeightfield field;
  field.columns = field.rows = 2;
  const double none = std::nan("");
  using Triangles = std::vector<std::array<std::uint32_t, 3>>;
  field.heights = {1, 2, 3, 4};
  EXPECT_EQ(finestTriangulation(field), (Triangles{{0, 1, 3}, {0, 3, 2}}));
  field.heights = {none, 2, 3, 4};
  EXPECT_EQ(finestTriangulation(field), (Triangles{{1, 3, 2}}));
  field.heights = {1, none, 3, 4};
  EXPECT_EQ(finestTriangulation(field), (Triangles{{0, 3, 2}}));
  field.heights = {1, 2, none, 4};
  EXPECT_EQ(finestTriangulation(field), (Triangles{{0, 1, 3}}));
  field.heights = {1, 2, 3, none};
  EXPECT_EQ(finestTriangulation(field), (Triangles{{0, 1, 2}}));
  field.heights = {1, none, none, 4};
  EXPECT_TRUE(finestTriangulation(field).empty());
}

TEST(FinestRaster, IsTheSameAsAMeshThatLooksForItsNeighbours) {
  for (const RasterFamily& family : rasterFamilies())
    for (const auto& [columns, rows] : {std::pair{2u, 2u}, {37u, 29u}, {33u, 70u}}) {
      const RasterHeightfield field = family.make(columns, rows, 5);
      std::vector<VertexId> pinched, pinchedOfSearch;
      const LiveMesh mesh = finestMesh(field, pinched);
      const LiveMesh searched = LiveMesh::fromTriangles(
          finestTriangulation(field), static_cast<std::uint32_t>(field.size()), pinchedOfSearch);
      ASSERT_EQ(mesh.triangles.size(), searched.triangles.size()) << family.name;
      for (const SlotId t : idsBelow<SlotId>(mesh.triangles.size())) {
        EXPECT_EQ(mesh.triangles[t].corners, searched.triangles[t].corners) << family.name;
        EXPECT_EQ(mesh.triangles[t].twin, searched.triangles[t].twin) << family.name;
        EXPECT_EQ(mesh.triangles[t].recorderId, RecorderId(t.index()));
      }
      std::sort(pinched.begin(), pinched.end());
      std::sort(pinchedOfSearch.begin(), pinchedOfSearch.end());
      EXPECT_EQ(pinched, pinchedOfSearch) << family.name;
      for (const VertexId v : idsBelow<VertexId>(field.size())) {
        const HalfedgeId h = mesh.vertexHalfedge[v], other = searched.vertexHalfedge[v];
        ASSERT_EQ(h.isValid(), other.isValid()) << family.name;
        if (!h.isValid()) continue;
        EXPECT_EQ(mesh.origin(h), v);
        EXPECT_EQ(mesh.twinOf(h).isValid(), searched.twinOf(other).isValid()) << family.name;
      }
    }
}

TEST(FinestRaster, FollowsTheGroundAtEveryScale) {
  // Stretches of all lengths are about as wide as they are high; of rows of tiles they would be strips.
  for (const auto& [columns, rows] : {std::pair{513u, 513u}, {700u, 300u}}) {
    RasterHeightfield field;
    field.columns = columns;
    field.rows = rows;
    field.heights.assign(std::size_t(columns) * rows, 0.0);
    const auto triangles = finestTriangulation(field);
    for (std::size_t length = 2 * 32 * 32; length <= triangles.size() / 4; length *= 4) {
      std::size_t stretches = 0;
      double squares = 0;  // around them
      for (std::size_t begin = 0; begin + length <= triangles.size(); begin += length, ++stretches) {
        std::uint32_t left = columns, right = 0, top = rows, bottom = 0;
        for (std::size_t t = begin; t < begin + length; ++t)
          for (const std::uint32_t v : triangles[t]) {
            left = std::min(left, v % columns);
            right = std::max(right, v % columns);
            top = std::min(top, v / columns);
            bottom = std::max(bottom, v / columns);
          }
        const double side = std::max(right - left, bottom - top);
        squares += side * side;
      }
      EXPECT_LT(squares / double(stretches), 4 * double(length) / 2)
          << columns << " x " << rows << ": " << length;
    }
  }
}

TEST(FinestRaster, IsDelaunayUpToCocircularTiesByCgalsPredicates) {
  // The layout is the finest front of a model; validateDelaunayFront asks CGAL about every triangle and edge.
  for (const RasterFamily& family : rasterFamilies()) {
    const auto model = build(family.make(37, 29, 6));
    ASSERT_TRUE(model) << family.name;
    const Cut finest = frontOfPrefix(model->mt, model->mt.nodeCount());
    const Status status = validateDelaunayFront(*model, finest);
    EXPECT_TRUE(status) << family.name << ": " << status.error().message;
    EXPECT_EQ(finest.triangles.size(), finestTriangulation(family.make(37, 29, 6)).size());
  }
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Batches against a set of triangles from which stars are taken and to which fans are added.
#include "engine/simplify/removal_batch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <set>
#include <vector>

#include "engine/grid_meshes.h"
#include "engine/parallel/loop_threads.h"

namespace arete {
namespace {

/// The corners from the lowest one on.
LiveMesh::Corners turned(LiveMesh::Corners corners) {
  std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
  return corners;
}

std::set<LiveMesh::Corners> liveTrianglesOf(const LiveMesh& mesh) {
  std::set<LiveMesh::Corners> live;
  for (const LiveMesh::Triangle& t : mesh.triangles)
    if (!t.isDead()) live.insert(turned(t.corners));
  return live;
}

/// A mesh, all that a batch works on, and the triangles that it ought to have.
struct Shrinking {
  std::vector<VertexId> pinched;
  LiveMesh mesh;
  MtRecorder recorder;
  ThresholdList thresholds;
  std::atomic<std::size_t> liveTriangles;
  RemovalBatch batch;
  std::set<LiveMesh::Corners> expected;
  std::uint32_t removals = 0;
  std::vector<VertexId> removed;  // by the last batch

  Shrinking(std::uint32_t columns, std::uint32_t rows, unsigned seed)
      : mesh(LiveMesh::fromTriangles(test::someTriangles(columns, rows, 0, seed), columns * rows, pinched)),
        recorder(static_cast<std::uint32_t>(mesh.triangles.size()), columns * rows, OutwardScale(1), {}),
        liveTriangles(mesh.triangles.size()),
        batch(mesh, recorder, thresholds, liveTriangles, nullptr),
        expected(liveTrianglesOf(mesh)) {
    const std::vector<std::uint8_t> isFixed(mesh.vertexCount(), 0);
    thresholds.assign(mesh.verticesInOrder(), isFixed);
  }

  /// Removes vertices, on all threads.
  void remove(std::size_t most, std::uint32_t group, unsigned seed) {
    removed = test::someIndependent(mesh, true, most, seed);
    std::vector<Star> stars(removed.size());
    std::vector<std::uint8_t> linkSizes;
    for (std::size_t i = 0; i < removed.size(); ++i) {
      ASSERT_TRUE(stars[i].gather(mesh, removed[i], kMaxHoleCorners));
      linkSizes.push_back(static_cast<std::uint8_t>(stars[i].linkSize));
      expect(removed[i], stars[i]);
    }
    batch.begin({group, 0}, linkSizes);
    forRanges(LoopThreads::all, removed.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i) {
        const HoleTriangulation floor = test::fan(stars[i].linkSize);
        batch.setOpen(i, stars[i].isOpen);
        refill(mesh, stars[i], floor, FloorJoins(floor), recorder.firstFloorTriangle(batch.removal(i)),
               batch.removal(i), batch.seams(i));
        mesh.vertexHalfedge[removed[i]] = HalfedgeId();
      }
    });
    batch.end(removed);
    for (std::size_t i = 0; i < removed.size(); ++i) {
      EXPECT_EQ(batch.removal(i), RemovalId(removals++)) << "in the order in which they were announced";
      EXPECT_EQ(batch.seams(i).size(), linkSizes[i]);
      EXPECT_EQ(batch.isOpen(i), stars[i].isOpen);
    }
  }

 private:
  void expect(VertexId v, const Star& star) {
    std::erase_if(expected,
                  [&](const LiveMesh::Corners& corners) { return std::ranges::count(corners, v) != 0; });
    for (int m = 1; m + 1 < star.linkSize; ++m)
      expected.insert(turned({star.link[0], star.link[m], star.link[m + 1]}));
  }
};

TEST(RemovalBatch, LeavesTheFansOfAllRemovalsJoinedToTheirNeighbours) {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    SCOPED_TRACE(seed);
    Shrinking shrinking(15, 11, seed);
    std::size_t open = 0, closed = 0;
    for (std::uint32_t group = 1; group <= 4; ++group) {
      const std::size_t before = shrinking.thresholds.size();
      ASSERT_NO_FATAL_FAILURE(shrinking.remove(group == 2 ? 1 : 100, group, seed + group));
      ASSERT_FALSE(shrinking.removed.empty());
      for (std::size_t i = 0; i < shrinking.removed.size(); ++i)
        ++(shrinking.batch.isOpen(i) ? open : closed);
      EXPECT_EQ(liveTrianglesOf(shrinking.mesh), shrinking.expected);
      ASSERT_NO_FATAL_FAILURE(test::expectConsistent(shrinking.mesh));
      EXPECT_EQ(shrinking.liveTriangles, shrinking.expected.size());

      EXPECT_EQ(shrinking.thresholds.size(), before - shrinking.removed.size());
      std::vector<VertexId> due;
      ThresholdList::Scratch scratch;
      shrinking.thresholds.collect(0, due, scratch);
      EXPECT_EQ(due.size(), shrinking.thresholds.size());
      for (const VertexId v : due) EXPECT_TRUE(shrinking.mesh.isInTriangle(v)) << v.index();
    }
    EXPECT_GT(open, 3u);
    EXPECT_GT(closed, 10u);
  }
}

}  // namespace
}  // namespace arete

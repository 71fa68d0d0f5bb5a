// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/simplify/removal.h"

#include <gtest/gtest.h>

#include <array>

#include "engine/ids_of.h"
#include "terrain/simplify/cost.h"
#include "terrain/simplify_fixture.h"

namespace arete {
namespace {

using test::idsOf;

/// Removes v and joins its floor; returns its link.
std::set<VertexId> removeAlone(SmallSimplification& small, VertexId v, bool isFloorKept) {
  Star star;
  MeasuredFloor floor;
  const RemovalCost<LatticePlan, RasterError> cost(small.state);
  cost.evaluate(v, star, SmallSimplification::kRange, small.state.records[v], floor);
  EXPECT_EQ(small.state.records[v].state, RemovalRecord::State::exact);
  if (!isFloorKept) floor.clear();
  const std::array<std::uint8_t, 1> size{static_cast<std::uint8_t>(star.linkSize)};
  const RemovalId removal = small.recorder.beginBatch({v.index(), 0}, size);
  std::array<Seam, kMaxHoleCorners> seams;
  const std::span<Seam> own(seams.data(), std::size_t(star.linkSize));
  VertexRemover<LatticePlan, RasterError>(small.state).remove(v, star, floor, removal, own);
  for (const Seam& seam : own) sewAlone(small.mesh, seam);
  return {star.linkView().begin(), star.linkView().end()};
}

TEST(VertexRemover, LeavesAWholeMeshAndUpdatesTheLink) {
  for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent})
    for (const bool isFloorKept : {false, true}) {
      if (shape == HoleShape::dataDependent && isFloorKept) continue;  // its cost keeps no floor
      SmallSimplification small(9, 8, 1, shape);
      std::size_t removed = 0;
      for (const VertexId v : idsOf<VertexId>({20, 41, 30, 3})) {  // inside, then on the upper border
        const std::set<VertexId> expected = small.linkOf(v);
        EXPECT_EQ(removeAlone(small, v, isFloorKept), expected);
        ++removed;
        EXPECT_TRUE(small.isWhole()) << v.index();
        EXPECT_FALSE(small.mesh.isInTriangle(v));
        EXPECT_EQ(small.verticesLeft().size(), small.field.size() - removed);
        for (const VertexId u : expected) EXPECT_EQ(small.state.records[u].isTouched, 1) << u.index();
      }
      std::size_t touched = 0, dead = 0;
      for (const RemovalRecord& record : small.state.records) touched += record.isTouched;
      EXPECT_LT(touched, small.field.size() / 2) << "others are as they were";
      for (const auto& t : small.mesh.triangles) dead += t.isDead() ? 1 : 0;
      EXPECT_EQ(dead, 2u * 3 + 1) << "two slots a removal, one on the border";
    }
}

TEST(VertexRemover, RecordsErrorsOfTheFloorThatAreRoundedOutwards) {
  SmallSimplification small(9, 8, 2, HoleShape::delaunay);
  for (const VertexId v : idsOf<VertexId>({20, 41, 30, 31})) removeAlone(small, v, false);
  int checked = 0;
  for (const auto& t : small.mesh.triangles) {
    if (t.isDead() || !t.creator.isValid()) continue;
    const double plain = small.plainError(t.corners[0], t.corners[1], t.corners[2]);
    const double stored = small.recorder.scale().decode(small.recorder.codes(t.recorderId).error);
    EXPECT_GE(stored, plain - 1e-9);
    EXPECT_LE(stored, plain * 1.002 + small.recorder.scale().decode(1));
    ++checked;
  }
  EXPECT_GT(checked, 8);
}

}  // namespace
}  // namespace arete

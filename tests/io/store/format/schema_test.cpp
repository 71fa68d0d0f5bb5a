// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/format/schema.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "io/amt_fixture.h"
#include "io/store/format/metadata.h"
#include "io/store/format/surface_metadata.h"

namespace arete {
namespace {

using test::tinyModel;

/// All facts that decide which columns a file has.
std::vector<AmtFacts> families(bool isPacked) {
  std::vector<AmtFacts> all;
  for (unsigned bits = 0; bits < 64; ++bits)
    for (const auto heights :
         {HeightEncoding::Type::int16, HeightEncoding::Type::float32, HeightEncoding::Type::float64}) {
      AmtFacts facts;
      facts.counts = {.rootVertices = 4, .rootTriangles = 2, .nodes = 2, .slots = 7};
      facts.isLattice = (bits & 1) != 0;
      facts.hasDoubles = (bits & 2) != 0;
      facts.hasAllFaces = (bits & 4) != 0;
      facts.hasWedges = (bits & 8) != 0;
      facts.hasDisplacement = (bits & 16) != 0;
      if ((bits & 32) != 0) facts.segments = 3;
      facts.heights = heights;
      facts.isPacked = isPacked;
      all.push_back(facts);
    }
  return all;
}

template <class Model>
std::string tagsOf(const AmtFacts& facts) {
  std::string tags;
  for (const AmtRow<Model>& row : kAmtSchema<Model>)
    if (row.isIn(facts)) tags += std::string(row.name()) + " ";
  return tags;
}

template <class Model>
void expectEveryTagOnce(bool isPacked) {
  for (const AmtFacts& facts : families(isPacked)) {
    std::set<AmtTag> tags;
    for (const AmtRow<Model>& row : kAmtSchema<Model>)
      if (row.isIn(facts)) {
        EXPECT_TRUE(tags.insert(row.tag).second) << row.name();
      }
    EXPECT_EQ(tags.count(amt_tag::kPackedNodes), isPacked ? 1u : 0u);
  }
}

TEST(Schema, CallsForEveryChunkOnce) {
  for (const bool isPacked : {false, true}) {
    expectEveryTagOnce<TerrainModel>(isPacked);
    expectEveryTagOnce<SurfaceModel>(isPacked);
  }
}

TEST(Schema, ListsTheChunksInTheOrderOfTheFile) {
  AmtFacts facts;
  facts.isLattice = true;
  EXPECT_EQ(
      tagsOf<TerrainModel>(facts),
      "META RTRI SLOT LINK RMVR ERRR BLOW ABOV FLOR SERR SPHR BERR BSPH HINT SAMP HGHT ISAM IHGT FIXV ");
  facts.isLattice = false;
  EXPECT_EQ(
      tagsOf<TerrainModel>(facts),
      "META RTRI SLOT LINK RMVR ERRR BLOW ABOV FLOR SERR SPHR BERR BSPH HINT PLAN HGHT ISAM IHGT FIXV ");
  facts.segments = 1;
  facts.hasWedges = facts.hasDisplacement = true;
  EXPECT_EQ(tagsOf<SurfaceModel>(facts),
            "META RTRI SLOT LINK RMVR ERRR RMSE FLOR SERR SPHR BERR BSPH HINT SURF VNUM FNUM WEDG DIRS REAC "
            "LOOK ATTR PICT AERR LEFT PSUM ");
  facts.isPacked = true;
  facts.segments.reset();
  EXPECT_EQ(tagsOf<TerrainModel>(facts), "META PDIR PTAB PNOD ISAM IHGT FIXV ");
  EXPECT_EQ(tagsOf<SurfaceModel>(facts), "META PDIR PTAB PNOD PNUM PDSP LOOK ATTR PICT AERR LEFT ");
  facts.isPaged = true;
  EXPECT_EQ(tagsOf<TerrainModel>(facts), "META PAGE PTAB ISAM IHGT FIXV PBLK PNOD ");
}

TEST(Schema, KnowsTheTypeAndTheNumberOfTheElements) {
  const AmtFacts facts = amtFactsOf(amtMetadataOf(tinyModel(), "x"));
  for (const AmtShape& shape : amtShapes<TerrainModel>(facts))
    if (shape.tag == amt_tag::kFloor) {
      EXPECT_EQ(shape.count, 3u);
      EXPECT_EQ(shape.elementBytes, 4u);
    } else if (shape.tag == amt_tag::kHeights) {
      EXPECT_EQ(shape.elementBytes, 2u);
      EXPECT_EQ(shape.scalar, AmtScalar::i16);
      EXPECT_EQ(shape.count, 6u);
    } else if (shape.tag == amt_tag::kSphere) {
      EXPECT_EQ(shape.elementBytes, 16u);
      EXPECT_EQ(shape.scalar, AmtScalar::f32);
    }
}

TEST(Schema, FindsTheArraysOfAModelAtTheSizesThatItStates) {
  const TerrainModel model = tinyModel();
  const AmtFacts facts = amtFactsOf(amtMetadataOf(model, "x"));
  std::size_t columns = 0;
  for (const AmtMtColumn& column : amtMtColumns(model.mt.arrays())) {
    EXPECT_EQ(column.mt.bytes(model.mt.arrays()).size(),
              amtCountOf(column.per, facts) * column.elementBytes())
        << column.name();
    ++columns;
  }
  EXPECT_EQ(columns, 15u);
}

TEST(Schema, PutsAnArrayWhereItWasTaken) {
  const TerrainModel model = tinyModel();
  MtArrays empty;
  for (const AmtMtColumn& column : amtMtColumns(model.mt.arrays()))
    column.mt.put(empty, column.mt.bytes(model.mt.arrays()));
  for (const AmtMtColumn& column : amtMtColumns(model.mt.arrays())) {
    EXPECT_EQ(column.mt.bytes(empty).data(), column.mt.bytes(model.mt.arrays()).data()) << column.name();
    EXPECT_EQ(column.mt.bytes(empty).size(), column.mt.bytes(model.mt.arrays()).size()) << column.name();
  }
}

TEST(Schema, KnowsTheTagsOfBothKindsAndNoOther) {
  EXPECT_NE(findAmtColumn(amt_tag::kBelow), nullptr);
  EXPECT_NE(findAmtColumn(amt_tag::kRms), nullptr);
  EXPECT_NE(findAmtColumn(amt_tag::kSegmentChecksums), nullptr);
  EXPECT_EQ(findAmtColumn(AmtTag{'W', 'H', 'A', 'T'}), nullptr);
}

TEST(Schema, NamesWhatAColumnIsPerAndHowItIsPacked) {
  EXPECT_EQ(toString(AmtPer::rootTriangle), "root triangle");
  EXPECT_EQ(toString(AmtPer::any), "any");
  EXPECT_EQ(toString(AmtCoding::raw), "raw");
  EXPECT_EQ(toString(AmtCoding::packed), "packed");
}

TEST(Schema, NeedsTheVersionOfTheNewestColumnThatAFileHas) {
  AmtFacts facts;
  EXPECT_EQ(amtVersionOf<TerrainModel>(facts), 2u);
  EXPECT_EQ(amtVersionOf<SurfaceModel>(facts), 3u);
  facts.isPacked = true;
  EXPECT_EQ(amtVersionOf<TerrainModel>(facts), 2u);
  facts.isPaged = true;
  EXPECT_EQ(amtVersionOf<TerrainModel>(facts), 3u);
}

}  // namespace
}  // namespace arete

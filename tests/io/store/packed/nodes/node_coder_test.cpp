// SPDX-License-Identifier: GPL-3.0-or-later
//
// The coder of nodes on the tiny model: a side that knows the model records the symbols, and a side that
// knows nothing grows the same model of them.
#include "io/store/packed/nodes/node_coder.h"

#include <gtest/gtest.h>

#include "io/store/packed/heightfield/form.h"
#include "io/store/packed/tiny_io.h"

namespace arete::packed {
namespace {

class NodeCoderTest : public ::testing::Test {
 protected:
  NodeCoderTest() : model_(arete::test::tinyModel()), directory_(test::tinyDirectory(model_)) {}

  /// Codes root and nodes. Returns the problem; empty if there is none.
  template <class Io>
  std::string code(Arrays& arrays, Io& io) {
    if (!codeRoot<HeightfieldForm<float>>(arrays, io)) return "root";
    CoderSpace space;
    NodeCoder<HeightfieldForm<float>, Io> coder(arrays, directory_, directory_.packets[0], io, space);
    return coder.run() ? std::string() : coder.problem();
  }

  test::Recording recorded() {
    Arrays arrays;
    test::allocateTiny(arrays, model_);
    test::fillRoot(arrays, model_);
    test::KnowingIo io(model_);
    EXPECT_EQ(code(arrays, io), "");
    return io.recording;
  }

  TerrainModel model_;
  Directory directory_;
};

TEST_F(NodeCoderTest, GrowsTheModelOfItsSymbolsAlone) {
  ASSERT_EQ(directory_.packets[0].runs[0].band, directory_.packets[0].runs[1].band + 1);
  Arrays arrays;
  test::allocateTiny(arrays, model_);
  test::ReplayingIo io(recorded());
  ASSERT_EQ(code(arrays, io), "");
  EXPECT_TRUE(io.isAtEnd());
  const MtArrays& a = model_.mt.arrays();
  for (std::uint32_t t = 0; t < 2; ++t) EXPECT_EQ(arrays.rootTriangles[t], a.rootTriangles[t]);
  for (std::uint32_t s = 0; s < 7; ++s) EXPECT_EQ(arrays.link[s], a.link[s]) << s;
  for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(arrays.floor[i], a.floor[i]) << i;
  for (std::uint32_t v = 0; v < 6; ++v) {
    EXPECT_EQ(arrays.samples[v], a.vertices.samples[v]) << v;
    EXPECT_EQ(arrays.height(v), rawHeight(arrays.encoding.type, a.vertices.rawHeights.data(), v)) << v;
  }
  EXPECT_EQ(arrays.slotBegin[1], 4u);
  EXPECT_EQ(arrays.starSize(0), 4u);
  EXPECT_FALSE(arrays.isOpen(0));
  EXPECT_TRUE(arrays.isOpen(1));
  for (const std::uint32_t t : {0u, 1u, 2u, 8u}) EXPECT_EQ(arrays.remover[t], a.remover[t]) << t;
  for (const std::uint32_t t : {0u, 1u, 2u}) {
    EXPECT_EQ(arrays.error[t], a.error[t]) << t;
    EXPECT_GE(arrays.below[t], a.columns.of(kBelow)[t]) << t;
    EXPECT_GE(arrays.above[t], a.columns.of(kAbove)[t]) << t;
  }
  EXPECT_EQ(arrays.saturatedError[0], std::max(a.error[0], a.error[1]));
  EXPECT_EQ(arrays.saturatedError[1], a.error[2]);
}

TEST_F(NodeCoderTest, RefusesAShapeThatDoesNotExist) {
  test::Recording recording = recorded();
  for (auto& [stream, table, symbol] : recording.symbols)
    if (stream == kFloorStream && (table == kShapeTable || table == kShapeTable + 1))
      symbol = kWalkedShape + 1;
  Arrays arrays;
  test::allocateTiny(arrays, model_);
  test::ReplayingIo io(recording);
  EXPECT_EQ(code(arrays, io), "has an invalid floor");
}

TEST_F(NodeCoderTest, RefusesAFloorWithNothingAcrossAnInnerEdge) {
  test::Recording recording = recorded();
  // Inner edge 0 in the place of edge 2: on the border of the root.
  for (auto& [stream, table, symbol] : recording.symbols)
    if (stream == kFloorStream && table == kShapeTable + 1) symbol = shapeSymbol(0b001, 2);
  Arrays arrays;
  test::allocateTiny(arrays, model_);
  test::ReplayingIo io(recording);
  EXPECT_EQ(code(arrays, io), "has an invalid floor");
}

TEST_F(NodeCoderTest, RefusesRunsWithOtherNumbersOfNodesOrSlots) {
  const test::Recording recording = recorded();
  const auto problemWith = [&](const auto& change) {
    directory_ = test::tinyDirectory(model_);
    change(directory_.packets[0]);
    directory_.number();
    Arrays arrays;
    test::allocateTiny(arrays, model_);
    test::ReplayingIo io(recording);
    return code(arrays, io);
  };
  EXPECT_EQ(problemWith([](Packet& p) { p.runs[0].slots = 5; }),
            "has another number of nodes or slots than announced");
  EXPECT_EQ(problemWith([](Packet& p) { p.runs[0].slots = 3; }), "has more slots than announced");
  EXPECT_EQ(problemWith([](Packet& p) { p.borders = 1; }),
            "leaves another number of triangles than announced");
}

}  // namespace
}  // namespace arete::packed

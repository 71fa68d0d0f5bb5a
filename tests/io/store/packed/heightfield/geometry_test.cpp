// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/packed/heightfield/geometry.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/store/packed/heightfield/form.h"
#include "io/store/packed/nodes/root.h"
#include "io/store/packed/tiny_io.h"

namespace arete::packed {
namespace {

/// Node 0 of the tiny model, whose star is known and whose vertex is not.
class GeometryTest : public ::testing::Test {
 protected:
  GeometryTest() : model_(arete::test::tinyModel()), io_(model_) {
    test::allocateTiny(arrays_, model_);
    test::fillRoot(arrays_, model_);
    if (!codeRoot<HeightfieldForm<float>>(arrays_, io_)) throw std::runtime_error("no root");
    arrays_.star[0] = 4;
    for (std::uint32_t i = 0; i < 4; ++i) arrays_.link[i] = i;
    run_.nodes = 1;
    run_.slots = 4;
  }

  bool code() {
    Geometry<float, test::KnowingIo> geometry(arrays_, io_);
    const Shape* const shape = &listedShapes()[shapeSymbol(0b100, 2)];
    return geometry.run(run_, 0, std::span(&shape, 1), areas_.data());
  }

  TerrainModel model_;
  Arrays arrays_;
  test::KnowingIo io_;
  packed::Run run_;
  std::array<std::uint8_t, 4> areas_{};
};

TEST_F(GeometryTest, PutsTheVertexWhereItIsAtItsHeight) {
  ASSERT_TRUE(code());
  EXPECT_EQ(arrays_.samples[4], 4u);
  EXPECT_EQ(arrays_.height(4), 25);
  EXPECT_EQ(arrays_.floatPlaces[4].x, 1);
  EXPECT_EQ(arrays_.floatPlaces[4].y, 1);
  EXPECT_EQ(arrays_.floatPlaces[4].z, 25);
  // The doubled areas of the star's triangles.
  EXPECT_EQ(areas_, (std::array<std::uint8_t, 4>{2, 2, 2, 2}));
}

TEST_F(GeometryTest, TakesOneSymbolForAPositionNearThePredictedOne) {
  io_.recording = {};
  ASSERT_TRUE(code());
  // Predicted is the centroid of the corners (0, 0), (2, 0), (2, 2), (0, 2), so dx and dy are 0.
  const auto [stream, table, symbol] = io_.recording.symbols.front();
  EXPECT_EQ(stream, kPlaceStream);
  EXPECT_EQ(table, kPlaceTable + placeClass(8, false));
  EXPECT_EQ(symbol, 3u * 7 + 3);
}

TEST_F(GeometryTest, EnclosesTheStarInABallWithANegativeRadius) {
  ASSERT_TRUE(code());
  const Sphere& ball = arrays_.sphere[0];
  ASSERT_LT(ball.radius, 0);
  for (std::uint32_t v = 0; v < 5; ++v) {
    const Vec3 p = arrays_.metric.toMetric(model_.mt.position(VertexId(v)));
    const double distance = std::hypot(p.x - double(ball.x), p.y - double(ball.y), p.z - double(ball.z));
    EXPECT_LE(distance, -double(ball.radius)) << v;
  }
}

TEST_F(GeometryTest, RefusesAVertexOutsideTheGrid) {
  for (const Vec2 offset : {Vec2{2, 0}, Vec2{-2, 0}, Vec2{0, 40}}) {
    io_.offset = offset;
    EXPECT_FALSE(code()) << offset.x << ", " << offset.y;
  }
}

TEST_F(GeometryTest, RefusesAMetricThatIsNotFinite) {
  arrays_.metric.scale.z = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(code());
}

}  // namespace
}  // namespace arete::packed

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The laws of a model are named when they are broken: those that ask for more than the multitriangulation
// itself. Of the others see tests/engine/laws/validate_test.cpp.
#include "terrain/laws/validate_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "datasets/families.h"
#include "engine/mt/node_blocks.h"
#include "engine/mt/saturated_balls.h"
#include "terrain/builder/build.h"

namespace arete {
namespace {

RasterHeightfield ground(std::uint32_t seed) {
  for (const RasterFamily& family : rasterFamilies())
    if (family.name == "fractal") return family.make(33, 27, seed);
  ADD_FAILURE() << "there is no fractal family";
  return {};
}

TerrainModel modelOf(const RasterHeightfield& field, const BuildOptions& options = {}) {
  auto model = build(field, options);
  EXPECT_TRUE(model) << model.error().describe();
  EXPECT_EQ(validateModel(*model).has_value(), true);
  return std::move(*model);
}

std::string violation(const TerrainModel& model) {
  const Status status = validateModel(model);
  return status ? "" : status.error().message.substr(0, 5);
}

/// A flat raster of 3 x 3 samples, made by hand from the two triangles of its corners: first comes the sample
/// in the middle, into one of them, on whose edge it stands.
struct FlatTriangle {
  std::vector<std::array<std::uint32_t, 3>> rootTriangles = {{0, 1, 2}, {0, 2, 3}};
  std::vector<std::uint32_t> samples = {0, 2, 8, 6, 4, 1, 5, 3, 7};
  std::vector<std::uint32_t> slotBegin = {0, 3, 7, 11, 14, 18}, creatorHint = {0};
  std::vector<std::uint32_t> link = {0, 2, 3, 1, 2, 4, 0, 2, 4, 5, 1, 0, 4, 3, 3, 7, 4, 2};
  std::vector<std::uint32_t> floor = {1, 0, 2, 5, 6, 4, 3, 14};
  std::vector<std::uint32_t> remover = std::vector<std::uint32_t>(20, MultiTriangulation::kNone);
  std::vector<std::uint16_t> codes = std::vector<std::uint16_t>(20, 0);
  std::vector<double> heights = std::vector<double>(9, 0);
  std::vector<Sphere> sphere;
  NodeBlocks blocks;

  FlatTriangle() {
    const std::array<std::uint32_t, 5> lastSlots = {2, 6, 10, 13, 17};
    for (std::uint32_t n = 0; n < 5; ++n) {
      for (std::uint32_t i = slotBegin[n] - 2 * n; i < slotBegin[n + 1] - 2 * (n + 1); ++i)
        remover[floor[i]] = n;
      if (n > 0) remover[2 + lastSlots[n]] = n;  // an open star's
    }
    const MultiTriangulation mt(arrays(), nullptr);
    sphere = saturatedBalls(mt, [&](std::uint32_t v) { return mt.position(VertexId(v)); });
    blocks = makeNodeBlocks(arrays().saturatedError, sphere);
  }

  MtArrays arrays() const {
    MtArrays a;
    a.rootVertices = 4;
    a.rootTriangles = rootTriangles;
    a.slotBegin = slotBegin;
    a.link = link;
    a.remover = remover;
    a.error = codes;
    a.columns.set(kBelow, a.error);
    a.columns.set(kAbove, a.error);
    a.floor = floor;
    a.saturatedError = std::span(codes).first(5);
    a.sphere = sphere;
    a.blockError = blocks.error;
    a.blockSphere = blocks.sphere;
    a.creatorHint = creatorHint;
    a.vertices.samples = samples;
    a.vertices.columns = 3;
    a.vertices.rawHeights = std::as_bytes(std::span(heights));
    return a;
  }
};

TEST(ValidateModel, NamesLaw5WhenATriangleHasNoAreaWhateverTheShape) {
  const auto flat = std::make_shared<FlatTriangle>();
  TerrainModel model;
  model.mt = MultiTriangulation(flat->arrays(), flat);
  model.columns = model.rows = 3;
  model.options.shape = HoleShape::dataDependent;
  const Status status = validateModel(model);
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().message, "law 5: triangle 2 has no positive area");
}

TEST(ValidateModel, NamesLaw7WhenAFixedVertexIsNotInTheRoot) {
  TerrainModel model = modelOf(ground(1));
  model.options.fixedVertices = {model.mt.vertices().samples.back()};
  EXPECT_EQ(violation(model), "law 7");
}

TEST(ValidateModel, NamesLaw8WhenASampleIsInNoTriangle) {
  RasterHeightfield field = ground(2);
  const std::uint32_t hole = field.index(16, 13);
  field.heights[hole] = std::nan("");
  TerrainModel model = modelOf(field);
  model.isolated.push_back({hole, 5});  // as if it had data
  EXPECT_EQ(violation(model), "law 8");
}

TEST(ValidateModel, NamesLaw9WhenAFrontIsNotDelaunay) {
  TerrainModel fidelity = modelOf(ground(3), {.shape = HoleShape::dataDependent});
  fidelity.options.shape = HoleShape::delaunay;
  EXPECT_EQ(violation(fidelity), "law 9");
  TerrainModel stretched = modelOf(ground(4));
  stretched.metricP = 5;
  EXPECT_EQ(violation(stretched), "law 9");
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The laws of a model are named when they are broken: those that ask for more than the multitriangulation
// itself. Of the others see tests/engine/validate_test.cpp.
#include "terrain/validate_model.h"

#include <gtest/gtest.h>

#include <cmath>

#include "datasets/families.h"
#include "terrain/build.h"

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
  TerrainModel fidelity = modelOf(ground(3), {.shape = HoleShape::fidelity});
  fidelity.options.shape = HoleShape::delaunay;
  EXPECT_EQ(violation(fidelity), "law 9");
  TerrainModel stretched = modelOf(ground(4));
  stretched.metricP = 5;
  EXPECT_EQ(violation(stretched), "law 9");
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/surface/material_finish.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace arete {
namespace {

Material mtl(const std::string& lines) {
  return Material{.name = "m", .verbatim = {{"mtl", lines}}};
}

TEST(MaterialFinish, OfGltfIsMetalAndRoughWhereNothingIsStated) {
  EXPECT_EQ(finishOf({}, true), (MaterialFinish{.metal = 1, .roughness = 1, .reflectance = 0.04f}));
  const MaterialFinish stated = finishOf(
      Material{
          .name = "m",
          .verbatim = {{"gltf", R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0.25}})"}}},
      true);
  EXPECT_EQ(stated.metal, 0);
  EXPECT_EQ(stated.roughness, 0.25f);
}

TEST(MaterialFinish, DamagedNumbersCountAsNotStatedAndLargeOnesAsTheMost) {
  const MaterialFinish finish = finishOf(
      Material{.name = "m",
               .verbatim = {{"gltf", R"({"pbrMetallicRoughness":{"metallicFactor":"x","roughnessFactor":7},)"
                                     R"("emissiveFactor":[1,2]})"}}},
      true);
  EXPECT_EQ(finish.metal, 1);
  EXPECT_EQ(finish.roughness, 1);
  EXPECT_EQ(finish.emission, glm::vec3(0));
  EXPECT_EQ(finishOf(Material{.name = "m", .verbatim = {{"gltf", "no json"}}}, true), finishOf({}, true));
}

TEST(MaterialFinish, OfAnMtlShinesByKsAndNsUnlessItsModelIsMatt) {
  EXPECT_EQ(finishOf({}, false), MaterialFinish{});
  EXPECT_EQ(finishOf(mtl("Ns 100"), false), MaterialFinish{});
  const MaterialFinish shiny = finishOf(mtl("Ka 1 1 1\nKs 0.5 0.5 0.5\nNs 98\nillum 2"), false);
  EXPECT_FLOAT_EQ(shiny.reflectance, 0.04f);
  EXPECT_FLOAT_EQ(shiny.roughness, float(std::sqrt(0.02)));
  EXPECT_EQ(finishOf(mtl("Ks 0.5 0.5 0.5\nNs 98\nillum 1"), false), MaterialFinish{});
}

TEST(MaterialFinish, OfAnMtlTakesMetalRoughnessAndEmissionWhereTheyAreStated) {
  const MaterialFinish finish = finishOf(mtl("Pm 0.5\nPr 0.3\nKs 1 1 1\nKe 0.1 0.2 0.3 # glows"), false);
  EXPECT_FLOAT_EQ(finish.metal, 0.5f);
  EXPECT_FLOAT_EQ(finish.roughness, 0.3f);
  EXPECT_FLOAT_EQ(finish.emission.y, 0.2f);
}

TEST(PictureLookup, ScalesTurnsAndMovesInThisOrder) {
  const TextureUse use{.role = "baseColor", .picture = "p.png"};
  const Material gltf{
      .name = "m",
      .verbatim = {{"gltf:baseColor", R"({"extensions":{"KHR_texture_transform":{"offset":[0.1,0.2],)"
                                      R"("rotation":1.5707963267948966,"scale":[2,3],"texCoord":1}}})"}}};
  const PictureLookup lookup = lookupOf(gltf, use);
  const glm::vec3 corner(0.5f, 0.25f, 1);
  // (0.5, 0.25) becomes (1, 0.75), turned (0.75, -1), moved (0.85, -0.8).
  EXPECT_NEAR(glm::dot(lookup.u, corner), 0.85, 1e-5);
  EXPECT_NEAR(glm::dot(lookup.v, corner), -0.8, 1e-5);
  EXPECT_EQ(lookup.textureCoords, 1u);
}

TEST(PictureLookup, OfAnMtlCountsVFromBelowAndClampsWhereItSays) {
  const TextureUse use{.role = "map_Kd", .picture = "p.png"};
  const PictureLookup lookup =
      lookupOf(Material{.name = "m", .verbatim = {{"mtl:map_Kd", "-s 2 3 1 -o 0.1 0.2 0 -clamp on"}}}, use);
  // From below (0.5, 0.25) becomes (1.1, 0.95); from above (0.5, 0.75) becomes (1.1, 0.05).
  const glm::vec3 corner(0.5f, 0.75f, 1);
  EXPECT_NEAR(glm::dot(lookup.u, corner), 1.1, 1e-5);
  EXPECT_NEAR(glm::dot(lookup.v, corner), 0.05, 1e-5);
  EXPECT_EQ(lookup.acrossU, PictureLookup::Wrap::clamp);
  EXPECT_EQ(lookup.acrossV, PictureLookup::Wrap::clamp);
}

TEST(PictureLookup, TakesTheFiltersOfTheSampler) {
  const TextureUse use{.role = "normal", .picture = "p.png"};
  const auto of = [&](const char* sampler) {
    return lookupOf(Material{.name = "m", .verbatim = {{"gltf:normal", sampler}}}, use);
  };
  EXPECT_EQ(of("{}"), PictureLookup{});
  const PictureLookup nearest = of(R"({"sampler":{"magFilter":9728,"minFilter":9728,"wrapT":33648}})");
  EXPECT_TRUE(nearest.isNearest && nearest.isNearestFar && !nearest.hasLevels);
  EXPECT_EQ(nearest.acrossV, PictureLookup::Wrap::mirror);
  EXPECT_TRUE(of(R"({"sampler":{"minFilter":9984}})").hasLevels);
}

}  // namespace
}  // namespace arete

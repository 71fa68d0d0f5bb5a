// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cstdint>
#include <string_view>

#include "surface/model/surface_mesh.h"

namespace arete {

/// How a material shines, as glTF's model of metal and roughness has it. Colours are linear.
struct MaterialFinish {
  float metal = 0, roughness = 1;
  float reflectance = 0;        ///< of light that falls straight on anything but metal; 0: it does not shine
  glm::vec3 emission{0};        ///< light of its own
  float normalScale = 1;        ///< of the slopes of its picture of normals
  float occlusion = 1;          ///< 0 to 1: how much its picture of occlusion counts
  bool isWithoutLight = false;  ///< its colour is shown as it is (KHR_materials_unlit)

  bool operator==(const MaterialFinish&) const = default;
};

/// Reads it from the statements of glTF or MTL that a material keeps. Of an MTL that states no metal or
/// roughness, Ns and Ks stand for them as for the importers of modelling programs; one without Ks, or of
/// "illum" 0 or 1, does not shine. Numbers that are damaged count as not stated.
///
/// @param isOfGltf whether what is not stated is as glTF has it: metal and rough. O(its statements).
MaterialFinish finishOf(const Material& material, bool isOfGltf);

/// How a material takes a picture: (u, v), v from the upper side, is looked up at `u`·(u, v, 1), `v`·(u, v,
/// 1).
struct PictureLookup {
  glm::vec3 u{1, 0, 0}, v{0, 1, 0};
  std::uint32_t textureCoords = 0;  ///< set of coordinates
  enum class Wrap { repeat, mirror, clamp };
  Wrap acrossU = Wrap::repeat, acrossV = Wrap::repeat;
  bool isNearest = false;     ///< magnified without interpolation
  bool isNearestFar = false;  ///< shrunk without interpolation
  bool hasLevels = true;      ///< shrunk from smaller copies of it

  bool operator==(const PictureLookup&) const = default;
};

/// By the sampler and KHR_texture_transform of glTF, or by -o, -s and -clamp of MTL. O(its statements).
PictureLookup lookupOf(const Material& material, const TextureUse& use);

/// The first of a material's textures of these roles, the first role first; nullptr: it has none.
const TextureUse* textureOfRole(const Material& material, std::initializer_list<std::string_view> roles);

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec4.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "engine/base/warning.h"
#include "surface/model/surface_model.h"
#include "viewer/gl/gl_objects.h"
#include "viewer/surface/material_finish.h"

namespace arete {

/// Of what no material is said: so that light and shade are seen on it.
inline constexpr glm::vec4 kUncolored{0.72f, 0.71f, 0.69f, 1};

/// A picture of a material, as shaders/surface.frag.glsl counts them.
struct DrawnPicture {
  enum Role : std::size_t { color, metalAndRoughness, normal, occlusion, emission, opacity, count };
  GLuint texture = 0;  ///< 0: none
  PictureLookup lookup;
};

/// What the painter needs of a material.
struct DrawnMaterial {
  enum class Alpha { opaque, masked, blended };
  glm::vec4 baseColor{1, 1, 1, 1};  ///< linear
  std::array<DrawnPicture, DrawnPicture::count> pictures{};
  MaterialFinish finish;
  Alpha alpha = Alpha::opaque;
  float alphaCutoff = 0.5f;
  bool isDoubleSided = false;
};

/// The materials of a surface, their pictures in graphics memory.
class MaterialsOnGpu {
 public:
  /// Pictures that cannot be shown are left out, with a warning. O(pixels).
  static MaterialsOnGpu load(const SurfaceModel& model);

  /// One for each material, and one more for triangles without any.
  const std::vector<DrawnMaterial>& materials() const { return materials_; }
  const Warnings& warnings() const { return warnings_; }

 private:
  std::vector<DrawnMaterial> materials_;
  std::vector<GlTexture> textures_;
  Warnings warnings_;
};

}  // namespace arete

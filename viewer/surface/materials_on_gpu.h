// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec4.hpp>

#include <string>
#include <vector>

#include "engine/base/warning.h"
#include "surface/model/surface_model.h"
#include "viewer/gl/gl_objects.h"

namespace arete {

/// What the painter needs of a material.
struct DrawnMaterial {
  enum class Alpha { opaque, masked, blended };
  glm::vec4 baseColor{1, 1, 1, 1};  ///< linear
  GLuint texture = 0;               ///< its colours; 0 = none
  std::uint32_t textureCoords = 0;  ///< set of coordinates, 0 or 1
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

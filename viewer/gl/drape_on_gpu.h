// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <glm/vec4.hpp>

#include "viewer/gl/gl_objects.h"

namespace arete {

/// A picture over the plan, in tiles of an array texture.
class DrapeOnGpu {
 public:
  /// (u, v) = plan * (first two) + (last two).
  glm::vec4 planToTexture() const { return planToTexture_; }
  /// Texture unit and the two uniforms of shaders/terrain.frag.glsl.
  void bind(GLuint program, GLuint unit, GLint gridLocation, GLint sizeLocation) const {
    glBindTextureUnit(unit, tiles_);
    glProgramUniform4f(program, gridLocation, grid_[0], grid_[1], grid_[2], grid_[3]);
    glProgramUniform2f(program, sizeLocation, size_[0], size_[1]);
  }

 private:
  GlTexture tiles_;
  glm::vec4 planToTexture_{}, grid_{};
  std::array<float, 2> size_{};
};

}  // namespace arete

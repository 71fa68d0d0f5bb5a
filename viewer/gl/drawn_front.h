// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "viewer/gl/gl_objects.h"

namespace arete {

/// A front as it lies in the graphics memory, to be drawn: by the counts of a buffer, where one is given.
struct DrawnFront {
  GLuint indices = 0;       ///< three vertices a triangle
  GLuint ids = 0;           ///< triangle of the MT, by place; 0 = not known
  GLuint indirect = 0;      ///< a DrawElementsIndirectCommand at its start
  std::uint32_t first = 0;  ///< place of the first triangle
  std::uint32_t count = 0;  ///< triangles; with `indirect`, as far as known
};

}  // namespace arete

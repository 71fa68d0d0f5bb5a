// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "viewer/color/color_map.h"
#include "viewer/gl/gl_objects.h"

namespace arete {

/// Colour maps in one buffer, for shaders that include shaders/color_map.glsl: colorOf(place(i), value) gives
/// the same bytes as the map's at(value).
class ColorMapsOnGpu {
 public:
  ColorMapsOnGpu() = default;
  /// O(stops). Precondition: a context is current.
  explicit ColorMapsOnGpu(std::span<const ColorMap> maps);

  /// Where a map begins in the buffer, for the shader.
  std::uint32_t place(std::size_t map) const { return places_[map]; }
  /// The buffer that the shader reads.
  void bind() const;

 private:
  GlBuffer buffer_;
  std::vector<std::uint32_t> places_;
};

}  // namespace arete

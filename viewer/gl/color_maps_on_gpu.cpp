// SPDX-License-Identifier: GPL-3.0-or-later
//
// An entry is two words. The head of a map has three entries: number of stops and how colours lie between
// them; the colours below and above; the colour of NaN. A stop is a float's bits and a colour.
#include "viewer/gl/color_maps_on_gpu.h"

#include <array>
#include <bit>

namespace arete {
namespace {

constexpr GLuint kColorMapBinding = 11;  // shaders/color_map.glsl

std::uint32_t packed(Rgba c) {
  return std::uint32_t(c.r) | std::uint32_t(c.g) << 8 | std::uint32_t(c.b) << 16 | std::uint32_t(c.a) << 24;
}

std::uint32_t codeOf(ColorsBetween between) {
  switch (between) {
    case ColorsBetween::linear:
      return 0;
    case ColorsBetween::discrete:
      return 1;
    case ColorsBetween::nearest:
      return 2;
    case ColorsBetween::exact:
      break;
  }
  return 3;
}

}  // namespace

ColorMapsOnGpu::ColorMapsOnGpu(std::span<const ColorMap> maps) {
  using Entry = std::array<std::uint32_t, 2>;
  std::vector<Entry> entries;
  for (const ColorMap& map : maps) {
    places_.push_back(std::uint32_t(entries.size()));
    entries.push_back({std::uint32_t(map.stops().size()), codeOf(map.between())});
    entries.push_back({packed(map.below()), packed(map.above())});
    entries.push_back({packed(map.options().nodata), 0});
    for (const ColorStop& stop : map.stops())
      entries.push_back({std::bit_cast<std::uint32_t>(float(stop.value)), packed(stop.color)});
  }
  buffer_ = makeBuffer(std::span<const Entry>(entries));
}

void ColorMapsOnGpu::bind() const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kColorMapBinding, buffer_);
}

}  // namespace arete

// Colours of values, as viewer/color/color_map.cpp finds them, step by step: the same bytes. All maps lie in one
// buffer (viewer/gl/color_maps_on_gpu.h); a map is the place of its head there.
layout(std430, binding = 11) readonly buffer ColorMaps { uvec2 colorEntry[]; };

vec4 colorOfEntry(uint packedColor) { return unpackUnorm4x8(packedColor); }

ivec4 channelsOf(uint packedColor) { return ivec4(uvec4(packedColor) >> uvec4(0u, 8u, 16u, 24u) & 0xFFu); }

/// sRGB and opacity, not premultiplied.
vec4 colorOf(uint map, float value) {
  // Head: number of stops and how colours lie between them; colours below and above; colour of NaN.
  uint count = colorEntry[map].x, between = colorEntry[map].y, first = map + 3u;
  if ((floatBitsToUint(value) & 0x7FFFFFFFu) > 0x7F800000u) return colorOfEntry(colorEntry[map + 2u].x);
  uint low = 0u, high = count;  // stops below `low` are at or below the value, stops from `high` on above it
  while (low < high) {
    uint middle = (low + high) / 2u;
    if (uintBitsToFloat(colorEntry[first + middle].x) <= value) low = middle + 1u;
    else high = middle;
  }
  uvec2 last = colorEntry[first + max(low, 1u) - 1u], next = colorEntry[first + min(low, count - 1u)];
  float a = uintBitsToFloat(last.x), b = uintBitsToFloat(next.x);
  if (low > 0u && a == value) return colorOfEntry(last.y);
  if (between == 3u) return colorOfEntry(colorEntry[map + 1u].x);
  if (low == count) return colorOfEntry(colorEntry[map + 1u].y);
  if (between == 1u) return colorOfEntry(next.y);
  if (low == 0u) return colorOfEntry(colorEntry[map + 1u].x);
  if (between == 2u) {
    precise float toLast = 0.5 * value - 0.5 * a, toNext = 0.5 * b - 0.5 * value;
    return colorOfEntry(toLast < toNext ? last.y : next.y);
  }
  if (floatBitsToUint(b) == 0x7F800000u) return colorOfEntry(last.y);
  if (floatBitsToUint(a) == 0xFF800000u) return colorOfEntry(next.y);
  precise float part = (0.5 * value - 0.5 * a) / (0.5 * b - 0.5 * a);
  int p = int(part * 65536.0);
  return vec4((channelsOf(last.y) * (65536 - p) + channelsOf(next.y) * p + 32768) >> 16) / 255.0;
}

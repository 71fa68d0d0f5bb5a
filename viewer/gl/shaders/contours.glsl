// Contour lines of the heights of full resolution (ground.glsl): ink by the distance on the screen from where
// the ground has a level's height, and not by triangles.
//
// Heights are taken in the middle of the pixel and half a pixel from it each way. The next level above is as far
// as the ground rises to it, the next one below as far as it falls: so a line along a crest, or along the edge
// of flat ground, which has a gradient on one side only, is as wide as any other.
const vec2 kMinorInk = vec2(0.5, 0.8);  // the most ink; pixels from the line to where it ends
const vec2 kFifthInk = vec2(0.8, 0.7);

/// Ink from 0 to 1. `levels`: interval, level of the base of heights, lift in levels
/// (viewer/heights/contour_levels.h).
float contourInkAt(vec3 levels, Sight pixel) {
  vec2 at = pixel.at, dx = pixel.dx, dy = pixel.dy;
  float lod = groundLod(0.4 * max(pixel.shorter, 0.25 * pixel.longer));
  float here = groundHeightAt(lod, at);
  if (here < kNoHeight) return 0.0;
  vec4 around = vec4(groundHeightAt(lod, at - 0.5 * dx), groundHeightAt(lod, at + 0.5 * dx),
                     groundHeightAt(lod, at - 0.5 * dy), groundHeightAt(lod, at + 0.5 * dy));
  // Beyond a border the ground goes on as before it.
  if (around.x < kNoHeight) around.x = around.y < kNoHeight ? here : 2.0 * here - around.y;
  if (around.y < kNoHeight) around.y = 2.0 * here - around.x;
  if (around.z < kNoHeight) around.z = around.w < kNoHeight ? here : 2.0 * here - around.w;
  if (around.w < kNoHeight) around.w = 2.0 * here - around.z;
  float interval = levels.x;
  around = 2.0 * (around - here) / interval;  // levels a pixel
  float up = length(max(max(around.xz, around.yw), 0.0)), down = length(min(min(around.xz, around.yw), 0.0));
  float rise = 0.5 * (up + down);
  if (rise <= 0.0) return 0.0;
  float level = here / interval + levels.y - levels.z;
  // Lines thin out where the slopes around, whatever side they face, have more of them than can be told apart.
  vec4 slopes = groundSlope(int(groundLod(8.0 * pixel.longer)), at);
  float steep = tan(1.5707963 * min(slopes.x / max(slopes.w, 1e-6), 0.95));
  float crowd = steep * pixel.run / (interval * abs(metricScale.z));
  float ink = 0.0, every = 1.0;
  for (int k = 0; k < 4; ++k, every *= 5.0) {
    float above = fract(level / every) * every, below = every - above;  // how far the ground is, in levels
    float away = min(above / max(down, 1e-6), below / max(up, 1e-6));
    // Lines of one kind never touch; minor ones leave room besides.
    float seen = 1.0 - smoothstep(0.5, 1.0, rise / every);
    if (k == 0) seen *= 1.0 - smoothstep(0.25, 0.5, crowd);
    vec2 kind = k == 0 ? kMinorInk : kFifthInk;
    ink = max(ink, kind.x * seen * max(1.0 - away / kind.y, 0.0));
  }
  return ink;
}

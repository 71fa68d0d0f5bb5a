// Contour lines of the heights of full resolution (ground.glsl): ink by the distance on the screen from where
// the ground has a level's height, and not by triangles.
//
// Heights are taken in the middle of the pixel and about half a pixel from it each way. The next level above is as far
// as the ground rises to it, the next one below as far as it falls: so a line along a crest, or along the edge
// of flat ground, which has a gradient on one side only, is as wide as any other.
const float kReach = 0.6;  // pixels from the middle to where heights are taken
const vec2 kMinorInk = vec2(0.46, 0.85);  // the most ink; pixels from the line to where it ends
const vec2 kFifthInk = vec2(0.72, 0.75);

/// What all contour lines of a pixel need: the height in its middle, how far the ground rises and falls within a
/// pixel, and how far it does in the neighbourhood, whatever side slopes face. Heights above the base.
struct Relief { float here, up, down, around; };
Relief reliefOf(Sight pixel) {
  float lod = groundLod(0.4 * max(pixel.shorter, 0.25 * pixel.longer));
  float here = 0.0;
  vec4 around = vec4(0.0);
  for (int i = 0; i < 5; ++i) {
    vec2 off = i == 0 ? vec2(0.0) : (i & 1) == 1 ? -kReach * (i < 3 ? pixel.dx : pixel.dy) : kReach * (i < 3 ? pixel.dx : pixel.dy);
    float height = groundHeightAt(lod, pixel.at + off);
    if (i == 0) here = height;
    else around[i - 1] = height;
  }
  if (here < kNoHeight) return Relief(0.0, 0.0, 0.0, 0.0);
  // Beyond a border the ground goes on as before it.
  if (around.x < kNoHeight) around.x = around.y < kNoHeight ? here : 2.0 * here - around.y;
  if (around.y < kNoHeight) around.y = 2.0 * here - around.x;
  if (around.z < kNoHeight) around.z = around.w < kNoHeight ? here : 2.0 * here - around.w;
  if (around.w < kNoHeight) around.w = 2.0 * here - around.z;
  around = (around - here) / kReach;
  vec4 slopes = groundSlope(int(groundLod(8.0 * pixel.longer)), pixel.at);
  float steep = tan(1.5707963 * min(slopes.x / max(slopes.w, 1e-6), 0.95));
  return Relief(here, length(max(max(around.xz, around.yw), 0.0)), length(min(min(around.xz, around.yw), 0.0)),
                steep * pixel.run / abs(metricScale.z));
}

/// Ink from 0 to 1. `levels`: interval, level of the base of heights, lift in levels
/// (viewer/heights/contour_levels.h).
float contourInk(vec3 levels, Relief relief) {
  float up = relief.up / levels.x, down = relief.down / levels.x;  // levels a pixel
  float rise = 0.5 * (up + down), ink = 0.0, every = 1.0;
  if (rise <= 0.0) return 0.0;
  float level = relief.here / levels.x + levels.y - levels.z;
  for (int k = 0; k < 4; ++k, every *= 5.0) {
    float above = fract(level / every) * every, below = every - above;  // how far the ground is, in levels
    float away = min(above / max(down, 1e-6), below / max(up, 1e-6));
    // Lines of one kind never touch; minor ones thin out where the slopes around have more of them than can be
    // told apart.
    float seen = 1.0 - smoothstep(0.5, 1.0, rise / every);
    if (k == 0) seen *= 1.0 - smoothstep(0.25, 0.5, relief.around / levels.x);
    vec2 kind = k == 0 ? kMinorInk : kFifthInk;
    ink = max(ink, kind.x * seen * max(1.0 - away / kind.y, 0.0));
  }
  return ink;
}

in vec3 place;
in vec3 fromEye;
in vec2 overGround;
layout(location = 0) out vec4 color;
layout(std140, binding = 1) uniform Look {
  vec4 sun;          // direction to it in metric space, 1 = shaded
  vec4 range;        // lowest and highest place.z, unused, width of a contour in pixels
  vec4 heightUnits;  // of place.z: height = z * x + y; haze distance; flat colour of the test (1 = on)
  vec4 modes;        // colouring, has slopes
  vec4 flatColor;
  vec4 eastNorth;    // the map's east and north in metric space
  vec4 heat;         // error of the largest heat; 0 = the cut's pixels
  vec4 ground[4];        // of each layer on it, the lowest first: opacity; interval of contours
  vec4 overlayFrame[4];  // of overlays, plan to texture: (u, v) = (x, y) * xy + zw
};
layout(binding = 0) uniform sampler2D slopes;     // dz/dx, dz/dy of the samples, metric
layout(binding = 1) uniform sampler1D tints;
layout(binding = 2) uniform sampler2DArray drapeTiles[4];  // by layer on the ground
layout(binding = 6) uniform sampler2D overlays[4];
layout(std430, binding = 8) readonly buffer TriangleIds { uint drawnId[]; };
layout(std430, binding = 9) readonly buffer TriangleErrors { uint triangleError[]; };  // two codes a word
layout(std430, binding = 10) readonly buffer Drawn { uint drawCount, drawInstances, drawFirst; };
layout(location = 1) uniform uvec2 errorCode;  // bits of code 1, bits from code to code (OutwardScale)
// Pixels of the drape are counted from the one under the eye, so that those close to it are told exactly.
layout(location = 2) uniform ivec4 drapePicture[4];   // pixels across and down, side of a tile, levels
layout(location = 6) uniform ivec2 drapeEye[4];       // the pixel under the eye
layout(location = 10) uniform vec4 drapeStep[4];      // pixels a unit of metric space; where in its pixel the eye is
layout(location = 14) uniform ivec2 drapeLevel[64];   // first layer, tiles across; 16 levels each

vec3 ramp3(float t, vec3 a, vec3 b, vec3 c) { return t < 0.5 ? mix(a, b, 2.0 * t) : mix(b, c, 2.0 * t - 1.0); }

vec3 hue(float turns) {
  return clamp(abs(fract(turns + vec3(0.0, 2.0 / 3.0, 1.0 / 3.0)) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
}

float errorOf(uint t) {
  uint code = triangleError[t >> 1] >> (16u * (t & 1u)) & 0xFFFFu;
  return code == 0u ? 0.0 : uintBitsToFloat(errorCode.x + (code - 1u) * errorCode.y);
}

/// The drape at one level of detail, between four texels of one tile. Nothing beyond its edges.
vec4 drapeTexel(sampler2DArray tiles, int slot, int level, vec2 fromEyePixel) {
  ivec2 pixel = drapeEye[slot] + ivec2(floor(fromEyePixel));
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, drapePicture[slot].xy))) return vec4(0.0);
  int side = drapePicture[slot].z, inner = side - 2;
  ivec2 texel = pixel >> level, tile = texel / inner;
  vec2 part = (vec2(pixel - (texel << level)) + fract(fromEyePixel)) / float(1 << level);
  int layer = drapeLevel[16 * slot + level].x + tile.y * drapeLevel[16 * slot + level].y + tile.x;
  return textureLod(tiles, vec3((vec2(texel - tile * inner + 1) + part) / float(side), float(layer)), 0.0);
}

/// The mean over the pixel of the screen: up to 8 places along the longer axis of what it covers, each at the
/// level whose texels are as wide as the shorter one.
vec4 drapeSeen(sampler2DArray tiles, int slot) {
  vec2 at = overGround * drapeStep[slot].xy + drapeStep[slot].zw, dx = dFdx(at), dy = dFdy(at);
  float xx = dx.x * dx.x + dy.x * dy.x, yy = dx.y * dx.y + dy.y * dy.y, xy = dx.x * dx.y + dy.x * dy.y;
  float middle = 0.5 * (xx + yy), apart = 0.5 * (xx - yy), around = sqrt(apart * apart + xy * xy);
  float longer = sqrt(middle + around), shorter = sqrt(max(middle - around, 0.0));
  vec2 axis = apart >= 0.0 ? vec2(apart + around, xy) : vec2(xy, around - apart);
  axis *= longer / max(length(axis), 1e-30);
  int count = int(clamp(ceil(longer / max(shorter, 1.0) - 0.01), 1.0, 8.0));
  float lod = clamp(log2(max(longer / float(count), shorter)), 0.0, float(drapePicture[slot].w - 1));
  int fine = int(lod), coarse = min(fine + 1, drapePicture[slot].w - 1);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < count; ++i) {
    vec2 place = at + ((float(i) + 0.5) / float(count) - 0.5) * axis;
    vec4 color = drapeTexel(tiles, slot, fine, place);
    if (lod > float(fine)) color = mix(color, drapeTexel(tiles, slot, coarse, place), lod - float(fine));
    sum += color;
  }
  return sum / float(count);
}

/// How much ink of contour lines there is, 0 to 1.
float inkOf(float height, float interval) {
  // A thousandth of an interval higher than they say, so that a sea at exactly 0 is not all one line.
  float level = height / interval - 1e-3, width = fwidth(level);
  float away = abs(fract(level + 0.5) - 0.5) / max(width, 1e-6);
  bool isFifth = abs(fract(level / 5.0 + 0.5) - 0.5) < 0.05;
  return (1.0 - smoothstep(range.w * (isFifth ? 0.8 : 0.25), range.w * (isFifth ? 0.8 : 0.25) + 1.0, away)) *
         (1.0 - smoothstep(0.12, 0.35, width));  // too close together to be told apart
}

// What is below, and one layer on the ground over it.
vec3 draped(vec3 base, int i, sampler2DArray tiles) {
  vec4 photo = drapeSeen(tiles, i) * ground[i].x;
  return base * (1.0 - photo.a) + photo.rgb;
}
vec3 overlaid(vec3 base, int i, sampler2D overlay, vec2 plan) {
  vec4 seen = texture(overlay, plan * overlayFrame[i].xy + overlayFrame[i].zw);
  return mix(base, seen.rgb, seen.a * ground[i].x);
}
vec3 inked(vec3 base, int i, float height) {
  return mix(base, vec3(0.32, 0.2, 0.1), 0.75 * ground[i].x * inkOf(height, ground[i].y));
}

void main() {
  if (heightUnits.w > 0.0) { color = flatColor; return; }
  vec2 plan = place.xy / metricScale.xy + metricOrigin.xy;
  vec2 slope;
  vec3 flatNormal = cross(dFdx(fromEye), dFdy(fromEye));
  if (modes.y > 0.0) {
    slope = texture(slopes, (plan + 0.5) / vec2(textureSize(slopes, 0))).xy * earth.x;
  } else {
    // Turned as the vertical of the place to the z axis.
    vec3 up = upAt(fromEye + eyeHigh.xyz), between = up + vec3(0.0, 0.0, 1.0);
    flatNormal += 2.0 * dot(up, flatNormal) * vec3(0.0, 0.0, 1.0) - dot(between, flatNormal) / max(1.0 + up.z, 1e-6) * between;
    flatNormal *= flatNormal.z < 0.0 ? -1.0 : 1.0;
    slope = -flatNormal.xy / max(flatNormal.z, 1e-6);
  }
  vec3 normal = normalize(vec3(-slope, 1.0));

  int mode = int(modes.x);
  float height = place.z * heightUnits.x + heightUnits.y;
  float part = clamp((place.z - range.x) / max(range.y - range.x, 1e-6), 0.0, 1.0);
  vec3 base = vec3(0.78);
  if (mode == 0) base = texture(tints, part).rgb;
  if (mode == 1) base = ramp3(clamp(atan(length(slope / earth.x)) / 1.0472, 0.0, 1.0), vec3(0.95, 0.95, 0.88), vec3(0.93, 0.6, 0.25), vec3(0.45, 0.08, 0.2));
  if (mode == 2) {
    vec2 down = -slope;
    float turns = atan(dot(down, eastNorth.xy), dot(down, eastNorth.zw)) / 6.2831853;
    base = mix(vec3(0.8), hue(turns), min(1.0, length(slope / earth.x) * 8.0) * 0.75);
  }
  if (mode == 4) {
    float e = errorOf(drawnId[drawFirst / 3u + uint(gl_PrimitiveID)]);
    float depth = dot(fromEye, forward.xyz);
    e = heat.x > 0.0 ? e / heat.x : e * morph.z * length(fromEye) / (depth * depth * morph.x);
    base = ramp3(clamp(e, 0.0, 1.0), vec3(0.13, 0.3, 0.55), vec3(0.95, 0.93, 0.8), vec3(0.75, 0.1, 0.1));
  }
  GROUND_LAYERS  // the calls above for each, lowest first (TerrainPainter::setLayers())
  if (sun.w > 0.0) {
    // The sun, the sky above, and what the ground throws back.
    float lit = max(dot(normal, sun.xyz), 0.0), sky = 0.5 + 0.5 * normal.z;
    base *= 0.9 * lit * vec3(1.0, 0.96, 0.88) + 0.42 * sky * vec3(0.78, 0.88, 1.0) + 0.06;
  }
  if (heightUnits.z > 0.0) {
    float haze = 1.0 - exp(-pow(length(fromEye) / heightUnits.z, 1.5));
    base = mix(base, vec3(0.74, 0.81, 0.88), haze);
  }
  color = vec4(base, 1.0);
}

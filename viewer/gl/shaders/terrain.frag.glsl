// Compiled for what a picture shows (TerrainPainter::programFor()). MODE: colouring; FLAT, SHADED, HAZE, CONTOURS: true
// or false; GROUND_LAYERS: the calls of the layers on the ground, the lowest first.
in vec3 place;
in vec3 fromEye;
in vec2 overGround;
layout(location = 0) out vec4 color;
layout(std140, binding = 1) uniform Look {
  vec4 sun;          // direction to it in metric space, 
  vec4 heightUnits;  // of place.z: height above the base = z * x + y; haze distance
  vec4 modes;        // base of heights (ground.glsl)
  vec4 flatColor;
  vec4 eastNorth;    // the map's east and north in metric space
  vec4 heat;         // error of the largest heat; 0 = the cut's pixels
  vec4 ground[4];        // of each layer on it, the lowest first: opacity
  vec4 overlayFrame[4];  // of overlays, plan to texture: (u, v) = (x, y) * xy + zw
  vec4 contours[4];      // contours.glsl
};
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
layout(location = 91) uniform uvec4 colorMaps;         // of heights, slopes, aspects, errors (color_map.glsl)
// Of heights: a power of two, so that a sea at exactly its level, and whole numbers, meet the stops of a colour map.
layout(location = 96) uniform float heightGrain;
layout(location = 92) uniform int drapeClasses[4];     // 1: colours of classes, which are not mixed

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
  // One texel of one level, about as wide as the pixel.
  if (drapeClasses[slot] != 0) {
    float level = 0.5 * log2(max(longer * max(shorter, 1.0), 1.0)) + 0.5;
    return drapeTexel(tiles, slot, int(clamp(level, 0.0, float(drapePicture[slot].w - 1))), at);
  }
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

// What is below, and one layer on the ground over it.
vec3 draped(vec3 base, int i, sampler2DArray tiles) {
  vec4 photo = drapeSeen(tiles, i) * ground[i].x;
  return base * (1.0 - photo.a) + photo.rgb;
}
vec3 overlaid(vec3 base, int i, sampler2D overlay, vec2 plan) {
  vec4 seen = texture(overlay, plan * overlayFrame[i].xy + overlayFrame[i].zw);
  return mix(base, seen.rgb, seen.a * ground[i].x);
}
vec3 inked(vec3 base, int i, Relief relief) {
  return mix(base, CONTOUR_INK, 0.85 * ground[i].x * contourInk(contours[i].xyz, relief));
}

void main() {
  if (FLAT) { color = flatColor; return; }
  vec2 plan = place.xy / metricScale.xy + metricOrigin.xy;
  Sight sight = sightOf(overGround);
  vec3 flatNormal = cross(dFdx(fromEye), dFdy(fromEye));
  vec4 slopes = vec4(0.0);  // slope and direction downhill
  vec2 slope = vec2(0.0);
  if (SHADED || MODE == 1 || MODE == 2) {
    slopes = groundMeanSlope(sight);
    if (slopes.w == 0.0) {
      // Turned as the vertical of the place to the z axis.
      vec3 up = upAt(fromEye + eyeHigh.xyz), between = up + vec3(0.0, 0.0, 1.0);
      flatNormal += 2.0 * dot(up, flatNormal) * vec3(0.0, 0.0, 1.0) - dot(between, flatNormal) / max(1.0 + up.z, 1e-6) * between;
      flatNormal *= flatNormal.z < 0.0 ? -1.0 : 1.0;
      vec2 down = flatNormal.xy / max(flatNormal.z, 1e-6) / earth.x;
      float steepness = length(down);
      slopes = vec4(atan(steepness) / 1.5707963, steepness > 0.0 ? vec2(dot(down, eastNorth.xy), dot(down, eastNorth.zw)) / steepness : vec2(0.0), 1.0);
    }
    slope = -tan(1.5707963 * min(slopes.x, 0.99)) * earth.x * (slopes.y * eastNorth.xy + slopes.z * eastNorth.zw);
  }
  vec3 normal = normalize(vec3(-slope, 1.0));

  float value = 0.0;  // that has a colour
  if (MODE == 0) {
    float height = groundMeanHeight(sight);
    height = (height < kNoHeight ? place.z * heightUnits.x + heightUnits.y : height) + modes.x;
    value = roundEven(height / heightGrain) * heightGrain;
  } else if (MODE == 1) {
    value = 90.0 * slopes.x;
  } else if (MODE == 2) {
    value = 360.0 * fract(atan(slopes.y, slopes.z) / 6.2831853);
  } else if (MODE == 4) {
    float e = errorOf(drawnId[drawFirst / 3u + uint(gl_PrimitiveID)]);
    value = heat.x > 0.0 ? e / heat.x : e * morph.z / (reachAt(fromEye) * morph.x);
  }
  vec3 base = vec3(0.78);
  if (MODE != 3) {
    vec4 tint = colorOf(MODE == 4 ? colorMaps.w : colorMaps[MODE > 3 ? 0 : MODE], value);
    base = mix(base, tint.rgb, tint.a);
  }
  // Level ground, and ground that faces everywhere, faces nowhere: the grey of the same lightness.
  if (MODE == 2) base = mix(vec3(166.0 / 255.0), base, smoothstep(0.05, 0.2, length(slopes.yz)));
  Relief relief = Relief(0.0, 0.0, 0.0, 0.0);
  if (CONTOURS) relief = reliefOf(sight);
  GROUND_LAYERS
  if (SHADED) base = srgbOf(litLinear(linearOf(base), lightOnGround(normal, sun.xyz)));
  if (HAZE) {
    float haze = 1.0 - exp(-pow(length(fromEye) / heightUnits.z, 1.5));
    base = srgbOf(mix(linearOf(base), linearOf(vec3(0.74, 0.81, 0.88)), haze));
  }
  color = vec4(base, 1.0);
}

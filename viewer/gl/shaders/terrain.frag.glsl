in vec3 place;
in vec3 fromEye;
in vec2 overGround;
layout(location = 0) out vec4 color;
layout(std140, binding = 1) uniform Look {
  vec4 sun;          // direction to it in metric space, 1 = shaded
  vec4 range;        // lowest and highest height above the base (ground.glsl)
  vec4 heightUnits;  // of place.z: height above the base = z * x + y; haze distance; flat colour of the test (1 = on)
  vec4 modes;        // colouring, has contours, has drape, has overlay
  vec4 flatColor;
  vec4 overlayFrame; // plan to texture: (u, v) = (x, y) * xy + zw
  vec4 eastNorth;    // the map's east and north in metric space
  vec4 heat;         // error of the largest heat; 0 = the cut's pixels
};
layout(binding = 1) uniform sampler1D tints;
layout(binding = 2) uniform sampler2DArray drapeTiles;
layout(binding = 3) uniform sampler2D overlay;
layout(std430, binding = 8) readonly buffer TriangleIds { uint drawnId[]; };
layout(std430, binding = 9) readonly buffer TriangleErrors { uint triangleError[]; };  // two codes a word
layout(std430, binding = 10) readonly buffer Drawn { uint drawCount, drawInstances, drawFirst; };
layout(location = 1) uniform uvec2 errorCode;  // bits of code 1, bits from code to code (OutwardScale)
// Pixels of the drape are counted from the one under the eye, so that those close to it are told exactly.
layout(location = 2) uniform ivec4 drapePicture;    // pixels across and down, side of a tile, levels
layout(location = 3) uniform ivec2 drapeEye;        // the pixel under the eye
layout(location = 4) uniform vec4 drapeStep;        // pixels a unit of metric space; where in its pixel the eye is
layout(location = 5) uniform ivec2 drapeLevel[16];  // first layer, tiles across

vec3 ramp3(float t, vec3 a, vec3 b, vec3 c) { return t < 0.5 ? mix(a, b, 2.0 * t) : mix(b, c, 2.0 * t - 1.0); }

vec3 hue(float turns) {
  return clamp(abs(fract(turns + vec3(0.0, 2.0 / 3.0, 1.0 / 3.0)) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
}

float errorOf(uint t) {
  uint code = triangleError[t >> 1] >> (16u * (t & 1u)) & 0xFFFFu;
  return code == 0u ? 0.0 : uintBitsToFloat(errorCode.x + (code - 1u) * errorCode.y);
}

/// The drape at one level of detail, between four texels of one tile. Nothing beyond its edges.
vec4 drapeTexel(int level, vec2 fromEyePixel) {
  ivec2 pixel = drapeEye + ivec2(floor(fromEyePixel));
  if (any(lessThan(pixel, ivec2(0))) || any(greaterThanEqual(pixel, drapePicture.xy))) return vec4(0.0);
  int side = drapePicture.z, inner = side - 2;
  ivec2 texel = pixel >> level, tile = texel / inner;
  vec2 part = (vec2(pixel - (texel << level)) + fract(fromEyePixel)) / float(1 << level);
  int layer = drapeLevel[level].x + tile.y * drapeLevel[level].y + tile.x;
  return textureLod(drapeTiles, vec3((vec2(texel - tile * inner + 1) + part) / float(side), float(layer)), 0.0);
}

/// The mean over the pixel of the screen: up to 8 places along the longer axis of what it covers, each at the
/// level whose texels are as wide as the shorter one.
vec4 drapeSeen() {
  vec2 at = overGround * drapeStep.xy + drapeStep.zw, dx = dFdx(at), dy = dFdy(at);
  float xx = dx.x * dx.x + dy.x * dy.x, yy = dx.y * dx.y + dy.y * dy.y, xy = dx.x * dx.y + dy.x * dy.y;
  float middle = 0.5 * (xx + yy), apart = 0.5 * (xx - yy), around = sqrt(apart * apart + xy * xy);
  float longer = sqrt(middle + around), shorter = sqrt(max(middle - around, 0.0));
  vec2 axis = apart >= 0.0 ? vec2(apart + around, xy) : vec2(xy, around - apart);
  axis *= longer / max(length(axis), 1e-30);
  int count = int(clamp(ceil(longer / max(shorter, 1.0) - 0.01), 1.0, 8.0));
  float lod = clamp(log2(max(longer / float(count), shorter)), 0.0, float(drapePicture.w - 1));
  int fine = int(lod), coarse = min(fine + 1, drapePicture.w - 1);
  vec4 sum = vec4(0.0);
  for (int i = 0; i < count; ++i) {
    vec2 place = at + ((float(i) + 0.5) / float(count) - 0.5) * axis;
    vec4 color = drapeTexel(fine, place);
    if (lod > float(fine)) color = mix(color, drapeTexel(coarse, place), lod - float(fine));
    sum += color;
  }
  return sum / float(count);
}

vec3 heightColor(float height) {
  return texture(tints, clamp((height - range.x) / max(range.y - range.x, 1e-6), 0.0, 1.0)).rgb;
}

void main() {
  if (heightUnits.w > 0.0) { color = flatColor; return; }
  vec2 plan = place.xy / metricScale.xy + metricOrigin.xy;
  vec2 at = groundPlace(overGround), dx = dFdx(at), dy = dFdy(at);
  Footprint pixel = footprintOf(dx, dy);
  float run = sqrt(0.5 * (dot(dFdx(overGround), dFdx(overGround)) + dot(dFdy(overGround), dFdy(overGround))));
  vec3 flatNormal = cross(dFdx(fromEye), dFdy(fromEye));
  int mode = int(modes.x);
  vec4 ground = vec4(0.0);  // slope and direction downhill
  vec2 slope = vec2(0.0);
  if (sun.w > 0.0 || mode == 1 || mode == 2) {
    ground = groundMeanSlope(at, pixel);
    if (ground.w == 0.0) {
      // Turned as the vertical of the place to the z axis.
      vec3 up = upAt(fromEye + eyeHigh.xyz), between = up + vec3(0.0, 0.0, 1.0);
      flatNormal += 2.0 * dot(up, flatNormal) * vec3(0.0, 0.0, 1.0) - dot(between, flatNormal) / max(1.0 + up.z, 1e-6) * between;
      flatNormal *= flatNormal.z < 0.0 ? -1.0 : 1.0;
      vec2 down = flatNormal.xy / max(flatNormal.z, 1e-6) / earth.x;
      float steepness = length(down);
      ground = vec4(atan(steepness) / 1.5707963, steepness > 0.0 ? vec2(dot(down, eastNorth.xy), dot(down, eastNorth.zw)) / steepness : vec2(0.0), 1.0);
    }
    slope = -tan(1.5707963 * min(ground.x, 0.99)) * earth.x * (ground.y * eastNorth.xy + ground.z * eastNorth.zw);
  }
  vec3 normal = normalize(vec3(-slope, 1.0));

  vec3 base = vec3(0.78);
  if (mode == 0) {
    float height = groundMeanHeight(at, pixel);
    base = heightColor(height < kNoHeight ? place.z * heightUnits.x + heightUnits.y : height);
  }
  if (mode == 1) base = ramp3(clamp(ground.x * 1.5, 0.0, 1.0), vec3(0.95, 0.95, 0.88), vec3(0.93, 0.6, 0.25), vec3(0.45, 0.08, 0.2));
  if (mode == 2) {
    // Where directions cancel there is none.
    float turns = atan(ground.y, ground.z) / 6.2831853;
    base = mix(vec3(0.8), hue(turns), 0.75 * smoothstep(0.05, 0.2, length(ground.yz)));
  }
  if (mode == 4) {
    float e = errorOf(drawnId[drawFirst / 3u + uint(gl_PrimitiveID)]);
    float depth = dot(fromEye, forward.xyz);
    e = heat.x > 0.0 ? e / heat.x : e * morph.z * length(fromEye) / (depth * depth * morph.x);
    base = ramp3(clamp(e, 0.0, 1.0), vec3(0.13, 0.3, 0.55), vec3(0.95, 0.93, 0.8), vec3(0.75, 0.1, 0.1));
  }
  if (modes.z > 0.0) {
    vec4 photo = drapeSeen();
    base = base * (1.0 - photo.a) + photo.rgb;
  }
  if (modes.w > 0.0) {
    vec4 seen = texture(overlay, plan * overlayFrame.xy + overlayFrame.zw);
    base = mix(base, seen.rgb, seen.a);
  }
  if (modes.y > 0.0) base = mix(base, contourColor.rgb, contourColor.a * contourInkAt(at, dx, dy, pixel, run));
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

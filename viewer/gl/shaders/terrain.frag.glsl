in vec3 place;
in vec3 fromEye;
layout(location = 0) out vec4 color;
layout(std140, binding = 1) uniform Look {
  vec4 sun;          // direction to it in metric space, 1 = shaded
  vec4 range;        // lowest and highest place.z, contour interval, width of a contour in pixels
  vec4 heightUnits;  // of place.z: height = z * x + y; haze distance; flat colour of the test (1 = on)
  vec4 modes;        // colouring, has slopes, has drape, has overlay
  vec4 flatColor;
  vec4 drapeFrame, overlayFrame;  // plan to texture: (u, v) = (x, y) * xy + zw
  vec4 eastNorth;    // the map's east and north in metric space
  vec4 heat;         // error of the largest heat; 0 = the cut's pixels
};
layout(binding = 0) uniform sampler2D slopes;     // dz/dx, dz/dy of the samples, metric
layout(binding = 1) uniform sampler1D tints;
layout(binding = 2) uniform sampler2DArray drapeTiles;
layout(binding = 3) uniform sampler2D overlay;
layout(std430, binding = 8) readonly buffer TriangleIds { uint drawnId[]; };
layout(std430, binding = 9) readonly buffer TriangleErrors { uint triangleError[]; };  // two codes a word
layout(std430, binding = 10) readonly buffer Drawn { uint drawCount, drawInstances, drawFirst; };
layout(location = 1) uniform uvec2 errorCode;  // bits of code 1, bits from code to code (OutwardScale)
layout(location = 2) uniform vec4 drapeGrid;   // tiles across, inner and whole side of a tile, border
layout(location = 3) uniform vec2 drapeSize;   // pixels of the whole drape

vec3 ramp3(float t, vec3 a, vec3 b, vec3 c) { return t < 0.5 ? mix(a, b, 2.0 * t) : mix(b, c, 2.0 * t - 1.0); }

vec3 hue(float turns) {
  return clamp(abs(fract(turns + vec3(0.0, 2.0 / 3.0, 1.0 / 3.0)) * 6.0 - 3.0) - 1.0, 0.0, 1.0);
}

float errorOf(uint t) {
  uint code = triangleError[t >> 1] >> (16u * (t & 1u)) & 0xFFFFu;
  return code == 0u ? 0.0 : uintBitsToFloat(errorCode.x + (code - 1u) * errorCode.y);
}

vec4 drapeAt(vec2 uv) {
  vec2 pixel = uv * drapeSize, dx = dFdx(pixel), dy = dFdy(pixel);
  if (any(lessThan(uv, vec2(0.0))) || any(greaterThan(uv, vec2(1.0)))) return vec4(0.0);
  vec2 tile = min(floor(pixel / drapeGrid.y), floor((drapeSize - 1.0) / drapeGrid.y));
  vec2 inside = (pixel - tile * drapeGrid.y + drapeGrid.w) / drapeGrid.z;
  float layer = tile.y * drapeGrid.x + tile.x;
  return textureGrad(drapeTiles, vec3(inside, layer), dx / drapeGrid.z, dy / drapeGrid.z);
}

void main() {
  if (heightUnits.w > 0.0) { color = flatColor; return; }
  vec2 plan = place.xy / metricScale.xy + metricOrigin.xy;
  vec2 slope;
  vec3 flatNormal = cross(dFdx(fromEye), dFdy(fromEye));
  if (modes.y > 0.0) {
    slope = texture(slopes, (plan + 0.5) / vec2(textureSize(slopes, 0))).xy * lens.w;
  } else {
    flatNormal *= flatNormal.z < 0.0 ? -1.0 : 1.0;
    slope = -flatNormal.xy / max(flatNormal.z, 1e-6);
  }
  vec3 normal = normalize(vec3(-slope, 1.0));

  int mode = int(modes.x);
  float height = place.z * heightUnits.x + heightUnits.y;
  float part = clamp((place.z - range.x) / max(range.y - range.x, 1e-6), 0.0, 1.0);
  vec3 base = vec3(0.78);
  if (mode == 0) base = texture(tints, part).rgb;
  if (mode == 1) base = ramp3(clamp(atan(length(slope / lens.w)) / 1.0472, 0.0, 1.0), vec3(0.95, 0.95, 0.88), vec3(0.93, 0.6, 0.25), vec3(0.45, 0.08, 0.2));
  if (mode == 2) {
    vec2 down = -slope;
    float turns = atan(dot(down, eastNorth.xy), dot(down, eastNorth.zw)) / 6.2831853;
    base = mix(vec3(0.8), hue(turns), min(1.0, length(slope / lens.w) * 8.0) * 0.75);
  }
  if (mode == 4) {
    float e = errorOf(drawnId[drawFirst / 3u + uint(gl_PrimitiveID)]);
    float depth = dot(fromEye, forward.xyz);
    e = heat.x > 0.0 ? e / heat.x : e * morph.z * length(fromEye) / (depth * depth * morph.x);
    base = ramp3(clamp(e, 0.0, 1.0), vec3(0.13, 0.3, 0.55), vec3(0.95, 0.93, 0.8), vec3(0.75, 0.1, 0.1));
  }
  if (modes.z > 0.0) {
    vec4 photo = drapeAt(plan * drapeFrame.xy + drapeFrame.zw);
    base = mix(base, photo.rgb, photo.a);
  }
  if (modes.w > 0.0) {
    vec4 seen = texture(overlay, plan * overlayFrame.xy + overlayFrame.zw);
    base = mix(base, seen.rgb, seen.a);
  }
  if (range.z > 0.0) {
    // A thousandth of an interval higher than they say, so that a sea at exactly 0 is not all one line.
    float level = height / range.z - 1e-3, width = fwidth(level);
    float away = abs(fract(level + 0.5) - 0.5) / max(width, 1e-6);
    bool isFifth = abs(fract(level / 5.0 + 0.5) - 0.5) < 0.05;
    float ink = (1.0 - smoothstep(range.w * (isFifth ? 1.0 : 0.5), range.w * (isFifth ? 1.0 : 0.5) + 1.0, away)) * (1.0 - smoothstep(0.3, 0.6, width));
    base = mix(base, vec3(0.32, 0.2, 0.1), 0.75 * ink);
  }
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

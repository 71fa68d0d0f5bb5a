in vec3 fromEye;
in vec3 shadingNormal;
in vec4 textureCoords;
in vec4 vertexColor;
layout(location = 0) out vec4 color;
layout(std140, binding = 1) uniform Look {
  vec4 baseColor;  // linear
  vec4 sun;        // direction to it, 1 = shaded
  vec4 modes;      // 0 materials, 1 plain, 2 errors; 1 + set of the picture or 0; alpha 0, 1 masked, 2 blended; cutoff
  vec4 more;       // 1 = both sides alike; 1 = flat colour; first triangle
  vec4 zenith;     // upwards, 1 = flat
  vec4 parts;      // of the light: sun, sky, headlight
};
layout(binding = 0) uniform sampler2D picture;
layout(location = 0) uniform uint errorColors;  // color_map.glsl
layout(std430, binding = 8) readonly buffer Errors { float error[]; };

void main() {
  if (more.y > 0.0) { color = baseColor; return; }
  vec3 toEye = towardsEye(fromEye);
  vec3 flatNormal = cross(dFdx(fromEye), dFdy(fromEye));
  flatNormal = length(flatNormal) > 0.0 ? normalize(flatNormal) : toEye;
  if (dot(flatNormal, toEye) < 0.0) flatNormal = -flatNormal;
  // Where normals of vertices are short, the triangle's own counts.
  vec3 smoothNormal = gl_FrontFacing ? shadingNormal : -shadingNormal;
  vec3 normal = smoothNormal + (1.0 - min(length(smoothNormal), 1.0)) * flatNormal;
  normal = length(normal) > 1e-6 && zenith.w == 0.0 ? normalize(normal) : flatNormal;

  vec4 base = baseColor;
  int mode = int(modes.x);
  if (mode == 0) {
    if (modes.y > 0.0) base *= texture(picture, modes.y > 1.5 ? textureCoords.zw : textureCoords.xy);
    base *= vec4(linearOf(vertexColor.rgb), vertexColor.a);
    if (modes.z == 1.0 && base.a < modes.w) discard;
  } else if (mode == 1) {
    base = vec4(0.58, 0.58, 0.56, 1.0);
  } else {
    // As many pixels as the cut allows are the hottest colour.
    float e = error[int(more.z) + gl_PrimitiveID] * morph.z / (reachAt(fromEye) * morph.x);
    base = vec4(linearOf(colorOf(errorColors, e).rgb), 1.0);
  }
  if (modes.z != 2.0) base.a = 1.0;
  // The inside of what has one side only.
  if (!gl_FrontFacing && more.x == 0.0 && mode != 2) base.rgb = mix(base.rgb, vec3(0.10, 0.14, 0.22), 0.7);
  if (sun.w > 0.0) {
    float lit = max(dot(normal, sun.xyz), 0.0), sky = 0.5 + 0.5 * dot(normal, zenith.xyz), ahead = max(dot(normal, toEye), 0.0);
    base.rgb = litLinear(base.rgb, parts.x * 0.74 * lit + parts.y * (0.14 * sky * vec3(0.92, 0.97, 1.0) + 0.03) + parts.z * 0.09 * ahead);
  }
  color = vec4(srgbOf(clamp(base.rgb, 0.0, 1.0)), base.a);
}

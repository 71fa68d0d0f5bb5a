in vec3 fromEye;
in vec3 shadingNormal;
in vec4 textureCoords;
in vec4 vertexColor;
layout(location = 0) out vec4 color;
layout(std140, binding = 1) uniform Look {
  vec4 baseColor;  // linear
  vec4 sun;        // direction to it, 1 = shaded
  vec4 modes;      // 0 materials, 1 plain, 2 errors, 3 an ink; unused; alpha 0, 1 masked, 2 blended; cutoff
  vec4 more;       // 1 = both sides alike; 1 = flat colour; first triangle; 1 = the triangle's own normal
  vec4 zenith;     // upwards
  vec4 parts;      // of the light, 1 = on: sun, sky, at the eye, highlights
  vec4 finish;     // metal, roughness, reflectance, scale of the picture of normals
  vec4 emission;   // linear; how much occlusion counts
  vec4 lookups[12];  // of each picture: (u, v, 1) to u, 1 + set of coordinates or 0 = no picture; the same to v
  vec4 keptLow, keptHigh;  // a box, from the eye; 1 = what lies outside is tinted
};
layout(binding = 0) uniform sampler2D pictures[6];  // colour, metal and roughness, normal, occlusion, emission, opacity
layout(binding = 6) uniform sampler2D reflected;
layout(location = 0) uniform uint numberColors;  // color_map.glsl
layout(std430, binding = 8) readonly buffer Errors { float error[]; };
layout(std430, binding = 9) readonly buffer TriangleIds { uint drawnId[]; };
layout(std430, binding = 10) readonly buffer Ink { float inkNumber[]; };  // by id

bool has(int picture) { return lookups[2 * picture].w > 0.0; }
vec2 coordsOf(int picture) {
  vec3 uv = vec3(lookups[2 * picture].w > 1.5 ? textureCoords.zw : textureCoords.xy, 1.0);
  return vec2(dot(lookups[2 * picture].xyz, uv), dot(lookups[2 * picture + 1].xyz, uv));
}

/// The normal that a picture says. Its x runs along u and its y against v, which is counted from the upper side.
vec3 picturedNormal(vec3 normal) {
  vec3 said = texture(pictures[2], coordsOf(2)).xyz * 2.0 - 1.0;
  said.xy *= finish.w;
  vec2 uv = coordsOf(2), uvX = dFdx(uv), uvY = dFdy(uv);
  vec3 acrossY = cross(dFdy(fromEye), normal), acrossX = cross(normal, dFdx(fromEye));
  vec3 alongU = acrossY * uvX.x + acrossX * uvY.x, alongV = acrossY * uvX.y + acrossX * uvY.y;
  float longest = max(dot(alongU, alongU), dot(alongV, alongV));
  if (!(longest > 0.0)) return normal;
  // Of the side that is turned away the whole picture is turned.
  float side = (gl_FrontFacing ? 1.0 : -1.0) * inversesqrt(longest);
  vec3 turned = side * (said.x * alongU - said.y * alongV) + said.z * normal;
  return length(turned) > 1e-6 ? normalize(turned) : normal;
}

/// What a surface of a roughness throws back of light from all sides (viewer/surface/reflected_light.h).
vec2 thrownBack(float roughness, float toEye) {
  // Between the middles of the first and the last texel.
  vec2 side = vec2(textureSize(reflected, 0));
  return texture(reflected, clamp(vec2(toEye, roughness), 0.5 / side, 1.0 - 0.5 / side)).rg;
}

/// A highlight (GGX), as a multiple of what a white matt surface shows that the same light falls on straight.
vec3 highlight(vec3 normal, vec3 toEye, vec3 toLight, vec3 reflectance, float most, float roughness) {
  float nl = dot(normal, toLight), nv = max(dot(normal, toEye), 1e-3);
  if (nl <= 0.0) return vec3(0.0);
  vec3 between = normalize(toLight + toEye);
  float nh = clamp(dot(normal, between), 0.0, 1.0), vh = clamp(dot(toEye, between), 0.0, 1.0);
  float a = max(roughness * roughness, 0.002), a2 = a * a, d = nh * nh * (a2 - 1.0) + 1.0;
  float spread = a2 / (d * d);
  float seen = 0.5 / (nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2));
  vec3 mirrored = reflectance + (most - reflectance) * pow(1.0 - vh, 5.0);
  return spread * seen * nl * mirrored;
}

void main() {
  if (more.y > 0.0) { color = baseColor; return; }
  vec3 toEye = towardsEye(fromEye);
  vec3 flatNormal = cross(dFdx(fromEye), dFdy(fromEye));
  flatNormal = length(flatNormal) > 0.0 ? normalize(flatNormal) : toEye;
  if (dot(flatNormal, toEye) < 0.0) flatNormal = -flatNormal;
  // Where normals of vertices are short, the triangle's own counts.
  vec3 smoothNormal = more.w > 0.0 ? vec3(0.0) : gl_FrontFacing ? shadingNormal : -shadingNormal;
  vec3 normal = smoothNormal + (1.0 - min(length(smoothNormal), 1.0)) * flatNormal;
  normal = length(normal) > 1e-6 ? normalize(normal) : flatNormal;

  vec4 base = baseColor;
  float metal = finish.x, roughness = finish.y, open = 1.0;
  vec3 glow = emission.rgb;
  int mode = int(modes.x);
  if (mode == 0) {
    if (has(0)) {
      vec4 said = texture(pictures[0], coordsOf(0));
      // Alpha is multiplied in, so that no colour of what is not seen comes in at the border of what is.
      if (modes.z > 0.0) said.rgb /= max(said.a, 1.0 / 512.0);
      base *= said;
    }
    if (has(5)) base.a *= texture(pictures[5], coordsOf(5)).r;
    base *= vec4(linearOf(vertexColor.rgb), vertexColor.a);
    if (has(1)) {
      vec4 said = texture(pictures[1], coordsOf(1));
      metal *= said.b;
      roughness *= said.g;
    }
    if (has(2)) normal = picturedNormal(normal);
    if (has(3)) open = 1.0 + emission.w * (texture(pictures[3], coordsOf(3)).r - 1.0);
    if (has(4)) glow *= texture(pictures[4], coordsOf(4)).rgb;
    if (modes.z == 1.0 && base.a < modes.w) discard;
  } else if (mode == 1) {
    base = vec4(0.58, 0.58, 0.56, 1.0);
  } else if (mode == 3) {
    base = vec4(linearOf(colorOf(numberColors, inkNumber[drawnId[int(more.z) + gl_PrimitiveID]]).rgb), 1.0);
  } else {
    // As many pixels as the cut allows are the hottest colour.
    float e = error[int(more.z) + gl_PrimitiveID] * morph.z / (reachAt(fromEye) * morph.x);
    base = vec4(linearOf(colorOf(numberColors, e).rgb), 1.0);
  }
  if (modes.z != 2.0) base.a = 1.0;
  // The inside of what has one side only.
  if (!gl_FrontFacing && more.x == 0.0 && mode < 2) base.rgb = mix(base.rgb, vec3(0.10, 0.14, 0.22), 0.7);
  if (sun.w > 0.0) {
    const vec3 skyColor = vec3(0.92, 0.97, 1.0);
    float lit = 0.74 * parts.x * max(dot(normal, sun.xyz), 0.0), ahead = 0.09 * parts.z * max(dot(normal, toEye), 0.0);
    vec3 ambient = parts.y * open * (0.14 * (0.5 + 0.5 * dot(normal, zenith.xyz)) * skyColor + 0.03);
    vec3 reflectance = mix(vec3(finish.z), base.rgb, metal) * parts.w;
    float highest = max(reflectance.r, max(reflectance.g, reflectance.b)), most = min(50.0 * highest, 1.0);
    vec3 shown = litLinear(base.rgb, lit + ambient + ahead);
    if (highest > 0.0) {
      float nv = clamp(dot(normal, toEye), 0.0, 1.0);
      vec2 back = thrownBack(roughness, nv);
      // What light between the bumps of a rough surface loses in one reflection, further ones throw back.
      vec3 again = 1.0 + reflectance * (1.0 / max(back.x + back.y, 0.05) - 1.0);
      vec3 thrown = reflectance * back.x + most * back.y;
      vec3 mirrored = reflect(-toEye, normal);
      vec3 skyThere = parts.y * open * (0.14 * (0.5 + 0.5 * dot(mirrored, zenith.xyz)) * skyColor + 0.03);
      vec3 shine = 0.74 * parts.x * highlight(normal, toEye, sun.xyz, reflectance, most, roughness) +
                   0.09 * parts.z * highlight(normal, toEye, toEye, reflectance, most, roughness) + thrown * skyThere;
      float thrownAtMost = max(thrown.r, max(thrown.g, thrown.b));
      shown = shown * (1.0 - metal) * (1.0 - mix(thrownAtMost, 0.0, metal)) + shine * again;
    }
    base.rgb = shown + glow;
  }
  color = vec4(srgbOf(clamp(base.rgb, 0.0, 1.0)), base.a);
  if (keptLow.w > 0.0 && (any(lessThan(fromEye, keptLow.xyz)) || any(greaterThan(fromEye, keptHigh.xyz))))
    color.rgb = mix(color.rgb, vec3(0.84, 0.20, 0.14), 0.55);
}

// Light is added up in linear intensities and approaches full intensity softly (viewer/color/light.h).
vec3 linearOf(vec3 c) { return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), greaterThan(c, vec3(0.04045))); }
vec3 srgbOf(vec3 c) { return mix(c * 12.92, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308))); }

/// Linear intensities under a multiple of the light that shows them as they are.
vec3 litLinear(vec3 x, vec3 k) { return k * x / (1.0 + max(k - 1.0, 0.0) * x); }

/// The sun, the sky above, and what the ground throws back, as multiples of the light on level ground, so that level
/// ground keeps its colour.
vec3 lightOnGround(vec3 normal, vec3 toSun) {
  const vec3 sun = vec3(1.0, 0.96, 0.9), sky = vec3(0.14, 0.16, 0.18), ground = vec3(0.03);
  vec3 level = sun * max(toSun.z, 0.0) + sky + ground;
  return (sun * max(dot(normal, toSun), 0.0) + sky * (0.5 + 0.5 * normal.z) + ground) / level;
}

in vec2 texel;
flat in vec4 textInk;
flat in vec4 bounds;
layout(location = 0) out vec4 color;
layout(binding = 5) uniform sampler2D atlas;

float inkAt(vec2 at) {
  return any(lessThan(at, bounds.xy)) || any(greaterThanEqual(at, bounds.zw))
             ? 0.0
             : texelFetch(atlas, ivec2(at), 0).r;
}

void main() {
  // A halo of two pixels, light about dark letters and dark about light ones, keeps them legible on any ground.
  float halo = 0.0;
  for (int y = -2; y <= 2; ++y)
    for (int x = -2; x <= 2; ++x) {
      float away = length(vec2(x, y));
      if (away < 2.5) halo = max(halo, inkAt(texel + vec2(x, y)) * min(1.0, 2.6 - away));
    }
  float letter = inkAt(texel);
  float light = dot(textInk.rgb, vec3(0.2126, 0.7152, 0.0722));
  vec3 around = light < 0.5 ? vec3(1.0) : vec3(0.08);
  float covered = max(letter, 0.85 * halo);
  color = vec4(mix(around, textInk.rgb, letter / max(covered, 1e-3)), covered * textInk.a);
}

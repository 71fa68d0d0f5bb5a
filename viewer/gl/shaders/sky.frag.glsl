in vec2 screen;
layout(location = 0) out vec4 color;
layout(location = 0) uniform vec4 sunDirection;
void main() {
  vec2 aside = isParallel() ? vec2(0.0) : screen / lens.xy;
  vec3 ray = normalize(forward.xyz + right.xyz * aside.x + up.xyz * aside.y);
  float high = clamp(dot(ray, upAt(eyeHigh.xyz)), -1.0, 1.0);
  vec3 horizon = vec3(0.80, 0.86, 0.91), zenith = vec3(0.25, 0.45, 0.74), below = vec3(0.60, 0.66, 0.71);
  vec3 sky = high > 0.0 ? mix(horizon, zenith, 1.0 - exp(-3.0 * high)) : mix(horizon, below, 1.0 - exp(4.0 * high));
  float glow = max(dot(ray, sunDirection.xyz), 0.0);
  sky += vec3(1.0, 0.85, 0.6) * (0.25 * pow(glow, 24.0) + pow(glow, 1500.0)) * sunDirection.w;
  color = vec4(sky, 1.0);
}

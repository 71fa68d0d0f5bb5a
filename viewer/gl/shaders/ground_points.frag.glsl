noperspective in vec2 fromMiddle;
layout(location = 0) out vec4 color;
layout(location = 1) uniform float radius;
layout(location = 2) uniform vec4 ink;
void main() {
  // A rim, light about dark discs and dark about light ones, tells them from the ground.
  float away = length(fromMiddle);
  vec3 rim = dot(ink.rgb, vec3(0.2126, 0.7152, 0.0722)) < 0.5 ? vec3(1.0) : vec3(0.08);
  color = vec4(mix(ink.rgb, rim, clamp(away - radius + 2.0, 0.0, 1.0)), ink.a * clamp(radius + 0.5 - away, 0.0, 1.0));
}

// A disc of so many pixels about each place that is seen.
layout(location = 0) in vec3 place;
layout(location = 0) uniform vec2 viewport;
layout(location = 1) uniform float radius;
layout(binding = 6) uniform usamplerBuffer seen;
noperspective out vec2 fromMiddle;  // pixels
void main() {
  vec3 d = (vec3(place.xy, place.z * lens.w) - eyeHigh.xyz) - eyeLow.xyz;
  vec3 p = inView(d);
  float w = isParallel() ? 1.0 : p.z;
  fromMiddle = (vec2(gl_VertexID >> 1, gl_VertexID & 1) * 2.0 - 1.0) * (radius + 1.0);
  bool isSeen = texelFetch(seen, gl_InstanceID).r != 0u && w > 0.0;
  gl_Position = isSeen ? vec4(p.xy * lens.xy + fromMiddle * 2.0 / viewport * w, 0.0, w) : vec4(0.0, 0.0, 0.0, -1.0);
}

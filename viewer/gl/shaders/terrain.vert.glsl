layout(location = 0) in vec3 position;  // metric space
layout(location = 1) in float rise;     // of a moving vertex, in units of height
out vec3 place;
out vec3 fromEye;
void main() {
  place = vec3(position.xy, position.z + rise * metricScale.z);
  fromEye = (vec3(place.xy, place.z * lens.w) - eyeHigh.xyz) - eyeLow.xyz;
  // Depth is near / depth: 1 at the near plane, 0 at infinity, as fine far away as floats are.
  gl_Position = vec4(dot(fromEye, right.xyz) * lens.x, dot(fromEye, up.xyz) * lens.y, lens.z,
                     dot(fromEye, forward.xyz));
}

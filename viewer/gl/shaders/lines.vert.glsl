layout(location = 0) in vec3 position;
layout(location = 1) in vec4 ink;
out vec4 lineColor;
void main() {
  vec3 d = (vec3(position.xy, position.z * lens.w) - eyeHigh.xyz) - eyeLow.xyz;
  lineColor = ink;
  // A little nearer than it is, so that what lies on the ground is seen.
  gl_Position = clipOf(inView(d), 1.0005);
}

// Places whose visibility is asked for.
layout(location = 0) in vec3 place;
flat out int index;
void main() {
  index = gl_VertexID;
  vec3 p = inView(liftedFromEye(place));
  gl_Position = vec4(p.xy * lens.xy, lens.z * nearer(1.0), p.z);
}

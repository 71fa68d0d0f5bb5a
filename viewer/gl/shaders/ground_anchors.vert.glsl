// Places whose visibility is asked for.
layout(location = 0) in vec3 place;
flat out int index;
void main() {
  index = gl_VertexID;
  vec3 p = inView(liftedFromEye(place));
  gl_Position = clipOf(p, nearer(1.0));
}

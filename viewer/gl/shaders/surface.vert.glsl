layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;  // zero: the triangle's own
layout(location = 2) in vec4 coords;  // two sets
layout(location = 3) in vec4 ink;     // sRGB and alpha
out vec3 fromEye;
out vec3 shadingNormal;
out vec4 textureCoords;
out vec4 vertexColor;
void main() {
  fromEye = (position - eyeHigh.xyz) - eyeLow.xyz;
  shadingNormal = normal;
  textureCoords = coords;
  vertexColor = ink;
  gl_Position = clipOf(inView(fromEye), 1.0);
}

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
  // Depth is near / depth: 1 at the near plane, 0 at infinity.
  gl_Position = vec4(dot(fromEye, right.xyz) * lens.x, dot(fromEye, up.xyz) * lens.y, lens.z,
                     dot(fromEye, forward.xyz));
}

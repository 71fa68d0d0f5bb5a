// A text of the atlas, as a rectangle of whole pixels of the screen.
layout(location = 0) in vec4 box;     // left, top, width, height in pixels of the picture, y downwards
layout(location = 1) in vec2 corner;  // of it in the atlas
layout(location = 2) in vec4 ink;
layout(location = 0) uniform vec2 viewport;
out vec2 texel;
flat out vec4 textInk;
flat out vec4 bounds;
void main() {
  vec2 part = vec2(gl_VertexID >> 1, gl_VertexID & 1) * box.zw;
  texel = corner + part;
  textInk = ink;
  bounds = vec4(corner, corner + box.zw);
  vec2 at = (box.xy + part) / viewport;
  gl_Position = vec4(2.0 * at.x - 1.0, 1.0 - 2.0 * at.y, 0.0, 1.0);
}

// A picture over the picture, its first row on top, multiplied by its opacity.
in vec2 screen;
layout(location = 0) out vec4 color;
layout(binding = 0) uniform sampler2D picture;
void main() { color = texture(picture, vec2(0.5, -0.5) * screen + 0.5); }

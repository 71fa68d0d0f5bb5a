noperspective in float across;
layout(location = 0) out vec4 color;
layout(location = 1) uniform float width;
layout(location = 2) uniform vec4 ink;
void main() {
  color = vec4(ink.rgb, ink.a * clamp(0.5 * width + 0.5 - abs(across), 0.0, 1.0));
}

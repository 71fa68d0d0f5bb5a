in vec2 screen;
layout(location = 0) out vec4 color;
void main() { color = vec4(mix(vec3(0.80, 0.82, 0.84), vec3(0.95, 0.96, 0.97), 0.5 + 0.5 * screen.y), 1.0); }

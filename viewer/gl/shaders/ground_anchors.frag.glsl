layout(early_fragment_tests) in;
flat in int index;
layout(std430, binding = 12) writeonly buffer Seen { uint seen[]; };
void main() { seen[index] = 1u; }

// Puts rises where they belong: pairs of a vertex and its rise.
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Changes { uvec2 change[]; };
layout(std430, binding = 4) writeonly buffer Rises { float rise[]; };
layout(location = 0) uniform uint count;
void main() {
  uint i = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
  if (i < count) rise[change[i].x] = uintBitsToFloat(change[i].y);
}

// The root's triangles that are left.
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Roots { uint rootCorner[]; };
void main() {
  uint t = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
  bool isIn = t < rootTriangles && !isMember(remover[t]);
  uint place = placeFor(isIn ? 1u : 0u);
  if (isIn) put(place, t, uvec3(rootCorner[3u * t], rootCorner[3u * t + 1u], rootCorner[3u * t + 2u]));
}

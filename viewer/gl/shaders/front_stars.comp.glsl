// A group a listed block, a thread a node: what is left of its star.
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer Links { uint link[]; };
layout(std430, binding = 5) readonly buffer Nodes { uvec2 node[]; };
layout(std430, binding = 6) readonly buffer Blocks { uint listedBlock[]; };
void main() {
  uint listed = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  uint n = listed < blocks ? listedBlock[listed] * 64u + gl_LocalInvocationID.x : nodes;
  uint begin = 0u, end = 0u, count = 0u;
  if (isMember(n)) {
    begin = node[n].y;
    end = node[n + 1u].y;
    for (uint s = begin; s < end; ++s) count += isMember(remover[rootTriangles + s]) ? 0u : 1u;
  }
  uint place = placeFor(count);
  for (uint s = begin; s < end; ++s)
    if (!isMember(remover[rootTriangles + s]))
      put(place++, rootTriangles + s, uvec3(rootVertices + n, link[s], link[s + 1u < end ? s + 1u : begin]));
}

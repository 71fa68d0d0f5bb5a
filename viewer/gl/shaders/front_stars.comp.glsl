// What is left of the stars of members.
layout(std430, binding = 0) readonly buffer Links { uint link[]; };
layout(std430, binding = 5) readonly buffer Nodes { uvec2 node[]; };
void main() {
  uint n = listedNode();
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

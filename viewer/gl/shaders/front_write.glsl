// Of writing: a triangle is in the front when its creator is a member and its remover is none.
layout(std430, binding = 1) readonly buffer Removers { uint remover[]; };
layout(std430, binding = 2) readonly buffer Members { uint member[]; };
layout(std430, binding = 3) writeonly buffer Indices { uint indexOut[]; };
layout(std430, binding = 4) writeonly buffer TriangleIds { uint idOut[]; };
bool isMember(uint n) { return n < nodes && (member[n >> 5] >> (n & 31u) & 1u) == 1u; }
shared uint next, base;
/// A place for so many triangles of this thread, after those of the threads before it.
uint placeFor(uint count) {
  if (gl_LocalInvocationID.x == 0u) next = 0u;
  barrier();
  uint place = atomicAdd(next, count);
  barrier();
  if (gl_LocalInvocationID.x == 0u) base = atomicAdd(emitted, next);
  barrier();
  return halfInUse * capacity + base + place;
}
void put(uint place, uint id, uvec3 corners) {
  indexOut[3u * place] = corners.x;
  indexOut[3u * place + 1u] = corners.y;
  indexOut[3u * place + 2u] = corners.z;
  idOut[place] = id;
}

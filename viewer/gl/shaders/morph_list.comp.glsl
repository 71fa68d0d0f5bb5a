// Which members move (engine/morph/geomorph.h): those of less than twice the cut's pixels. The others rest.
layout(std430, binding = 0) readonly buffer NodeBalls { vec4 nodeBall[]; };
layout(std430, binding = 1) readonly buffer Nodes { uvec2 node[]; };
layout(std430, binding = 2) readonly buffer Members { uint member[]; };
layout(std430, binding = 3) readonly buffer Morphs { uint morphWord[]; };  // 3 corners, 2 weights, detail
layout(std430, binding = 4) writeonly buffer Offsets { float offset[]; };
layout(std430, binding = 5) writeonly buffer Moving { uvec4 movingNode[]; };
void main() {
  uint n = listedNode();
  if (n >= nodes || (member[n >> 5] >> (n & 31u) & 1u) == 0u) return;
  float perUnit = morph.z / max(reachOver(nodeBall[n]), 1e-30);  // pixels of a unit of height
  float ratio = abs(uintBitsToFloat(node[n].x)) * perUnit / morph.x;
  float rest = clamp(2.0 - ratio, 0.0, 1.0);
  uint at = rest > 0.0 && morph.w > 0.0 ? atomicAdd(moving, 1u) : movingCapacity;
  if (at >= movingCapacity) {
    offset[rootVertices + n] = 0.0;
    return;
  }
  movingNode[at] = uvec4(n, floatBitsToUint(-rest * uintBitsToFloat(morphWord[6u * n + 5u])),
                         floatBitsToUint(morph.y / perUnit), 0u);
}

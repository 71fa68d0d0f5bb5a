// One step towards the offsets of the moving vertices, each from those of the corners it stands between.
// Repeated: ancestors move before their descendants, so as many steps as the longest chain of moving nodes
// reach the end, from whatever was there.
layout(local_size_x = 64) in;
layout(std430, binding = 3) readonly buffer Morphs { uint morphWord[]; };
layout(std430, binding = 4) coherent buffer Offsets { float offset[]; };
layout(std430, binding = 5) readonly buffer Moving { uvec4 movingNode[]; };
void main() {
  uint i = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationID.x;
  if (i >= min(moving, movingCapacity)) return;
  uvec4 m = movingNode[i];
  uint at = 6u * m.x;
  float a = uintBitsToFloat(morphWord[at + 3u]), b = uintBitsToFloat(morphWord[at + 4u]);
  float carried = a * offset[morphWord[at]] + b * offset[morphWord[at + 1u]] +
                  (1.0 - a - b) * offset[morphWord[at + 2u]];
  float most = uintBitsToFloat(m.z);
  offset[rootVertices + m.x] = clamp(carried + uintBitsToFloat(m.y), -most, most);
}

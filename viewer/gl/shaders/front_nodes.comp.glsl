// A group a block, a thread a node: the bits of the members, the list of blocks that have some, the number of
// triangles that the front will have (a vertex inside adds two, one on a border one).
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer BlockBalls { vec4 blockBall[]; };
layout(std430, binding = 1) readonly buffer BlockErrors { float blockError[]; };
layout(std430, binding = 2) readonly buffer Pages { uint listedPage[]; };
layout(std430, binding = 3) readonly buffer NodeBalls { vec4 nodeBall[]; };
layout(std430, binding = 4) readonly buffer Nodes { uvec2 node[]; };  // error (its sign: on a border), first slot
layout(std430, binding = 5) writeonly buffer Members { uint member[]; };
layout(std430, binding = 6) writeonly buffer Blocks { uint listedBlock[]; };
layout(location = 0) uniform uint blockCount;
shared bool mayHave;
shared uint bits[2], added;
void main() {
  uint block = listedPage[gl_WorkGroupID.y] * 16u + gl_WorkGroupID.x, i = gl_LocalInvocationID.x;
  if (i == 0u) {
    bits[0] = bits[1] = added = 0u;
    mayHave = block < blockCount && exceeds(blockBall[block], blockError[block]);
  }
  barrier();
  uint n = block * 64u + i;
  if (mayHave && n < nodes) {
    float error = uintBitsToFloat(node[n].x);
    if (exceeds(nodeBall[n], abs(error))) {
      atomicOr(bits[i / 32u], 1u << (i % 32u));
      atomicAdd(added, (node[n].x >> 31) == 1u ? 1u : 2u);
    }
  }
  barrier();
  if (i == 0u && (bits[0] | bits[1]) != 0u) {
    member[2u * block] = bits[0];
    member[2u * block + 1u] = bits[1];
    listedBlock[atomicAdd(blocks, 1u)] = block;
    atomicAdd(triangles, added);
  }
}

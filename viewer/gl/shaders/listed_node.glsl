// A group a listed block, a thread a node of it.
layout(local_size_x = 64) in;
layout(std430, binding = 6) readonly buffer Blocks { uint listedBlock[]; };
/// The node of this thread; none beyond the list.
uint listedNode() {
  uint listed = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  return listed < blocks ? listedBlock[listed] * 64u + gl_LocalInvocationID.x : nodes;
}

// Lists the pages of nodes that may have members: a thread a page.
layout(local_size_x = 64) in;
layout(std430, binding = 0) readonly buffer BlockBalls { vec4 blockBall[]; };
layout(std430, binding = 1) readonly buffer BlockErrors { float blockError[]; };
layout(std430, binding = 2) writeonly buffer Pages { uint listedPage[]; };
layout(location = 0) uniform uint firstPage;
layout(location = 1) uniform uint pageCount;
void main() {
  uint page = gl_GlobalInvocationID.x;
  if (page >= pageCount) return;
  if (exceeds(blockBall[firstPage + page], blockError[firstPage + page]))
    listedPage[atomicAdd(pages, 1u)] = page;
}

// What the passes of a cut tell each other (viewer/gl/compute_front.cpp). The first words are the indirect
// draw and the indirect dispatches.
layout(std430, binding = 7) buffer State {
  uint drawCount, drawInstances, drawFirst, drawBaseVertex, drawBaseInstance;
  uint pagesX, pages, pagesZ;     // 16 blocks each
  uint blocksX, blocksY, blocksZ; // those with members
  uint rootsX, rootsY, rootsZ;
  uint movingX, movingY, movingZ;
  uint blocks, triangles, emitted, moving, halfInUse, isComplete, capacity;
  uint rootTriangles, rootVertices, nodes, movingCapacity;
};

// The front is written where the last one is not, and only when all of it fits: else the last one stays, which
// is coarser or finer, but whole.
layout(local_size_x = 1) in;
void main() {
  isComplete = triangles <= capacity ? 1u : 0u;
  if (isComplete == 1u) halfInUse = 1u - halfInUse;
  uint side = 1024u, rows = isComplete * ((blocks + side - 1u) / side);
  blocksX = min(blocks, side); blocksY = rows; blocksZ = 1u;
  rootsX = isComplete * min((rootTriangles + 63u) / 64u, side);
  rootsY = isComplete * ((rootTriangles + 64u * side - 1u) / (64u * side)); rootsZ = 1u;
}

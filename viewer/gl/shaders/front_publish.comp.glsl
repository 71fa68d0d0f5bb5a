// The front is drawn from now on.
layout(local_size_x = 1) in;
void main() {
  if (isComplete == 1u) {
    drawCount = 3u * emitted; drawInstances = 1u; drawFirst = 3u * halfInUse * capacity;
    drawBaseVertex = 0u; drawBaseInstance = 0u;
  }
  uint side = 1024u, groups = (min(moving, movingCapacity) + 63u) / 64u;
  movingX = min(groups, side); movingY = (groups + side - 1u) / side; movingZ = 1u;
}

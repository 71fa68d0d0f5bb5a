// Before a cut: nothing is listed yet.
layout(local_size_x = 1) in;
void main() {
  pagesX = 16u; pages = 0u; pagesZ = 1u;
  blocks = 0u; triangles = rootTriangles; emitted = 0u; moving = 0u;
}

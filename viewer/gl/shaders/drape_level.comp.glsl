// A level of a drape from the one that is twice as fine (viewer/gl/drape_on_gpu.cpp): a thread a texel, borders
// included.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba8) readonly uniform image2DArray fine;
layout(binding = 1, rgba8) writeonly uniform image2DArray coarse;
layout(location = 0) uniform ivec4 from;  // first layer, tiles across, pixels across and down
layout(location = 1) uniform ivec4 to;
layout(location = 2) uniform int inner;

vec4 fineAt(ivec2 pixel) {
  pixel = min(pixel, from.zw - 1);
  ivec2 tile = pixel / inner;
  return imageLoad(fine, ivec3(pixel - tile * inner + 1, from.x + tile.y * from.y + tile.x));
}

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  int index = int(gl_GlobalInvocationID.z);
  if (any(greaterThanEqual(texel, ivec2(inner + 2)))) return;
  ivec2 tile = ivec2(index % to.y, index / to.y);
  ivec2 p = 2 * clamp(tile * inner + texel - 1, ivec2(0), to.zw - 1);
  vec4 sum = fineAt(p) + fineAt(p + ivec2(1, 0)) + fineAt(p + ivec2(0, 1)) + fineAt(p + ivec2(1, 1));
  imageStore(coarse, ivec3(texel, to.x + index), sum / 4.0);
}

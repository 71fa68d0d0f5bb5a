// A level of a drape from a finer one (viewer/gl/drape_on_gpu.cpp): a thread a texel, borders included. Colours are
// averaged over the four texels of the level that is twice as fine; of classes the one with most texels is taken.
layout(local_size_x = 8, local_size_y = 8) in;
layout(binding = 0, rgba8) readonly uniform image2DArray fine;
layout(binding = 1, rgba8) writeonly uniform image2DArray coarse;
layout(location = 0) uniform ivec4 from;  // first layer, tiles across, pixels across and down
layout(location = 1) uniform ivec4 to;
layout(location = 2) uniform int inner;
layout(location = 3) uniform int classLevels;  // 0: colours; how many levels finer `from` is

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
  ivec2 place = clamp(tile * inner + texel - 1, ivec2(0), to.zw - 1);
  if (classLevels == 0) {
    ivec2 p = 2 * place;
    vec4 sum = fineAt(p) + fineAt(p + ivec2(1, 0)) + fineAt(p + ivec2(0, 1)) + fineAt(p + ivec2(1, 1));
    imageStore(coarse, ivec3(texel, to.x + index), sum / 4.0);
    return;
  }
  ivec2 p = place << classLevels, end = min(p + (1 << classLevels), from.zw);
  uint seen[64];
  int count = 0;
  for (int y = p.y; y < end.y; ++y)
    for (int x = p.x; x < end.x; ++x) seen[count++] = packUnorm4x8(fineAt(ivec2(x, y)));
  // Of classes with equally many texels the one that comes first.
  uint most = seen[0];
  int best = 0;
  for (int i = 0; i + best < count; ++i) {
    int same = 0;
    for (int k = i; k < count; ++k) same += seen[k] == seen[i] ? 1 : 0;
    if (same > best) {
      best = same;
      most = seen[i];
    }
  }
  imageStore(coarse, ivec3(texel, to.x + index), unpackUnorm4x8(most));
}

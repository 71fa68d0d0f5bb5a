// Heights, slopes and aspects of full resolution at a place on the ground (viewer/heights/height_pyramid.h,
// viewer/gl/heights_on_gpu.h). Places are counted in nodes of level 0 from the one under the eye, so that
// places close to it are exact.
layout(binding = 14) uniform sampler2DArray groundHeights;
layout(binding = 15) uniform sampler2DArray groundSlopes;  // slope, east, north, each times covered; covered
layout(std140, binding = 4) uniform Ground {
  ivec4 groundTiles;      // side of a tile, levels, the finest that is there, 1 = cells are their two triangles
  ivec4 groundEye;        // the node under the eye
  vec4 groundStep;        // nodes a unit of metric space; where in its cell the eye is
  vec4 groundSpare;
  ivec4 groundLevel[16];  // first layer, tiles across, columns, rows
};

const float kNoHeight = -1e38;  // less is no height

float groundFetch(int level, ivec2 node) {
  node = clamp(node, ivec2(0), groundLevel[level].zw - 1);
  int inner = groundTiles.x - 1;
  ivec2 tile = node / inner;
  return texelFetch(groundHeights, ivec3(node - tile * inner, groundLevel[level].x + tile.y * groundLevel[level].y + tile.x), 0).r;
}

/// The node of a level that is left of a place and above it, and how far beyond it the place is, in its nodes.
ivec2 groundNode(int level, vec2 at, out vec2 part) {
  // At level k a place p is (p + 1/2) / 2^k - 1/2.
  ivec2 whole = groundEye.xy + ivec2(floor(at)) - ((1 << level) >> 1);
  ivec2 node = whole >> level;
  part = (vec2(whole - (node << level)) + fract(at) + (level > 0 ? 0.5 : 0.0)) / float(1 << level);
  ivec2 last = groundLevel[level].zw - 1;
  if (node.x < 0) { node.x = 0; part.x = 0.0; }
  if (node.y < 0) { node.y = 0; part.y = 0.0; }
  if (node.x >= last.x) { node.x = max(last.x - 1, 0); part.x = last.x > 0 ? 1.0 : 0.0; }
  if (node.y >= last.y) { node.y = max(last.y - 1, 0); part.y = last.y > 0 ? 1.0 : 0.0; }
  return node;
}

/// At one level; less than kNoHeight where there is none. At level 0 on the triangle of the cell, elsewhere
/// between the means of four nodes, as far as they have data.
float groundHeight(int level, vec2 at) {
  vec2 f;
  ivec2 n = groundNode(level, at, f);
  float a = groundFetch(level, n), b = groundFetch(level, n + ivec2(1, 0));
  float c = groundFetch(level, n + ivec2(0, 1)), d = groundFetch(level, n + ivec2(1, 1));
  bvec4 has = greaterThan(vec4(a, b, c, d), vec4(kNoHeight));
  if (level == 0) {
    if (has.x && has.w) {
      if (has.y && (f.x >= f.y || !has.z)) return a + f.x * (b - a) + f.y * (d - b);
      if (has.z) return a + f.x * (d - c) + f.y * (c - a);
    } else if (has.y && has.z) {
      if (has.x) return a + f.x * (b - a) + f.y * (c - a);
      if (has.w) return d + (1.0 - f.x) * (c - d) + (1.0 - f.y) * (b - d);
    }
  }
  if (all(has)) {
    float above = a + f.x * (b - a), under = c + f.x * (d - c);
    return above + f.y * (under - above);
  }
  vec4 weights = vec4((1.0 - f.x) * (1.0 - f.y), f.x * (1.0 - f.y), (1.0 - f.x) * f.y, f.x * f.y) * vec4(has);
  float sum = weights.x + weights.y + weights.z + weights.w;
  if (level == 0 || sum < 1e-6) return 2.0 * kNoHeight;
  float from = has.x ? a : has.y ? b : has.z ? c : d;
  return from + dot(weights, (vec4(a, b, c, d) - from) * vec4(has)) / sum;
}

// Loops and not calls: each call is compiled anew, which takes a software renderer seconds.
float groundHeightAt(float lod, vec2 at) {
  int fine = int(lod);
  float height = 2.0 * kNoHeight, part = lod - float(fine);
  for (int level = fine; level <= (part > 0.0 ? fine + 1 : fine); ++level) {
    float found = groundHeight(level, at);
    if (height < kNoHeight) height = found;
    else if (found > kNoHeight) height += part * (found - height);
  }
  return height;
}

vec4 groundSlope(int level, vec2 at) {
  vec2 f;
  ivec2 n = groundNode(level, at, f);
  int side = groundTiles.x, inner = side - 1;
  ivec2 tile = n / inner;
  return textureLod(groundSlopes, vec3((vec2(n - tile * inner) + f + 0.5) / float(side), float(groundLevel[level].x + tile.y * groundLevel[level].y + tile.x)), 0.0);
}

/// What a pixel of the screen covers of the ground, in nodes: its place, the ways to the places of the next
/// pixels, the longer axis of what it covers and the lengths of both axes; metric units to the next pixels.
struct Sight { vec2 at, dx, dy, axis; float longer, shorter, run; };
Sight sightOf(vec2 overGround) {
  Sight s;
  s.at = overGround * groundStep.xy + groundStep.zw;
  vec2 right = dFdx(overGround), up = dFdy(overGround);
  s.run = sqrt(0.5 * (dot(right, right) + dot(up, up)));
  s.dx = right * groundStep.xy;
  s.dy = up * groundStep.xy;
  float xx = s.dx.x * s.dx.x + s.dy.x * s.dy.x, yy = s.dx.y * s.dx.y + s.dy.y * s.dy.y, xy = s.dx.x * s.dx.y + s.dy.x * s.dy.y;
  float middle = 0.5 * (xx + yy), apart = 0.5 * (xx - yy), around = sqrt(apart * apart + xy * xy);
  s.shorter = sqrt(max(middle - around, 0.0));
  // A triangle that is seen along itself covers ground without end: eight times the shorter axis of it count.
  s.longer = min(sqrt(middle + around), 8.0 * max(s.shorter, 0.25));
  vec2 axis = apart >= 0.0 ? vec2(apart + around, xy) : vec2(xy, around - apart);
  s.axis = axis * (s.longer / max(length(axis), 1e-30));
  return s;
}

float groundLod(float nodes) {
  return clamp(log2(max(nodes, 1e-6)), float(groundTiles.z), float(groundTiles.y - 1));
}

/// Means over the pixel: up to 4 places along the longer axis, each at the level whose nodes are as far apart as
/// the shorter one is long. x: the height; less than kNoHeight where there is none.
float groundMeanHeight(Sight pixel) {
  int count = int(clamp(ceil(pixel.longer / max(pixel.shorter, 1.0) - 0.01), 1.0, 4.0));
  float lod = groundLod(max(pixel.longer / float(count), pixel.shorter)), sum = 0.0, found = 0.0;
  for (int i = 0; i < count; ++i) {
    float height = groundHeightAt(lod, pixel.at + ((float(i) + 0.5) / float(count) - 0.5) * pixel.axis);
    if (height > kNoHeight) { sum += height; found += 1.0; }
  }
  return found > 0.0 ? sum / found : 2.0 * kNoHeight;
}

/// x: the mean angle of slopes, 1 = 90 degrees; yz: the mean unit vector downhill, east and north; w: 0 = no data.
vec4 groundMeanSlope(Sight pixel) {
  int count = int(clamp(ceil(pixel.longer / max(pixel.shorter, 1.0) - 0.01), 1.0, 4.0));
  float lod = groundLod(max(pixel.longer / float(count), pixel.shorter));
  int fine = int(lod), coarse = lod > float(fine) ? fine + 1 : fine;
  vec4 sum = vec4(0.0);
  for (int i = 0; i < count; ++i) {
    vec2 place = pixel.at + ((float(i) + 0.5) / float(count) - 0.5) * pixel.axis;
    for (int level = fine; level <= coarse; ++level)
      sum += (level == fine ? float(fine) + 1.0 - lod : lod - float(fine)) * groundSlope(level, place);
  }
  return sum.w > 0.0 ? vec4(sum.xyz / sum.w, 1.0) : vec4(0.0);
}

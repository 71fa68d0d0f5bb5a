// An edge of a line as a band some pixels wide, whose ends meet those of its neighbours in a mitre.
layout(location = 0) in vec4 before;  // vertices; w > 0: joined to the next one
layout(location = 1) in vec4 from;
layout(location = 2) in vec4 to;
layout(location = 3) in vec4 after;
layout(location = 0) uniform vec2 viewport;
layout(location = 1) uniform float width;
noperspective out float across;  // pixels from the middle

vec2 onScreen(vec3 p) { return p.xy / (isParallel() ? 1.0 : p.z) * lens.xy * 0.5 * viewport; }

vec2 acrossOf(vec2 a, vec2 b) {
  vec2 d = b - a;
  float size = length(d);
  return size > 1e-6 ? vec2(-d.y, d.x) / size : vec2(0.0);
}

/// The half width of a mitre between two edges; the edge's own where they turn too sharply.
vec2 mitre(vec2 here, vec2 other) {
  vec2 sum = here + other;
  float size = dot(sum, sum);
  return dot(other, other) < 0.5 || size < 1.0 ? here : sum * (2.0 / size);
}

void main() {
  vec3 a = inView(liftedFromEye(from.xyz)), b = inView(liftedFromEye(to.xyz));
  float near = isParallel() ? -1e30 : lens.z * 1.01;
  gl_Position = vec4(0.0, 0.0, 0.0, -1.0);  // clipped
  across = 0.0;
  if (!(from.w > 0.0) || (a.z < near && b.z < near)) return;
  bool aIsCut = a.z < near, bIsCut = b.z < near;
  vec3 wholeA = a, wholeB = b;
  if (aIsCut) a = mix(wholeA, wholeB, (near - wholeA.z) / (wholeB.z - wholeA.z));
  if (bIsCut) b = mix(wholeB, wholeA, (near - wholeB.z) / (wholeA.z - wholeB.z));
  vec2 sa = onScreen(a), sb = onScreen(b), side = acrossOf(sa, sb);
  bool isEnd = gl_VertexID >= 2;
  vec2 offset = side;
  if (!isEnd && !aIsCut && before.w > 0.0) {
    vec3 p = inView(liftedFromEye(before.xyz));
    if (p.z >= near) offset = mitre(side, acrossOf(onScreen(p), sa));
  }
  if (isEnd && !bIsCut && to.w > 0.0) {
    vec3 p = inView(liftedFromEye(after.xyz));
    if (p.z >= near) offset = mitre(side, acrossOf(sb, onScreen(p)));
  }
  float half_ = 0.5 * width + 0.5;
  across = (gl_VertexID & 1) == 0 ? half_ : -half_;
  vec3 p = isEnd ? b : a;
  vec2 s = (isEnd ? sb : sa) + across * offset;
  gl_Position = clipOf(p, nearer(half_));
  gl_Position.xy = s / (0.5 * viewport) * gl_Position.w;
}

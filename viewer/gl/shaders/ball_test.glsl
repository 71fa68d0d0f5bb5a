// Whether an error exceeds what the view allows over a ball: engine/criteria/frustum_filter.cpp and engine/criteria/view.cpp
// say how and why. Single precision decides where its windows allow, double precision the rest, by the very
// formulas of the CPU, so that the cut is closed however a device rounds.
bool exceedsExactly(vec4 ball, float error) {
  precise dvec3 c = dvec3(ball.xyz);
  c.z *= double(lens.w);
  precise double radius = double(ball.w) * max(1.0lf, double(lens.w));
  precise dvec3 d = c - eyeExact.xyz;
  precise dvec3 p = dvec3(d.x * rightExact.x + d.y * rightExact.y + d.z * rightExact.z,
                          d.x * upExact.x + d.y * upExact.y + d.z * upExact.z,
                          d.x * forwardExact.x + d.y * forwardExact.y + d.z * forwardExact.z);
  if (!(abs(p.x) - sidesExact.x * p.z - halvesExact.x <= radius * sidesExact.z &&
        abs(p.y) - sidesExact.y * p.z - halvesExact.y <= radius * sidesExact.w && p.z + radius >= reachExact.x &&
        p.z - radius <= reachExact.y))
    return false;
  if (isParallel()) return double(error) > reachExact.w;
  precise double byDepth = max(p.z - radius, reachExact.x) * reachExact.z;
  precise double squared = p.x * p.x + p.y * p.y + p.z * p.z;
  precise double distance = sqrt(squared);
  precise double nearest = distance - radius;
  precise double allowed = byDepth;
  if (nearest > 0.0lf) {
    precise double cosine = p.z / distance;
    precise double sine = sqrt(max(0.0lf, 1.0lf - cosine * cosine));
    precise double ballSine = radius / distance;
    precise double ballCosine = sqrt(max(0.0lf, 1.0lf - ballSine * ballSine));
    precise double reached = max(reachExact.z, cosine * ballCosine - sine * ballSine);
    allowed = max(byDepth, nearest * reached * reached);
  }
  return double(error) > allowed * reachExact.w;
}

/// z^2 / distance over the ball, at least about so much (to single precision).
float reachOver(vec4 ball) {
  if (isParallel()) return 1.0;
  vec3 d = (vec3(ball.xy, ball.z * lens.w) - eyeHigh.xyz) - eyeLow.xyz;
  float radius = ball.w * max(1.0, lens.w);
  vec3 p = vec3(dot(d, right.xyz), dot(d, up.xyz), dot(d, forward.xyz));
  float fromAxis = p.x * p.x + p.y * p.y, squared = fromAxis + p.z * p.z;
  float distance = sqrt(squared), nearest = distance - radius;
  float byDepth = max(p.z - radius, reach.x) * reach.z;
  if (!(nearest > 0.0)) return max(byDepth, 0.0);
  float cosine = (p.z * sqrt(max(nearest * (distance + radius), 0.0)) - sqrt(fromAxis) * radius) / squared;
  float reached = max(cosine, reach.z);
  return max(nearest * reached * reached, byDepth);
}

bool exceeds(vec4 ball, float error) {
  vec3 d = (vec3(ball.xy, ball.z * lens.w) - eyeHigh.xyz) - eyeLow.xyz;
  float radius = ball.w * max(1.0, lens.w);
  vec3 p = vec3(dot(d, right.xyz), dot(d, up.xyz), dot(d, forward.xyz));
  float fromAxis = p.x * p.x + p.y * p.y, squared = fromAxis + p.z * p.z;
  float distance = sqrt(squared), nearest = distance - radius, size = distance + radius;
  if (!(squared > 1e-30 && squared < 1e30) || reach.z < 0.05) return exceedsExactly(ball, error);
  float slack = 1e-5 * size;

  float covering = sqrt(max(nearest * size, 0.0));
  float cosine = (p.z * covering - sqrt(fromAxis) * radius) / squared;
  float reached = max(cosine, reach.z);
  float byAngle = nearest * reached * reached;
  bool isClose = nearest <= 1e-3 * distance;
  float depth = p.z - radius;
  float low = max(isClose ? 0.0 : byAngle * 0.998, max(depth - slack, reach.x) * reach.z) * reach.w * 0.9999;
  float high = max(isClose ? 1.1e-3 * distance : byAngle * 1.002, max(depth + slack, reach.x) * reach.z) *
               reach.w * 1.0001;
  if (isParallel()) low = reach.w * 0.9999, high = reach.w * 1.0001;

  vec4 beyond = vec4(abs(p.x) - sides.x * p.z - parallel.x - radius * sides.z, abs(p.y) - sides.y * p.z - parallel.y - radius * sides.w,
                     reach.x - p.z - radius, depth - reach.y);
  vec4 window = vec4(slack * (1.0 + sides.x), slack * (1.0 + sides.y), slack, slack);
  if (any(greaterThan(beyond, window)) || !(error > low)) return false;
  if (all(lessThan(beyond, -window)) && error > high) return true;
  return exceedsExactly(ball, error);
}

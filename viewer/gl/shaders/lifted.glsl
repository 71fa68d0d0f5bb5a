// Where a place on the ground is drawn, seen from the eye: raised by the tolerance of the drawn terrain, which may be
// so much higher there.
vec3 liftedFromEye(vec3 place) {
  vec3 d = (vec3(place.xy, place.z * lens.w) - eyeHigh.xyz) - eyeLow.xyz;
  float pixelsPerUnit = morph.z / (abs(metricScale.z) * earth.x);
  return d + upAt(place) * ((morph.x + morph.y) * reachAt(d) / pixelsPerUnit);
}

/// How much nearer something of so many pixels is drawn than it is, so that a slope beside it does not cut it.
float nearer(float pixels) {
  float pixelsHigh = 2.0 * parallel.y * morph.z / (abs(metricScale.z) * earth.x);
  return isParallel() ? 1.0003 + 2.0 * pixels / pixelsHigh : 1.0003 + 2.0 * pixels * abs(metricScale.z) * earth.x / morph.z;
}

// Where a place on the ground is drawn, seen from the eye: raised by the tolerance of the drawn terrain, which may be
// so much higher there.
vec3 liftedFromEye(vec3 place) {
  vec3 d = (vec3(place.xy, place.z * lens.w) - eyeHigh.xyz) - eyeLow.xyz;
  float depth = dot(d, forward.xyz);
  float pixelsPerUnit = morph.z / (abs(metricScale.z) * earth.x);
  return d + upAt(place) * ((morph.x + morph.y) * depth * depth / (max(length(d), 1e-6) * pixelsPerUnit));
}

vec3 inView(vec3 fromEye) {
  return vec3(dot(fromEye, right.xyz), dot(fromEye, up.xyz), dot(fromEye, forward.xyz));
}

/// How much nearer something of so many pixels is drawn than it is, so that a slope beside it does not cut it.
float nearer(float pixels) {
  return 1.0003 + 2.0 * pixels * abs(metricScale.z) * earth.x / morph.z;
}

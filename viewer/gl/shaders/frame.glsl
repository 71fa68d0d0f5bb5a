// What a frame is told, the same for all programs (viewer/gl/frame_block.h). Metric space of the MT, heights
// multiplied by `stretch` on the way; or, on a curved Earth, the space of its ground, where they are already.
layout(std140, binding = 0) uniform Frame {
  vec4 eyeHigh, eyeLow;         // the eye as the sum of two floats
  vec4 right, up, forward;      // unit vectors; right is right on the screen
  vec4 lens;                    // 1 / slopeX, 1 / slopeY, depth of the near plane, stretch (1 on a curved Earth)
  vec4 sides;                   // slopeX, slopeY, lengthX, lengthY (engine/criteria/view.h)
  vec4 reach;                   // near, far, least cosine, error per reach
  vec4 morph;                   // pixels of the cut, pixels to move by, pixels per unit of height and reach, 1 = on
  vec4 earth;                   // vertical exaggeration, the Earth's radius or 0 where it is flat
  dvec4 eyeExact;
  dvec4 rightExact, upExact, forwardExact;
  dvec4 sidesExact, reachExact;
  dvec4 halvesExact;               // halfX, halfY
  vec4 metricOrigin, metricScale;  // of the flat space
  vec4 eyeGround;                  // x, y of the eye there, each as the sum of two floats
  vec4 parallel;                   // halfX, halfY, 1 = parallel projection, 1 / length of the depths that are drawn
};

bool isParallel() { return parallel.z > 0.0; }

vec3 inView(vec3 fromEye) {
  return vec3(dot(fromEye, right.xyz), dot(fromEye, up.xyz), dot(fromEye, forward.xyz));
}

/// Where a place in the eye's axes is drawn, as if it were `nearer` times nearer; in parallel projection a part of
/// the picture's height nearer. Depth is near / depth: 1 at the near plane, 0 at infinity, as fine far away as floats
/// are; in parallel projection it falls evenly over the depths that are drawn, 1/2 at the eye.
vec4 clipOf(vec3 p, float nearer) {
  return isParallel() ? vec4(p.xy * lens.xy, 0.5 - (p.z - (nearer - 1.0) * 2.0 * parallel.y) * parallel.w, 1.0)
                      : vec4(p.xy * lens.xy, lens.z * nearer, p.z);
}

/// The unit vector to the eye.
vec3 towardsEye(vec3 fromEye) {
  return isParallel() ? -forward.xyz : -normalize(fromEye);
}

/// depth^2 / distance, by which a displacement is smaller in the picture; 1 in parallel projection.
float reachAt(vec3 fromEye) {
  float depth = dot(fromEye, forward.xyz);
  return isParallel() ? 1.0 : depth * depth / max(length(fromEye), 1e-6);
}

/// Upwards at a position.
vec3 upAt(vec3 position) {
  return earth.y > 0.0 ? normalize(position + vec3(0.0, 0.0, earth.y)) : vec3(0.0, 0.0, 1.0);
}

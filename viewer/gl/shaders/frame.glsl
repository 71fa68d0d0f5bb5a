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
  vec4 metricOrigin, metricScale;  // of the flat space
  vec4 eyeGround;                  // x, y of the eye there, each as the sum of two floats
};

/// Upwards at a position.
vec3 upAt(vec3 position) {
  return earth.y > 0.0 ? normalize(position + vec3(0.0, 0.0, earth.y)) : vec3(0.0, 0.0, 1.0);
}

/// The direction to the eye, of a place whose position from the eye is given.
vec3 towardsEye(vec3 fromEye) { return -normalize(fromEye); }

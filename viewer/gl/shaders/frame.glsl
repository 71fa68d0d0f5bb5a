// What a frame is told, the same for all programs (viewer/gl/frame_block.h). Metric space of the MT, heights
// multiplied by `stretch` on the way.
layout(std140, binding = 0) uniform Frame {
  vec4 eyeHigh, eyeLow;         // the eye as the sum of two floats
  vec4 right, up, forward;      // unit vectors; right is right on the screen
  vec4 lens;                    // 1 / slopeX, 1 / slopeY, depth of the near plane, stretch
  vec4 sides;                   // slopeX, slopeY, lengthX, lengthY (engine/view.h)
  vec4 reach;                   // near, far, least cosine, error per reach
  vec4 morph;                   // pixels of the cut, pixels to move by, pixels per unit of height and reach, 1 = on
  dvec4 eyeExact;
  dvec4 rightExact, upExact, forwardExact;
  dvec4 sidesExact, reachExact;
  vec4 metricOrigin, metricScale;
};

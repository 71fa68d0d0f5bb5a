// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec4.hpp>

#include "engine/criteria/view.h"
#include "engine/mt/multitriangulation.h"

namespace arete {

/// The parameters of a frame: its cut and its projection.
struct FrameView {
  View view;  ///< in metric space, heights multiplied by `stretch`; or in that of a CurvedGround
  bool isMirrored = false;  ///< metric space turns the other way round than the map
  double stretch = 1;       ///< vertical exaggeration, > 0
  double pixels = 1;        ///< tolerance of the cut, for vertices at rest
  double morphPixels = 0;   ///< additional error of moving vertices; 0 = no geomorphing
  Vec2 eyeGround;           ///< x and y of the eye in the flat metric space
  double earthRadius = 0;   ///< metres, on a CurvedGround, whose places are exaggerated already; 0 = flat
  double drawnNear = 0.1;   ///< depth of the near plane that clips what is drawn, metric units, > 0
};

/// shaders/frame.glsl, std140.
struct FrameBlock {
  glm::vec4 eyeHigh{}, eyeLow{}, right{}, up{}, forward{}, lens{}, sides{}, reach{}, morph{}, earth{};
  glm::dvec4 eyeExact{}, rightExact{}, upExact{}, forwardExact{}, sidesExact{}, reachExact{};
  glm::vec4 metricOrigin{}, metricScale{}, eyeGround{};
};
static_assert(sizeof(FrameBlock) == 10 * 16 + 6 * 32 + 3 * 16);

/// `metric`: of the flat space, in both cases. Precondition: the view validates.
FrameBlock frameBlock(const FrameView& frame, const MetricFrame& metric);

}  // namespace arete

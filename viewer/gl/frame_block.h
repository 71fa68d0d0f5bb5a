// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <glm/vec4.hpp>

#include "engine/mt/multitriangulation.h"
#include "viewer/scene/view_settings.h"

namespace arete {

/// shaders/frame.glsl, std140.
struct FrameBlock {
  glm::vec4 eyeHigh{}, eyeLow{}, right{}, up{}, forward{}, lens{}, sides{}, reach{}, morph{}, earth{};
  glm::dvec4 eyeExact{}, rightExact{}, upExact{}, forwardExact{}, sidesExact{}, reachExact{}, halvesExact{};
  glm::vec4 metricOrigin{}, metricScale{}, eyeGround{}, parallel{};
};
static_assert(sizeof(FrameBlock) == 10 * 16 + 7 * 32 + 4 * 16);

/// `metric`: of the flat space, in both cases. Precondition: the view validates.
FrameBlock frameBlock(const FrameView& frame, const MetricFrame& metric);

}  // namespace arete

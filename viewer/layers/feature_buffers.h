// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "engine/base/vec.h"
#include "viewer/gl/gl_objects.h"
#include "viewer/layers/ground_features.h"

namespace arete {

/// Where a place of the map is drawn: in the metric space of the model, heights as they are, or on its curved
/// ground. Not finite where that reaches no such place.
using DrawnPlace = std::function<Vec3(Vec2 xy, double height)>;

/// Features on the device, in the space that is drawn. A vertex of a line takes 16 bytes, a place 16.
struct FeatureBuffers {
  static constexpr std::uint32_t kMostKeptFree =
      20'000;  ///< points that labels are kept off; more are a crowd

  GlBuffer lines;    ///< x, y, z, and w > 0 where an edge leads to the next one; one more at either end
  GlBuffer anchors;  ///< x, y, z of the points, then of the labels
  GlBuffer seen;     ///< of each anchor, whether it was seen when that was last asked
  std::uint32_t lineVertices = 0, points = 0, labels = 0;
  std::vector<Vec3> anchorPlaces;  ///< as in `anchors`; empty for more points than labels are kept off

  std::uint32_t anchorCount() const { return points + labels; }
};

/// Precondition: a context is current. O(vertices).
FeatureBuffers uploadFeatures(const GroundFeatures& features, const DrawnPlace& place);

}  // namespace arete

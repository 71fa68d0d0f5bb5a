// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/vec.h"
#include "viewer/scene/layer.h"

namespace arete {

/// What a camera turns about.
struct OrbitPlace {
  Vec3 centre = {};   ///< metric, heights as they are
  double radius = 1;  ///< metric units to the camera, > 0
};

/// The centre of an orbit: a level square with its diagonals, and around the upright axis of the turn a thin
/// cylinder (Fornous 2003, B.1.2). O(1).
SpaceVertices orbitMark(const OrbitPlace& orbit);

}  // namespace arete

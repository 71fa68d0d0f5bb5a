// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "viewer/camera/home_view.h"
#include "viewer/scene/curved_ground.h"

namespace arete {

/// homeCamera() of the terrain as it lies on the ellipsoid, be it a whole planet. Directions are those in the
/// middle of the DEM. A level view from over a pole of a geographic CRS, which tells no north there, is taken
/// from some degrees higher. What the CRS does not reach is left out; where it reaches no such camera, the
/// flat map's is handed out. O(points) of PROJ.
Camera curvedHomeCamera(HomeView view, const CurvedGround& ground, const CameraSpace& space,
                        const HomeShape& shape, const Camera& picture = {}, double stretch = 1,
                        const CoveredEdges& covered = {});
/// The same of a box, as if the terrain filled it. O(1).
Camera curvedHomeCamera(HomeView view, const CurvedGround& ground, const CameraSpace& space,
                        const MetricBox& box, const Camera& picture = {}, double stretch = 1);

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "terrain/model/camera.h"
#include "viewer/color/terrain_colors.h"
#include "viewer/decoration/decorations.h"
#include "viewer/decoration/legend.h"
#include "viewer/decoration/picture_ground.h"
#include "viewer/scene/layer.h"
#include "viewer/scene/subject.h"

namespace arete {

/// The ground in a camera's picture of a scene. Lines on it are hidden where the terrain is in front of them;
/// lengths are level ones, across the line of sight, at the place that a pixel shows. Of a surface: lengths in
/// the unit of its file at the distance of its middle, no places. The subject outlives the result.
PictureGround groundInView(const Subject& subject, const Camera& camera, const ViewSettings& settings);

/// What the colours of a scene mean: of the ground, or of what it is coloured by, and of the layers that have
/// a legend. @param unit of heights; may be empty
std::vector<ColorLegend> legendsOf(const Subject& subject, const ViewSettings& settings,
                                   const TerrainColors& colors, const Layers& layers);

/// The picture with its decorations. Errors: of a picture that cairo cannot draw.
Result<Image> decorated(const Image& picture, const Subject& subject, const Camera& camera,
                        const ViewSettings& settings, const std::vector<ColorLegend>& legends,
                        const Decorations& decorations = {});

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "terrain/model/camera.h"
#include "viewer/decoration/decorations.h"
#include "viewer/decoration/legend.h"
#include "viewer/decoration/picture_ground.h"
#include "viewer/scene/subject.h"

namespace arete {

/// Depths of a picture along the camera's axis, in metric units, row by row from the top; infinite where it
/// shows no model.
struct PictureDepths {
  int width = 0, height = 0;
  std::vector<float> depths;
};

/// The ground in a camera's picture of a scene. A pixel shows the place that its depth says; lines on the
/// ground are hidden where the picture shows something nearer. Lengths are level ones, across the line of
/// sight, at the depth of the pixel. A surface has lengths in the unit of its file at the depth of its
/// middle; it has no places. Precondition: the subject outlives the result.
/// @param depths of the picture; null: pixels are picked (Subject::pick()), and no line is hidden
PictureGround groundInView(const Subject& subject, const Camera& camera, const ViewSettings& settings,
                           std::shared_ptr<const PictureDepths> depths = {});

/// A picture with its decorations over it. Errors: as Canvas::create().
Result<Image> decorated(const Image& picture, const PictureGround& ground,
                        std::span<const ColorLegend> legends, const Decorations& decorations = {});

}  // namespace arete

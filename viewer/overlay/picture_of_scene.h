// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "engine/base/result.h"
#include "viewer/decoration/scene_ground.h"
#include "viewer/gl/frame_target.h"
#include "viewer/gl/scene.h"

namespace arete {

/// The ground in the last picture of a scene, with its depths. Waits for the drawing. Precondition: the scene
/// was drawn into the target for this camera. Errors: as Drawable::frameOf().
Result<PictureGround> groundOfPicture(const Scene& scene, const FrameTarget& target, const Camera& camera,
                                      const ViewSettings& settings);

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/overlay/picture_of_scene.h"

#include <memory>
#include <utility>

namespace arete {

Result<PictureGround> groundOfPicture(const Scene& scene, const FrameTarget& target, const Camera& camera,
                                      const ViewSettings& settings) {
  ARETE_TRY(const FrameView frame, scene.frameOf(camera, settings));
  PictureDepths depths{target.width(), target.height(),
                       target.depths(frame.drawnNear, frame.view.isParallel() ? frame.depthReach : 0)};
  return groundInView(scene.subject(), camera, settings,
                      std::make_shared<const PictureDepths>(std::move(depths)));
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "viewer/decoration/scene_legends.h"
#include "viewer/gl/frame_target.h"
#include "viewer/overlay/overlay_painter.h"
#include "viewer/gl/scene.h"

namespace arete {

/// Legends, scale bar, north arrow and graticule over the pictures of a window. They are drawn anew where the
/// picture is of another camera, look or size, and laid over it as they are where it is not.
class DecorationOverlay {
 public:
  /// Precondition: the scene outlives this. Errors: unsupported, by the driver.
  static Result<DecorationOverlay> create(const Scene& scene);

  /// Lays them over the framebuffer that is bound, which has the picture of the target. Errors: as
  /// groundOfPicture() and Canvas::create().
  Status draw(const FrameTarget& target, const Camera& camera, const ViewSettings& settings);
  /// The picture of the target with decorations, for a file. Errors: as draw().
  Result<Image> picture(const FrameTarget& target, const Camera& camera, const ViewSettings& settings) const;

 private:
  DecorationOverlay(const Scene& scene, OverlayPainter painter)
      : scene_(&scene), painter_(std::move(painter)), legends_(scene.subject()) {}
  std::string stateOf(const FrameTarget& target, const Camera& camera, const ViewSettings& settings) const;

  const Scene* scene_;
  OverlayPainter painter_;
  SceneLegends legends_;
  std::optional<std::string> drawn_;
};

}  // namespace arete

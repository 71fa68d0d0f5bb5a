// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/overlay/decoration_overlay.h"

#include <fmt/format.h>

#include <utility>
#include <variant>

#include "viewer/overlay/picture_of_scene.h"

namespace arete {

Result<DecorationOverlay> DecorationOverlay::create(const Scene& scene) {
  ARETE_TRY(OverlayPainter painter, OverlayPainter::create());
  return DecorationOverlay(scene, std::move(painter));
}

/// Two pictures of one state have the same decorations.
std::string DecorationOverlay::stateOf(const FrameTarget& target, const Camera& c,
                                       const ViewSettings& settings) const {
  const ViewLook& look = settings.look;
  std::string state = fmt::format(
      "{} {} {} {} {} {} {} {} {} {} {} {} {} {} {}", target.width(), target.height(), c.xy.x, c.xy.y,
      c.height, c.azimuthDegrees, c.pitchDegrees, c.verticalFieldOfViewDegrees, settings.stretch,
      settings.isCurved, int(look.coloring), look.heatError,
      look.coloring == Coloring::error ? settings.pixels : 0, fmt::ptr(look.colors.get()), look.ink);
  for (const Layer& layer : scene_->layers.list())
    if (layer.isVisible) {
      const auto* contours = std::get_if<Contours>(&layer.content);
      state += fmt::format(" {}:{}:{}:{}", layer.name, layer.legend.entries.size(), layer.opacity,
                           contours ? contours->interval : 0);
    }
  return state;
}

Status DecorationOverlay::draw(const FrameTarget& target, const Camera& camera,
                               const ViewSettings& settings) {
  std::string state = stateOf(target, camera, settings);
  if (drawn_ != state) {
    ARETE_TRY(Canvas canvas, Canvas::createClear(target.width(), target.height()));
    ARETE_TRY(const PictureGround ground, groundOfPicture(*scene_, target, camera, settings));
    decorate(canvas, ground, legends_.of(settings, scene_->layers.list()));
    painter_.setPicture(target.width(), target.height(), canvas.premultipliedRgba());
    drawn_ = std::move(state);
  }
  painter_.draw();
  return {};
}

Result<Image> DecorationOverlay::picture(const FrameTarget& target, const Camera& camera,
                                         const ViewSettings& settings) const {
  ARETE_TRY(const PictureGround ground, groundOfPicture(*scene_, target, camera, settings));
  return decorated(target.image(), ground, legends_.of(settings, scene_->layers.list()));
}

}  // namespace arete

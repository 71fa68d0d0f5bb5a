// SPDX-License-Identifier: GPL-3.0-or-later
//
// A height beside a line of another interval is a wrong answer, so it goes in the frame in which the interval
// changes.
#include "viewer/scene/heights_of_contours.h"

namespace arete {

Status HeightsOfContours::follow(Layers& layers, bool isChanging) {
  constexpr const char* kName = "heights of contours";
  const Layer* lines = layers.find("contours");
  const Contours* contours = lines ? std::get_if<Contours>(&lines->content) : nullptr;
  const double interval = contours ? contours->interval : 0;
  if (interval != interval_) {
    layers.remove(kName);
    interval_ = 0;
  }
  if (!contours || !write_) return {};
  if (interval_ == 0) {
    if (isChanging) return {};
    ARETE_TRY(Layer::Drawn written, write_(interval));
    layers.put(kName, std::move(written));
    interval_ = interval;
    lines = layers.find("contours");
  }
  if (Layer* heights = layers.find(kName)) {
    heights->isVisible = lines->isVisible;
    heights->opacity = lines->opacity;
  }
  return {};
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "viewer/decoration/legend.h"
#include "viewer/decoration/picture_ground.h"
#include "viewer/picture/picture.h"

namespace arete {

/// What is drawn over a picture so that it can be read as a map.
struct Decorations {
  bool legend = true, scaleBar = true, north = true, graticule = true;

  static Decorations none() { return {false, false, false, false}; }
  bool any() const { return legend || scaleBar || north || graticule; }
  bool operator==(const Decorations&) const = default;
};

/// Draws the graticule over a picture, and from its lower right corner to the left the legends, the scale bar
/// and the north arrow. What has no room in a small picture is left out.
void decorate(Canvas& canvas, const PictureGround& ground, std::span<const ColorLegend> legends,
              const Decorations& decorations = {});

/// The size of the texts on a picture of that size, in pixels.
double decorationTextSize(const Rect& frame);

}  // namespace arete

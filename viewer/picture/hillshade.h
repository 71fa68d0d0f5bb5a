// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "terrain/model/heightfield.h"
#include "viewer/color/color_map.h"
#include "viewer/picture/map_view.h"
#include "viewer/picture/picture.h"

namespace arete {

struct HillshadeOptions {
  /// Heights are multiplied by it before shading; 0 chooses: 1 in mountains, up to 12 on plains.
  double verticalExaggeration = 0;
  /// 0 = shaded white paper, 1 = full hypsometric tint.
  double tint = 1;
  /// 0 = unchanged, 1 = white: lightens the relief below other drawing.
  double wash = 0;
};

/// Shaded relief of the part of a heightfield that a view shows: light from the upper left and less from its
/// sides, a sky above, over the tints of heightColors() between the heightfield's lowest and highest heights.
/// Heights are scaled by georeference.verticalUnitMetres where the CRS gives metres on the ground.
/// Precondition: the heightfield is valid and has at least 2 x 2 samples. O(samples in view + pixels).
Image drawHillshade(const RasterHeightfield& heightfield, const MapView& view,
                    const HillshadeOptions& options = {});

/// The colours of heights that drawHillshade() shades, for a legend.
ColorMap hillshadeTints(const RasterHeightfield& heightfield);
/// What it makes of one of them on level ground.
Rgb onLevelGround(Rgb tint, const HillshadeOptions& options);

}  // namespace arete

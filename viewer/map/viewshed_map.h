// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "terrain/model/heightfield.h"
#include "terrain/viewshed/viewshed.h"
#include "viewer/picture/picture.h"

namespace arete {

/// What the values of a viewshed are.
enum class ViewshedMapKind {
  answers,  ///< none: the cells say it
  counts,   ///< how many observers see a cell; marks as in ViewshedOfMany
  servers,  ///< the nearest observer that sees it, from 1; 0 = none; marks as in ViewshedOfMany
  heights,  ///< the least height above the terrain that is seen, in the unit of heights; infinite = none
  horizon,  ///< degrees; infinite as above
};

struct ViewshedMapOptions {
  int width = 1600;  ///< pixels
  std::string title = {};
  std::vector<std::string> caption = {};  ///< put before the counts
  bool isDecorated = true;                ///< with legend, scale bar, north arrow and graticule
  ViewshedMapKind kind = ViewshedMapKind::answers;
};

/// Draws a viewshed over the hillshade, cropped to where it has answers. Each answer has a colour of its own
/// in sixteen shades, all of which the legend shows; "unknown" and "undecided" are unlike any answer, also
/// for people without one kind of cones (CIEDE2000 >= 10 between any two shades). Observers are dots;
/// several have their numbers beside them, from 1.
///
/// @param ground    the terrain at the samples of the viewshed's grid; NaN = none
/// @param cells     one for each sample
/// @param values    one for each sample; empty for answers
/// @param observers in grid coordinates of `ground`; NaN is not drawn
///
/// Errors: as makeMapPage(). O(samples + pixels).
Result<Canvas> drawViewshedMap(const RasterHeightfield& ground, std::span<const ViewshedCell> cells,
                               std::span<const double> values, std::span<const Vec2> observers,
                               const ViewshedMapOptions& options = {});

/// Of what Earth and with which refraction lines of sight were computed, in words.
std::string earthWords(const Georeference& georeference, bool isOnEllipsoid, double refraction);

/// The colour of an answer, in the light `shade` (0 to 15).
Rgb viewshedColor(ViewshedCell cell, int shade);

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "terrain/model/heightfield.h"
#include "terrain/viewshed/viewshed.h"
#include "viewer/picture/picture.h"

namespace arete {

struct ViewshedMapOptions {
  int width = 1600;  ///< pixels
  std::string title = {};
  std::vector<std::string> caption = {};  ///< put before the counts
};

/// Draws a viewshed over the hillshade: visible ground is bright, hidden ground dark, unknown and undecided
/// ground blue. The observer is a dot. Preconditions: the viewshed is of the heightfield's grid;
/// `observer` in its plan coordinates. Errors: those of makeMapPage(). O(samples + pixels).
Result<Canvas> drawViewshedMap(const RasterHeightfield& field, const Viewshed& viewshed, Vec2 observer,
                               const ViewshedMapOptions& options = {});

}  // namespace arete

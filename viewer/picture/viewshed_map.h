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

/// What an observer sees, over the hillshade: seen ground glows, the rest lies in the shade; unknown and
/// undecided ground is blue. The observer is a dot. Preconditions: the viewshed is of the heightfield's grid;
/// `observer` in its plan coordinates. Errors: those of makeMapPage(). O(samples + pixels).
Result<Canvas> drawViewshedMap(const RasterHeightfield& field, const Viewshed& viewshed, Vec2 observer,
                               const ViewshedMapOptions& options = {});

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "terrain/model/heightfield.h"
#include "viewer/picture/picture.h"

namespace arete {

struct ErrorMapOptions {
  int width = 1600;  ///< pixels
  std::string title = {};
  std::vector<std::string> caption = {};  ///< put before the statistics
  std::string unit = "m";
  /// The colours run from -limit to +limit; 0 takes a round number at or above the largest error.
  /// Errors beyond take the end's colour, and the bar's end is pointed.
  double limit = 0;
  bool isDecorated = true;  ///< with colour bar, scale bar, north arrow and graticule
};

/// Signed errors (TIN minus reference, say) as a map: blue below, brown above, near-white at zero, grey-blue
/// without data; beside it a colour bar with a histogram, below it the extremes, the mean and the root mean
/// square. `errors.heights` holds the errors, NaN = none. A picture pixel shows the error of largest size
/// among the samples it covers, so that averaging hides no extreme. Errors: those of makeMapPage();
/// invalidData, when no sample has an error or the limit is negative. O(samples + pixels).
Result<Canvas> drawErrorMap(const RasterHeightfield& errors, const ErrorMapOptions& options = {});

/// Where drawErrorMap() puts its map and its colour bar on the page: for drawing over them, and for tests.
struct ErrorMapLayout {
  Rect map;
  Rect colorBar;
  double limit = 0;
};
Result<ErrorMapLayout> errorMapLayout(const RasterHeightfield& errors, const ErrorMapOptions& options = {});

}  // namespace arete

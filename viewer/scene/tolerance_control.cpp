// SPDX-License-Identifier: GPL-3.0-or-later
//
// A multiplicative controller: the tolerance grows by the ratio of time or triangles to their limit, clamped
// for times, and shrinks by 2 % a frame while both are well below it.
#include "viewer/scene/tolerance_control.h"

#include <algorithm>
#include <cmath>

namespace arete {

double ToleranceControl::next(const Wanted& wanted, const Seen& seen) {
  if (!(pixels_ > 0)) pixels_ = wanted.pixels;
  double factor = 1 / 1.02;  // towards the wanted tolerance
  if (wanted.frameMilliseconds > 0 && seen.milliseconds > 0) {
    const double load = seen.milliseconds / wanted.frameMilliseconds;
    if (load > 1) factor = std::clamp(load, 1.02, 1.2);
    // Between 0.9 and 1 of the time nothing changes, so the tolerance does not oscillate.
    else if (load > 0.9)
      factor = 1;
  }
  if (wanted.maxTriangles > 0 && seen.triangles > 0) {
    const double load = double(seen.triangles) / wanted.maxTriangles * (seen.pixels / pixels_);
    if (load > 1)
      factor = std::max(factor, 1.02 * load);
    else if (load > 0.95)
      factor = std::max(factor, 1.0);
  }
  pixels_ = std::clamp(pixels_ * factor, wanted.pixels, std::max(wanted.pixels, wanted.coarsestPixels));
  return pixels_;
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/base/vec.h"
#include "viewer/decoration/picture_ground.h"
#include "viewer/picture/picture.h"

namespace arete {

/// A meridian or a parallel of a picture, in pieces: it may leave the picture or be hidden in between.
struct GraticuleLine {
  bool isMeridian = true;
  double degrees = 0;                    ///< of longitude, from -180 (excluded) to 180, or of latitude
  std::string label;                     ///< "118\u00b0 15\u2032 W"
  std::vector<std::vector<Vec2>> parts;  ///< pixels, less than half a pixel from the curve
};

/// Meridians and parallels at round steps, about `spacing` pixels apart at the middle of the picture,
/// whatever the CRS: across the antimeridian and around poles as well. A line appears once, and twice on a
/// map of longitudes that shows it twice. Nothing without longitudes and latitudes. O(lines x pixels along
/// them) conversions of places.
std::vector<GraticuleLine> graticuleOf(const PictureGround& ground, double spacing);

/// A longitude or a latitude for people, with as many parts as the step requires: 0.25 is 15 minutes.
std::string angleText(double degrees, double stepDegrees, bool isLongitude);

/// The largest round step of degrees, minutes or seconds that is <= `degrees`. Precondition: degrees > 0.
double roundAngleDown(double degrees);

/// Draws the lines, thin, within the frame.
void drawGraticuleLines(Canvas& canvas, const PictureGround& ground, const std::vector<GraticuleLine>& lines);
/// Writes a label on each line, near the lower end of a meridian and the left end of a parallel, where it
/// covers no other and none of the panels; behind a panel, near the other end.
void drawGraticuleLabels(Canvas& canvas, const PictureGround& ground, const std::vector<GraticuleLine>& lines,
                         std::span<const Rect> panels, double textSize);

}  // namespace arete

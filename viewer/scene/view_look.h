// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace arete {

enum class Coloring { hypsometric, slope, aspect, plain, error };

/// How the terrain is shown.
struct ViewLook {
  Coloring coloring = Coloring::hypsometric;
  bool isShaded = true;
  double sunAzimuthDegrees = 315, sunElevationDegrees = 40;
  double contourInterval = 0;  ///< in the unit of heights; 0 = none
  double hazeKilometres = 0;   ///< where the air hides about two thirds; 0 = clear
  bool hasWireframe = false;
  bool hasDrape = true;    ///< where there is one
  bool hasOverlay = true;  ///< a viewshed, where there is one
  /// The error of the hottest colour, in the unit of heights; 0 = as many pixels as the cut allows.
  double heatError = 0;
};

}  // namespace arete

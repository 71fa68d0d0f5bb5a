// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace arete {

enum class Coloring { hypsometric, slope, aspect, plain, error };

/// Colours, light and overlays of the terrain.
struct ViewLook {
  Coloring coloring = Coloring::hypsometric;
  bool isShaded = true;
  double sunAzimuthDegrees = 315, sunElevationDegrees = 40;
  double contourInterval = 0;  ///< in the unit of heights; 0 = none
  double hazeKilometres = 0;   ///< distance at which haze hides about two thirds; 0 = none
  bool hasWireframe = false;
  bool hasDrape = true;    ///< if one is set
  bool hasOverlay = true;  ///< a viewshed, if one is set
  /// The error of the hottest colour, in the unit of heights; 0 = as many pixels as the cut allows.
  double heatError = 0;
};

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace arete {

/// How the heights of a pyramid, which are counted from a base, count contour levels.
struct ContourLevels {
  /// Levels are numbered from the lowest multiple of kCycle that is at most the base: level n is at the
  /// height cycleStart + n * interval, and its number says how many fifths it is a multiple of.
  static constexpr int kCycle = 125;
  double interval = 0;
  double shift = 0;  ///< level of the base, at least 0, less than kCycle
  /// A contour is drawn so much above its level, in levels: ground that lies exactly at a level, a sea at 0
  /// or a lake, is then on one side of it. As small as the last bits of heights allow.
  double lift = 0;
};

/// @param interval  in the unit of heights, > 0
/// @param base, reach  heights are in [base - reach, base + reach]
ContourLevels contourLevels(double interval, double base, double reach);

}  // namespace arete

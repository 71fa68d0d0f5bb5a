// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "viewer/color/rgb.h"

namespace arete {

/// How the colours between two stops come about.
enum class ColorsBetween {
  linear,    ///< each channel mixed linearly, as gdaldem and QGIS do
  discrete,  ///< the colour of the first stop at or above the value (QGIS's "discrete")
  nearest,   ///< the colour of the nearest stop, of the upper one halfway
  exact,     ///< only values of stops have a colour
};

struct ColorStop {
  double value = 0;  ///< not NaN; may be infinite
  Rgba color;
  std::string label = {};  ///< for legends; empty: the value itself
  bool operator==(const ColorStop&) const = default;
};

struct ColorMapOptions {
  ColorsBetween between = ColorsBetween::linear;
  /// The colour of values that no stop reaches: linear and nearest: beyond the ends; exact: wherever no stop
  /// is; discrete: above the last stop. Nothing: the ends' colours (linear, nearest), or nothing to see.
  std::optional<Rgba> outside = {};
  Rgba nodata = Rgba(kNodataColor);  ///< of NaN
  bool operator==(const ColorMapOptions&) const = default;
};

/// Colours that stand for values: shader (viewer/gl/shaders/color_map.glsl), pictures and legends read the
/// same stops and agree bit for bit. Values are compared as floats, as the shader has them.
///
/// Two stops of one value are a step: below it the first one counts, at it and above it the last one.
class ColorMap {
 public:
  /// One opaque black stop.
  ColorMap();

  /// Puts the stops in the order of their values; stops of equal values stay in the order stated.
  /// Errors: invalidData: no stop, a value that is NaN.
  static Result<ColorMap> make(std::vector<ColorStop> stops, const ColorMapOptions& options = {});

  /// The colour of a value; NaN is NODATA. O(log stops).
  Rgba at(double value) const;

  /// The same colours with the finite values moved and stretched, so that they run from `low` to `high`;
  /// a map of one value only is moved to `low`.
  /// Precondition: both are finite, low <= high.
  ColorMap over(double low, double high) const;
  /// The same with finite values moved to multiples of a grain, in the same order: for values that are known
  /// to half a grain, so that those of stops meet their stops. Precondition: grain > 0.
  ColorMap onGrain(double grain) const;
  /// The same with another colour for NaN.
  ColorMap withNodata(Rgba color) const;

  /// In the order of their values, which are exactly floats.
  const std::vector<ColorStop>& stops() const { return stops_; }
  const ColorMapOptions& options() const { return options_; }
  ColorsBetween between() const { return options_.between; }
  /// The lowest and the highest finite value of a stop; 0 where all are infinite.
  double low() const;
  double high() const;

  /// The colours of values below and above all stops; exact: of values between stops, too. The first class of
  /// a discrete map has no lower end.
  Rgba below() const;
  Rgba above() const;

  bool operator==(const ColorMap&) const = default;

 private:
  std::vector<ColorStop> stops_;
  ColorMapOptions options_;
};

}  // namespace arete

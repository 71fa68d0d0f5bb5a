// SPDX-License-Identifier: GPL-3.0-or-later
//
// Slopes are taken at the samples in ground units and brought to the pixels together with the heights, so
// that shading a reduced picture is the shading of averaged ground, and an enlarged one is smooth. The light
// is a weighted sum of Lambert terms from several azimuths (after Mark, "Multidirectional, oblique-weighted,
// shaded-relief image of the Island of Hawaii", USGS Open-File Report 92-422, 1992, with fixed weights) and a
// sky term; it is divided by the light on level ground, so that level ground keeps its tint,
// and multiplies linear intensities (viewer/color/light.h).
#include "viewer/picture/hillshade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "viewer/color/color_tables.h"
#include "viewer/color/light.h"
#include "viewer/picture/resample.h"

namespace arete {
namespace {

struct Light {
  double azimuthDegrees, altitudeDegrees, weight;
};
// Clockwise from the top of the picture.
constexpr std::array<Light, 4> kLights = {{{315, 40, 0.60}, {270, 45, 0.14}, {0, 45, 0.14}, {225, 55, 0.12}}};
constexpr std::array<double, 3> kSkyShare = {0.14, 0.16, 0.20};  // red, green, blue
constexpr std::size_t kSampledForStatistics = 1u << 20;

/// What a whole heightfield looks like, so that a detail is drawn like the map it is from.
struct Relief {
  double low = 0, high = 1;  // heights between which the tint runs
  double typicalSlope = 0;   // root mean square
};

/// Slope along the row and along the column at a sample, from those neighbours that have data.
class Slopes {
 public:
  explicit Slopes(const RasterHeightfield& heightfield) : field_(heightfield) {
    // Without a CRS heights and plan are taken to be in one unit.
    const bool metric = !field_.georeference.crsWkt.empty();
    const double toGround = metric ? field_.georeference.verticalUnitMetres : 1;
    for (std::uint32_t row = 0; row < field_.rows; ++row) {
      if (row == 0 || field_.georeference.isGeographic)
        step_ = groundStep(field_.georeference, (field_.columns - 1) / 2.0, row);
      perStep_.push_back({toGround / step_.x, toGround / step_.y});
    }
  }

  double alongRow(std::uint32_t c, std::uint32_t r) const {
    const double rise = difference(field_.at(c, r), c > 0 ? field_.at(c - 1, r) : kNone,
                                   c + 1 < field_.columns ? field_.at(c + 1, r) : kNone);
    return rise * perStep_[r].x;
  }
  double alongColumn(std::uint32_t c, std::uint32_t r) const {
    const double rise = difference(field_.at(c, r), r > 0 ? field_.at(c, r - 1) : kNone,
                                   r + 1 < field_.rows ? field_.at(c, r + 1) : kNone);
    return rise * perStep_[r].y;
  }

 private:
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

  static double difference(double here, double before, double after) {
    if (std::isnan(here)) return kNone;
    if (std::isnan(before)) return std::isnan(after) ? 0 : after - here;
    return std::isnan(after) ? here - before : (after - before) / 2;
  }

  const RasterHeightfield& field_;
  Vec2 step_;
  std::vector<Vec2> perStep_;
};

Relief reliefOf(const RasterHeightfield& heightfield, const Slopes& slopes) {
  const std::size_t stride = std::max<std::size_t>(1, heightfield.size() / kSampledForStatistics);
  std::vector<double> heights;
  double squares = 0;
  for (std::size_t i = 0; i < heightfield.size(); i += stride) {
    if (std::isnan(heightfield.heights[i])) continue;
    heights.push_back(heightfield.heights[i]);
    const auto c = std::uint32_t(i % heightfield.columns), r = std::uint32_t(i / heightfield.columns);
    const double x = slopes.alongRow(c, r), y = slopes.alongColumn(c, r);
    squares += x * x + y * y;
  }
  Relief relief;
  if (heights.empty()) return relief;
  // The outermost half percent is left out: one spike must not take the colours from all the rest.
  const auto quantile = [&](double fraction) {
    const auto at = heights.begin() + std::ptrdiff_t(fraction * double(heights.size() - 1));
    std::nth_element(heights.begin(), at, heights.end());
    return *at;
  };
  relief.low = quantile(0.005);
  relief.high = quantile(0.995);
  relief.typicalSlope = std::sqrt(squares / double(heights.size()));
  return relief;
}

/// The light on a slope, as multiples of the light on level ground: the lamps are warm, the sky is cool.
std::array<double, 3> lightOn(double slopeRight, double slopeUp) {
  const double length = std::sqrt(1 + slopeRight * slopeRight + slopeUp * slopeUp);
  double direct = 0, level = 0;
  for (const Light& light : kLights) {
    const double azimuth = light.azimuthDegrees * std::numbers::pi / 180,
                 altitude = light.altitudeDegrees * std::numbers::pi / 180;
    const double x = std::sin(azimuth) * std::cos(altitude), y = std::cos(azimuth) * std::cos(altitude),
                 z = std::sin(altitude);
    direct += light.weight * std::max(0.0, (z - slopeRight * x - slopeUp * y) / length);
    level += light.weight * z;
  }
  const double sky = (1 + 1 / length) / 2;
  std::array<double, 3> sum{};
  for (std::size_t i = 0; i < 3; ++i) sum[i] = (1 - kSkyShare[i]) * direct / level + kSkyShare[i] * sky;
  return sum;
}

constexpr Rgb kPaper = {236, 234, 230};

}  // namespace

ColorMap hillshadeTints(const RasterHeightfield& heightfield) {
  const Relief relief = reliefOf(heightfield, Slopes(heightfield));
  return heightColors(relief.low, relief.high);
}

Rgb onLevelGround(Rgb tint, const HillshadeOptions& options) {
  return mix(mix(kPaper, tint, options.tint), {255, 255, 255}, options.wash);
}

Image drawHillshade(const RasterHeightfield& heightfield, const MapView& view,
                    const HillshadeOptions& options) {
  const Slopes slopes(heightfield);
  const Relief relief = reliefOf(heightfield, slopes);
  const double exaggeration = options.verticalExaggeration > 0
                                  ? options.verticalExaggeration
                                  : std::clamp(0.35 / std::max(relief.typicalSlope, 1e-9), 1.0, 12.0);
  const auto resampled = [&](const SampleAt& sampleAt) {
    return resample(heightfield.columns, heightfield.rows, sampleAt, view);
  };
  const ViewField heights = resampled([&](std::uint32_t c, std::uint32_t r) { return heightfield.at(c, r); });
  const ViewField right = resampled([&](std::uint32_t c, std::uint32_t r) { return slopes.alongRow(c, r); });
  const ViewField down =
      resampled([&](std::uint32_t c, std::uint32_t r) { return slopes.alongColumn(c, r); });
  const double up = view.rowsPerPixel > 0 ? -exaggeration : exaggeration;
  const ColorMap tints = heightColors(relief.low, relief.high);

  Image image(view.width, view.height, kNodataColor);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    // Half covered is where the border of the data runs. Colours of data and NODATA are not mixed there: a
    // mixture would be the colour of another height.
    if (heights.coverage[i] < 0.5f) continue;
    const Rgb tint = mix(kPaper, tints.at(heights.values[i]).opaque(), options.tint);
    const Rgb color = lit(tint, lightOn(right.values[i] * exaggeration, down.values[i] * up));
    image.pixels[i] = mix(color, {255, 255, 255}, options.wash);
  }
  return image;
}

}  // namespace arete

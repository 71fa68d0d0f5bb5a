// SPDX-License-Identifier: GPL-3.0-or-later
//
// The shader repeats at() in the same steps: comparisons of floats, one division, and whole numbers from
// there on, so that both give the same bytes. Halves keep the difference of two large floats finite.
#include "viewer/color/color_map.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace arete {
namespace {

std::uint8_t mixedChannel(std::uint8_t from, std::uint8_t to, std::int32_t part) {
  return std::uint8_t((from * (65536 - part) + to * part + 32768) >> 16);
}

Rgba mixedAt(const ColorStop& below, const ColorStop& above, float value) {
  const auto low = float(below.value), high = float(above.value);
  // A stop at infinity is infinitely far away: the other one's colour holds.
  if (std::isinf(high)) return below.color;
  if (std::isinf(low)) return above.color;
  const float part = (0.5f * value - 0.5f * low) / (0.5f * high - 0.5f * low);
  const auto p = std::int32_t(part * 65536.0f);
  const Rgba a = below.color, b = above.color;
  return {mixedChannel(a.r, b.r, p), mixedChannel(a.g, b.g, p), mixedChannel(a.b, b.b, p),
          mixedChannel(a.a, b.a, p)};
}

}  // namespace

Rgb mix(Rgb from, Rgb to, double fraction) {
  const auto channel = [&](std::uint8_t a, std::uint8_t b) {
    return static_cast<std::uint8_t>(std::lround(a + (b - a) * fraction));
  };
  return {channel(from.r, to.r), channel(from.g, to.g), channel(from.b, to.b)};
}

Rgb laidOver(Rgba front, Rgb behind) {
  return mix(behind, front.opaque(), front.a / 255.0);
}

ColorMap::ColorMap() : stops_{{0, Rgba{0, 0, 0}, {}}} {}

Result<ColorMap> ColorMap::make(std::vector<ColorStop> stops, const ColorMapOptions& options) {
  if (stops.empty()) return failure(ErrorCode::invalidData, "a colour map needs at least one colour");
  for (ColorStop& stop : stops) {
    if (std::isnan(stop.value))
      return failure(ErrorCode::invalidData, "a colour of a colour map stands for no number");
    stop.value = double(float(stop.value));
  }
  std::ranges::stable_sort(stops, {}, &ColorStop::value);
  ColorMap map;
  map.stops_ = std::move(stops);
  map.options_ = options;
  return map;
}

Rgba ColorMap::below() const {
  // The first class of a discrete map has no lower end.
  if (options_.between == ColorsBetween::discrete) return stops_.front().color;
  if (options_.outside) return *options_.outside;
  return options_.between == ColorsBetween::exact ? Rgba{0, 0, 0, 0} : stops_.front().color;
}

Rgba ColorMap::above() const {
  if (options_.outside) return *options_.outside;
  const bool isOpen = options_.between == ColorsBetween::exact || options_.between == ColorsBetween::discrete;
  return isOpen ? Rgba{0, 0, 0, 0} : stops_.back().color;
}

Rgba ColorMap::at(double value) const {
  const auto v = float(value);
  if (std::isnan(v)) return options_.nodata;
  // `next` is the first stop above the value.
  const auto next =
      std::ranges::upper_bound(stops_, v, {}, [](const ColorStop& s) { return float(s.value); });
  const auto last = next == stops_.begin() ? stops_.end() : next - 1;  // the last stop at or below
  if (last != stops_.end() && float(last->value) == v) return last->color;
  switch (options_.between) {
    case ColorsBetween::discrete:
      return next == stops_.end() ? above() : next->color;
    case ColorsBetween::exact:
      return below();
    case ColorsBetween::nearest:
    case ColorsBetween::linear:
      break;
  }
  if (last == stops_.end()) return below();
  if (next == stops_.end()) return above();
  if (options_.between == ColorsBetween::linear) return mixedAt(*last, *next, v);
  return 0.5f * v - 0.5f * float(last->value) < 0.5f * float(next->value) - 0.5f * v ? last->color
                                                                                     : next->color;
}

double ColorMap::low() const {
  for (const ColorStop& stop : stops_)
    if (std::isfinite(stop.value)) return stop.value;
  return 0;
}

double ColorMap::high() const {
  for (auto stop = stops_.rbegin(); stop != stops_.rend(); ++stop)
    if (std::isfinite(stop->value)) return stop->value;
  return 0;
}

ColorMap ColorMap::over(double low, double high) const {
  const double from = this->low(), extent = this->high() - from;
  ColorMap moved = *this;
  for (ColorStop& stop : moved.stops_)
    if (std::isfinite(stop.value))
      stop.value = double(float(extent > 0 ? low + (stop.value - from) / extent * (high - low) : low));
  return moved;
}

ColorMap ColorMap::onGrain(double grain) const {
  ColorMap moved = *this;
  for (std::size_t i = 0; i < stops_.size(); ++i) {
    if (!std::isfinite(stops_[i].value)) continue;
    double value = std::round(stops_[i].value / grain) * grain;
    // Values that are apart stay apart.
    if (i > 0 && std::isfinite(stops_[i - 1].value)) {
      const bool isStep = stops_[i].value == stops_[i - 1].value;
      value = std::max(value, moved.stops_[i - 1].value + (isStep ? 0 : grain));
    }
    moved.stops_[i].value = double(float(value));
  }
  return moved;
}

ColorMap ColorMap::withNodata(Rgba color) const {
  ColorMap other = *this;
  other.options_.nodata = color;
  return other;
}

}  // namespace arete

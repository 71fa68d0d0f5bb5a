// SPDX-License-Identifier: GPL-3.0-or-later
//
// The picture's pixels are cells over the samples; each takes the sample of largest error among those whose
// own cell centre falls into it, or, where samples are sparser than pixels, the nearest. The colour bar spans
// -limit..limit and carries the histogram of the same samples, its counts drawn by their square root so that
// the tails remain visible.
#include "viewer/map/error_map.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "viewer/color/color_tables.h"
#include "viewer/map/map_page.h"
#include "viewer/picture/inks.h"
#include "viewer/picture/ticks.h"

namespace arete {
namespace {

constexpr int kSideWidth = 190;
constexpr double kBarLeft = 28, kBarWidth = 22, kHistogramGap = 62, kHistogramWidth = 90;
constexpr int kBins = 81;  // odd: zero has a bin of its own

struct Statistics {
  std::size_t count = 0;
  double low = 0, high = 0, mean = 0, rms = 0;
};

Statistics statisticsOf(std::span<const double> errors) {
  Statistics s;
  double sum = 0, squares = 0;
  for (const double e : errors) {
    if (std::isnan(e)) continue;
    s.low = s.count == 0 ? e : std::min(s.low, e);
    s.high = s.count == 0 ? e : std::max(s.high, e);
    sum += e;
    squares += e * e;
    ++s.count;
  }
  if (s.count > 0) {
    s.mean = sum / double(s.count);
    s.rms = std::sqrt(squares / double(s.count));
  }
  return s;
}

double roundUpNice(double value) {
  const double below = roundDownNice(value);
  if (below >= value * (1 - 1e-9)) return below;
  for (const double factor : {1.5, 2.0, 2.5}) {
    if (below * factor >= value) return below * factor;
  }
  return below * 5;
}

Rgb errorColor(double error, double limit) {
  return colorTable("difference").at(error / limit).opaque();
}

/// First and one past the last sample whose centre falls into a pixel; the nearest where none does.
std::pair<std::uint32_t, std::uint32_t> samplesOf(int pixel, double origin, double perPixel,
                                                  std::uint32_t samples) {
  const double a = origin + pixel * perPixel, b = a + perPixel;
  const double first = std::clamp(std::ceil(std::min(a, b)), 0.0, samples - 1.0);
  const double end = std::min(std::ceil(std::max(a, b)), double(samples));
  if (end > first) return {std::uint32_t(first), std::uint32_t(end)};
  const auto nearest = std::uint32_t(std::clamp(std::round((a + b) / 2), 0.0, samples - 1.0));
  return {nearest, nearest + 1};
}

Image errorImage(const RasterHeightfield& errors, const MapView& view, double limit) {
  Image image(view.width, view.height, kNodataColor);
  for (int y = 0; y < view.height; ++y) {
    const auto [firstRow, endRow] = samplesOf(y, view.row0, view.rowsPerPixel, errors.rows);
    for (int x = 0; x < view.width; ++x) {
      const auto [firstColumn, endColumn] = samplesOf(x, view.column0, view.columnsPerPixel, errors.columns);
      double worst = std::numeric_limits<double>::quiet_NaN();
      for (std::uint32_t r = firstRow; r < endRow; ++r) {
        for (std::uint32_t c = firstColumn; c < endColumn; ++c) {
          const double e = errors.at(c, r);
          if (!std::isnan(e) && !(std::abs(e) <= std::abs(worst))) worst = e;
        }
      }
      if (!std::isnan(worst)) image.at(x, y) = errorColor(worst, limit);
    }
  }
  return image;
}

std::array<std::size_t, kBins> histogramOf(std::span<const double> errors, double limit) {
  std::array<std::size_t, kBins> bins{};
  for (const double e : errors) {
    if (std::isnan(e)) continue;
    const double position = (std::clamp(e / limit, -1.0, 1.0) + 1) / 2 * kBins;
    ++bins[std::min<std::size_t>(std::size_t(position), kBins - 1)];
  }
  return bins;
}

/// Points on the ends of the bar beyond which there are errors.
void drawBeyond(Canvas& canvas, const Rect& bar, const Statistics& s, double limit) {
  const auto point = [&](double base, double tip, Rgb color) {
    const Vec2 corners[] = {{bar.left, base}, {bar.left + bar.width / 2, tip}, {bar.right(), base}};
    canvas.fillPolygon(corners, color);
    canvas.polyline(corners, {.color = kInk, .width = 1});
  };
  if (s.high > limit) point(bar.top, bar.top - 12, errorColor(limit, limit));
  if (s.low < -limit) point(bar.bottom(), bar.bottom() + 12, errorColor(-limit, limit));
}

// The bar is drawn as a picture of its own, a row for each pixel, so that its colours are exactly the colours
// of the map.
void drawColorBar(Canvas& canvas, const Rect& bar, const RasterHeightfield& errors, const Statistics& s,
                  double limit, const std::string& unit) {
  Image colors(int(bar.width), int(bar.height));
  for (int y = 0; y < colors.height; ++y) {
    const double error = limit * (1 - 2.0 * y / std::max(1, colors.height - 1));
    for (int x = 0; x < colors.width; ++x) colors.at(x, y) = errorColor(error, limit);
  }
  canvas.image(colors, int(bar.left), int(bar.top));
  canvas.frame(bar, {.color = kInk, .width = 1});
  drawBeyond(canvas, bar, s, limit);
  if (s.count < errors.size()) {
    const Rect swatch = {bar.left, bar.bottom() + 22, bar.width, 14};
    canvas.fill(swatch, kNodataColor);
    canvas.frame(swatch, {.color = kInk, .width = 1});
    canvas.text("no data", {swatch.right() + 9, swatch.top + 7},
                {.size = 13, .color = kInk, .vertical = Align::center});
  }
  canvas.text(unit, {bar.left, bar.top - 18}, {.size = 14, .color = kQuietInk});

  // Ticks stand at round values; a short bar has fewer, so that their labels stay apart.
  const auto yOf = [&](double error) { return bar.top + bar.height * (1 - error / limit) / 2; };
  for (const double tick : linearTicks(-limit, limit, bar.height > 300 ? 8 : 4)) {
    canvas.line({bar.right(), yOf(tick)}, {bar.right() + 5, yOf(tick)}, {.color = kInk, .width = 1});
    const std::string label = signedText(tick);
    canvas.text(label, {bar.right() + 9, yOf(tick)}, {.size = 13, .color = kInk, .vertical = Align::center});
  }

  // The histogram stands at the height of the bar, so that a bin is next to its colour.
  const auto bins = histogramOf(errors.heights, limit);
  const double most = std::sqrt(double(*std::max_element(bins.begin(), bins.end())));
  const double left = bar.right() + kHistogramGap;
  for (int i = 0; i < kBins; ++i) {
    const double length = std::sqrt(double(bins[std::size_t(i)])) / most * (kHistogramWidth - 20);
    const double y = bar.bottom() - bar.height * (i + 1) / kBins;
    canvas.fill({left, y + 0.5, length, bar.height / kBins - 1}, {150, 157, 168});
  }
  canvas.line({left, bar.top}, {left, bar.bottom()}, {.color = kRule, .width = 1});
}

struct Plan {
  Statistics statistics;
  MapPage page;
  ErrorMapLayout layout;
};

// The limit is the one stated, or the largest error rounded up to a round number, so that maps of similar
// errors have the same colours.
Result<Plan> plan(const RasterHeightfield& errors, const ErrorMapOptions& options) {
  const Statistics s = statisticsOf(errors.heights);
  if (s.count == 0)
    return failure(ErrorCode::invalidData, "has no error to draw: no sample has one", errors.source);
  if (!(options.limit >= 0)) {
    return failure(ErrorCode::invalidData,
                   fmt::format("the colours cannot run to {}: a limit is 0 (as far as the errors) or more",
                               options.limit));
  }
  const double largest = std::max(std::abs(s.low), std::abs(s.high));
  const double limit = options.limit > 0 ? options.limit : largest > 0 ? roundUpNice(largest) : 1;
  std::vector<std::string> caption = options.caption;
  const auto valueText = [&](double value) { return fmt::format("{} {}", signedText(value), options.unit); };
  caption.push_back(fmt::format(
      "errors {} to {}   \u00b7   mean {}   \u00b7   root mean square {} {}   \u00b7   {} samples",
      valueText(s.low), valueText(s.high), valueText(s.mean), numberText(s.rms), options.unit,
      countText(s.count)));
  ARETE_TRY(auto page, makeMapPage(errors.columns, errors.rows, errors.georeference,
                                   {.width = options.width,
                                    .sideWidth = options.isDecorated ? kSideWidth : 0,
                                    .title = options.title,
                                    .caption = caption,
                                    .isDecorated = options.isDecorated}));
  const double height = std::floor(std::min(page.map.height - 84, 620.0));
  const Rect bar = {page.side.left + kBarLeft, std::floor(page.map.top + (page.map.height - height) / 2),
                    kBarWidth, height};
  const Rect map = page.map;
  return Plan{s, std::move(page), {map, bar, limit}};
}

}  // namespace

Result<ErrorMapLayout> errorMapLayout(const RasterHeightfield& errors, const ErrorMapOptions& options) {
  return plan(errors, options).map([](const Plan& p) { return p.layout; });
}

Result<Canvas> drawErrorMap(const RasterHeightfield& errors, const ErrorMapOptions& options) {
  ARETE_TRY(auto planned, plan(errors, options));
  MapPage& page = planned.page;
  page.canvas.image(errorImage(errors, page.view, planned.layout.limit), int(page.map.left),
                    int(page.map.top));
  page.finish();
  if (options.isDecorated)
    drawColorBar(page.canvas, planned.layout.colorBar, errors, planned.statistics, planned.layout.limit,
                 options.unit);
  return std::move(page.canvas);
}

}  // namespace arete

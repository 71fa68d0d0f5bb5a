// SPDX-License-Identifier: GPL-3.0-or-later
//
// The axes run a twentieth beyond the data and carry decades (with 2 and 5 on short axes); the legend stands
// in that corner of the plot in which fewest points lie.
#include "viewer/picture/chart.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "viewer/picture/inks.h"
#include "viewer/picture/ticks.h"

namespace arete {
namespace {

constexpr std::array<Rgb, 7> kColors = {{{0, 114, 178},
                                         {213, 94, 0},
                                         {0, 158, 115},
                                         {204, 121, 167},
                                         {230, 159, 0},
                                         {86, 180, 233},
                                         {60, 60, 60}}};
constexpr Rgb kGrid = {229, 232, 236}, kFineGrid = {243, 245, 247};
constexpr double kBeyond = 0.05;

struct Axis {
  double low = 1, high = 10;  // of the data, widened
  double fraction(double value) const { return std::log(value / low) / std::log(high / low); }
};

template <class Coordinate>
Axis axisOf(std::span<const ChartSeries> series, const Coordinate& coordinate) {
  double low = std::numeric_limits<double>::infinity(), high = 0;
  for (const ChartSeries& s : series) {
    for (const Vec2& p : s.points) {
      low = std::min(low, coordinate(p));
      high = std::max(high, coordinate(p));
    }
  }
  if (!(high > 0)) return {};
  // A single value gets a decade about it.
  const double widening = high > low ? std::pow(high / low, kBeyond) : std::sqrt(10.0);
  return {low / widening, high * widening};
}

/// Open marks, of what is compared against, are larger and hollow: a full mark on top leaves them to be seen.
void drawMark(Canvas& canvas, Vec2 p, std::size_t shape, Rgb color, bool isOpen) {
  constexpr Rgb kPaper = {255, 255, 255};
  const double radius = isOpen ? 7 : 4.5;
  const auto draw = [&](double r, Rgb fill) {
    if (shape % 3 == 0) {
      canvas.fillCircle(p, r, fill);
      return;
    }
    r *= 0.9;
    const Vec2 square[] = {{p.x - r, p.y - r}, {p.x + r, p.y - r}, {p.x + r, p.y + r}, {p.x - r, p.y + r}};
    const Vec2 diamond[] = {
        {p.x, p.y - 1.3 * r}, {p.x + 1.3 * r, p.y}, {p.x, p.y + 1.3 * r}, {p.x - 1.3 * r, p.y}};
    canvas.fillPolygon(shape % 3 == 1 ? square : diamond, fill);
  };
  // A rim of paper keeps full marks apart where they overlap.
  draw(radius + (isOpen ? 0 : 1.5), isOpen ? color : kPaper);
  draw(isOpen ? radius - 1.8 : radius, isOpen ? kPaper : color);
}

Stroke lineOf(std::size_t index, const ChartSeries& series) {
  return {.color = kColors[index % kColors.size()], .width = 2.25, .dash = series.dashed ? 7.0 : 0.0};
}

void drawLegend(Canvas& canvas, std::span<const ChartSeries> series, const Rect& plot,
                std::span<const Vec2> marks) {
  constexpr double kRow = 26, kSample = 40, kPadding = 14;
  const TextStyle style = {.size = 15, .color = kInk, .vertical = Align::center};
  double widest = 0;
  for (const ChartSeries& s : series) widest = std::max(widest, canvas.textWidth(s.name, style));
  const double width = widest + kSample + 12 + 2 * kPadding, height = kRow * double(series.size()) + kPadding;
  Rect best;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (const bool low : {false, true}) {
    for (const bool right : {true, false}) {
      const Rect box = {right ? plot.right() - width - 16 : plot.left + 16,
                        low ? plot.bottom() - height - 16 : plot.top + 16, width, height};
      // A margin keeps marks from touching the frame of the legend.
      const auto hidden = std::size_t(std::count_if(marks.begin(), marks.end(), [&](const Vec2& m) {
        return m.x > box.left - 20 && m.x < box.right() + 20 && m.y > box.top - 20 && m.y < box.bottom() + 20;
      }));
      if (hidden < fewest) {
        fewest = hidden;
        best = box;
      }
    }
  }
  canvas.fill(best, {255, 255, 255}, 0.92);
  canvas.frame(best, {.color = kGrid, .width = 1});
  for (std::size_t i = 0; i < series.size(); ++i) {
    const double y = best.top + kPadding / 2 + kRow * (double(i) + 0.5), x = best.left + kPadding;
    canvas.line({x, y}, {x + kSample, y}, lineOf(i, series[i]));
    drawMark(canvas, {x + kSample / 2, y}, i, kColors[i % kColors.size()], series[i].dashed);
    canvas.text(series[i].name, {x + kSample + 12, y}, style);
  }
}

Status check(std::span<const ChartSeries> series, const ChartOptions& options) {
  if (options.width < 320 || options.height < 240) {
    return failure(ErrorCode::usage,
                   fmt::format("A chart of {} x {} pixels has no room; take 320 x 240 or more.",
                               options.width, options.height));
  }
  for (const ChartSeries& s : series) {
    for (const Vec2& p : s.points) {
      if (!(p.x > 0 && p.y > 0 && std::isfinite(p.x) && std::isfinite(p.y))) {
        return failure(ErrorCode::invalidData,
                       fmt::format("The point ({}, {}) has no place on logarithmic axes.", p.x, p.y), s.name);
      }
    }
  }
  return {};
}

}  // namespace

Result<Canvas> drawLogLogChart(std::span<const ChartSeries> series, const ChartOptions& options) {
  ARETE_CHECK(check(series, options));
  auto made = Canvas::create(options.width, options.height);
  if (!made) return made;
  Canvas& canvas = *made;

  const double above = 30 + (options.title.empty() ? 0 : 38) + (options.subtitle.empty() ? 0 : 26);
  const Rect plot = {112, above, options.width - 112.0 - 40, options.height - above - 84};
  const Axis x = axisOf(series, [](const Vec2& p) { return p.x; });
  const Axis y = axisOf(series, [](const Vec2& p) { return p.y; });
  const auto place = [&](const Vec2& p) {
    return Vec2{plot.left + plot.width * x.fraction(p.x), plot.bottom() - plot.height * y.fraction(p.y)};
  };

  if (!options.title.empty()) {
    TextStyle style = {.size = 24, .color = kInk, .bold = true};
    style.size *= std::min(1.0, (options.width - 80) / canvas.textWidth(options.title, style));
    canvas.text(options.title, {40, 52}, style);
  }
  if (!options.subtitle.empty())
    canvas.text(options.subtitle, {40, options.title.empty() ? 40.0 : 80.0},
                {.size = 15.5, .color = kQuietInk});

  const TextStyle number = {.size = 14, .color = kInk};
  for (const bool major : {false, true}) {
    const Stroke grid = {.color = major ? kGrid : kFineGrid, .width = 1};
    for (const LogTick& tick : logTicks(x.low, x.high)) {
      if (tick.major != major) continue;
      const double at = std::round(place({tick.value, y.low}).x) + 0.5;
      canvas.line({at, plot.top}, {at, plot.bottom()}, grid);
      if (!major) continue;
      canvas.line({at, plot.bottom()}, {at, plot.bottom() + 6}, {.color = kInk, .width = 1});
      TextStyle style = number;
      style.horizontal = Align::center;
      style.vertical = Align::start;
      canvas.text(numberText(tick.value), {at, plot.bottom() + 12}, style);
    }
    for (const LogTick& tick : logTicks(y.low, y.high)) {
      if (tick.major != major) continue;
      const double at = std::round(place({x.low, tick.value}).y) + 0.5;
      canvas.line({plot.left, at}, {plot.right(), at}, grid);
      if (!major) continue;
      canvas.line({plot.left - 6, at}, {plot.left, at}, {.color = kInk, .width = 1});
      TextStyle style = number;
      style.horizontal = Align::end;
      style.vertical = Align::center;
      canvas.text(numberText(tick.value), {plot.left - 11, at}, style);
    }
  }
  canvas.line({plot.left, plot.bottom() + 0.5}, {plot.right(), plot.bottom() + 0.5},
              {.color = kInk, .width = 1});
  canvas.line({plot.left + 0.5, plot.top}, {plot.left + 0.5, plot.bottom()}, {.color = kInk, .width = 1});
  canvas.text(options.xLabel, {plot.left + plot.width / 2, options.height - 22.0},
              {.size = 16, .color = kInk, .horizontal = Align::center});
  canvas.text(options.yLabel, {30, plot.top + plot.height / 2},
              {.size = 16, .color = kInk, .horizontal = Align::center, .turnDegrees = 90});

  std::vector<Vec2> marks;
  for (std::size_t i = series.size(); i-- > 0;) {  // the first one on top
    std::vector<Vec2> line;
    for (const Vec2& p : series[i].points) line.push_back(place(p));
    canvas.polyline(line, lineOf(i, series[i]));
    for (const Vec2& p : line) drawMark(canvas, p, i, kColors[i % kColors.size()], series[i].dashed);
    marks.insert(marks.end(), line.begin(), line.end());
  }
  if (!series.empty()) drawLegend(canvas, series, plot, marks);
  return made;
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// One walk over the legends measures and draws: without a canvas to draw on it only measures. A scale is
// drawn as a picture, a row of pixels for each value, so that nothing is blended.
#include "viewer/decoration/legend.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "viewer/picture/inks.h"
#include "viewer/picture/ticks.h"

namespace arete {
namespace {

constexpr Rgb kPaper = {255, 255, 255};
constexpr double kBoxWidth = 1.7, kLine = 1.5, kGap = 0.6;  // in sizes of the text

/// Measures, and draws if it has a canvas.
class LegendPen {
 public:
  LegendPen(Canvas* canvas, Canvas& ruler, Vec2 corner, const LegendStyle& style)
      : canvas_(canvas), ruler_(ruler), style_(style), left_(corner.x), top_(corner.y), y_(corner.y) {}

  void legend(const ColorLegend& legend) {
    if (y_ > top_) y_ += kGap * size();
    heading(legend);
    if (legend.scale) scale(*legend.scale);
    const double below = top_ + style_.maxHeight;
    for (std::size_t i = 0; i < legend.classes.size(); ++i) {
      // The last line is kept for the number of classes that have no room.
      const bool isLast = i + 1 == legend.classes.size();
      if (y_ + kLine * size() * (isLast ? 1 : 2) > below && legend.classes.size() - i > 1) {
        text(fmt::format("and {} more", legend.classes.size() - i), left_, kQuietInk, false);
        y_ += kLine * size();
        break;
      }
      box(legend.classes[i]);
    }
  }

  Vec2 reach() const { return {right_, y_}; }
  std::vector<DrawnScale> scales;

 private:
  double size() const { return style_.textSize; }

  void text(const std::string& words, double x, Rgb color, bool isBold) {
    const TextStyle style = {.size = size(), .color = color, .bold = isBold, .vertical = Align::center};
    right_ = std::max(right_, x + ruler_.textWidth(words, style));
    if (canvas_) canvas_->text(words, {x, y_ + kLine * size() / 2}, style);
  }

  void heading(const ColorLegend& legend) {
    std::string words = legend.title;
    if (!legend.unit.empty()) words += words.empty() ? legend.unit : ", " + legend.unit;
    if (words.empty()) return;
    text(words, left_, kInk, true);
    y_ += kLine * size();
  }

  static std::vector<std::pair<double, std::string>> ticksOf(const LegendScale& scale, double height,
                                                             double textSize) {
    if (!scale.ticks.empty()) return scale.ticks;
    if (!(scale.high > scale.low)) return {{scale.low, tickTexts(std::span(&scale.low, 1)).front()}};
    const int count = std::clamp(int(height / (2.2 * textSize)), 2, 8);
    const std::vector<double> values = linearTicks(scale.low, scale.high, count);
    const std::vector<std::string> texts = tickTexts(values);
    std::vector<std::pair<double, std::string>> ticks;
    for (std::size_t i = 0; i < values.size(); ++i)
      // Numbers that doubles cannot tell apart are written once.
      if (i == 0 || texts[i] != texts[i - 1]) ticks.emplace_back(values[i], texts[i]);
    return ticks;
  }

  void scale(const LegendScale& scale) {
    const Rect bar = {std::round(left_), std::round(y_ + size() / 2), std::round(kBoxWidth * size()),
                      std::max(8.0, std::round(std::min(style_.barHeight, style_.maxHeight)))};
    const int rows = int(bar.height);
    const double span = scale.high - scale.low;
    if (canvas_) {
      Image colors(int(bar.width), rows);
      for (int row = 0; row < rows; ++row) {
        const Rgb color = laidOver(scale.map.at(scale.high - span * row / (rows - 1)), kPaper);
        for (int x = 0; x < colors.width; ++x)
          colors.at(x, row) = scale.shade ? scale.shade(color, double(x) / (colors.width - 1)) : color;
      }
      canvas_->image(colors, int(bar.left), int(bar.top));
      canvas_->frame({bar.left - 0.5, bar.top - 0.5, bar.width + 1, bar.height + 1},
                     {.color = kInk, .width = 1});
    }
    scales.push_back({bar, scale.low, scale.high});
    for (const auto& [value, words] : ticksOf(scale, bar.height, size())) {
      const double up = span > 0 ? (value - scale.low) / span : 0.5;
      const double y = bar.bottom() - 0.5 - up * (bar.height - 1);
      const TextStyle style = {.size = size(), .color = kInk, .vertical = Align::center};
      const double x = bar.right() + kGap * size();
      right_ = std::max(right_, x + ruler_.textWidth(words, style));
      if (!canvas_) continue;
      canvas_->line({bar.right(), y}, {bar.right() + 4, y}, {.color = kInk, .width = 1});
      canvas_->text(words, {x, y}, style);
    }
    right_ = std::max(right_, bar.right());
    y_ = bar.bottom() + size();
  }

  void box(const LegendClass& entry) {
    const Rect area = {std::round(left_), std::round(y_ + 0.2 * size()), std::round(kBoxWidth * size()),
                       std::round(1.1 * size())};
    if (canvas_ && !entry.colors.empty()) {
      const Vec2 middle{area.left + area.width / 2, area.top + area.height / 2};
      if (entry.mark == Legend::Mark::line) {
        canvas_->line({area.left, middle.y}, {area.right(), middle.y},
                      {.color = entry.colors.front(), .width = 2});
      } else if (entry.mark == Legend::Mark::point) {
        canvas_->fillCircle(middle, 0.35 * size(), entry.colors.front());
      } else {
        Image colors(int(area.width), int(area.height));
        for (int x = 0; x < colors.width; ++x) {
          const auto which = std::size_t(x) * entry.colors.size() / std::size_t(colors.width);
          for (int y = 0; y < colors.height; ++y) colors.at(x, y) = entry.colors[which];
        }
        canvas_->image(colors, int(area.left), int(area.top));
        canvas_->frame({area.left - 0.5, area.top - 0.5, area.width + 1, area.height + 1},
                       {.color = kInk, .width = 1});
      }
    }
    text(entry.label, area.right() + kGap * size(), kInk, false);
    y_ += kLine * size();
  }

  Canvas* canvas_;
  Canvas& ruler_;
  const LegendStyle& style_;
  double left_, top_, y_, right_ = 0;
};

}  // namespace

ColorLegend legendOf(const ColorMap& map, std::string title, std::string unit,
                     std::optional<std::pair<double, double>> range) {
  ColorLegend legend{.title = std::move(title), .unit = std::move(unit)};
  const auto [low, high] = range.value_or(std::pair{map.low(), map.high()});
  if (map.between() == ColorsBetween::linear) {
    legend.scale = LegendScale{map, low, high};
    return legend;
  }
  // The highest class is on top, as it is on a scale.
  std::vector<double> values;
  for (const ColorStop& stop : map.stops()) values.push_back(stop.value);
  std::vector<double> finite;
  std::ranges::copy_if(values, std::back_inserter(finite), [](double v) { return std::isfinite(v); });
  const std::vector<std::string> texts = tickTexts(finite);
  std::size_t next = texts.size();
  for (std::size_t i = map.stops().size(); i-- > 0;) {
    const ColorStop& stop = map.stops()[i];
    std::string label = stop.label;
    const bool isFinite = std::isfinite(stop.value);
    if (isFinite) --next;
    if (label.empty()) {
      // A class of a discrete map ends at its value; the one before begins it.
      const std::string number = isFinite ? texts[next] : stop.value > 0 ? "\u221e" : "\u2212\u221e";
      label = map.between() != ColorsBetween::discrete ? number
              : !isFinite && next > 0                  ? "above " + texts[next - 1]
              : next == 0                              ? "up to " + number
                                                       : texts[next - 1] + " to " + number;
    }
    legend.classes.push_back({{laidOver(stop.color, kPaper)}, label});
  }
  return legend;
}

Vec2 legendSize(std::span<const ColorLegend> legends, const LegendStyle& style) {
  auto ruler = Canvas::create(1, 1);
  if (!ruler) return {};
  LegendPen pen(nullptr, *ruler, {0, 0}, style);
  for (const ColorLegend& legend : legends) pen.legend(legend);
  return pen.reach();
}

std::vector<DrawnScale> drawLegends(Canvas& canvas, std::span<const ColorLegend> legends, Vec2 corner,
                                    const LegendStyle& style) {
  LegendPen pen(&canvas, canvas, corner, style);
  for (const ColorLegend& legend : legends) pen.legend(legend);
  return pen.scales;
}

}  // namespace arete

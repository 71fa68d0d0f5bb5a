// SPDX-License-Identifier: GPL-3.0-or-later
//
// A label tries places around its point, near ones first, then all over the height of the plot beside it.
#include "viewer/picture/chart_labels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "viewer/picture/inks.h"

namespace arete {
namespace {

constexpr double kLabelText = 14, kLabelHeight = 17, kClose = 30;
constexpr double kKeyText = 14, kKeyRow = 22, kKeyBox = 26, kKeyGap = 8, kKeysApart = 24;

bool areOverlapping(const Rect& a, const Rect& b) {
  return a.left < b.right() && b.left < a.right() && a.top < b.bottom() && b.top < a.bottom();
}

/// Whether a segment has a point in a rectangle: by cutting the segment at its four sides.
bool isCrossed(const Rect& room, Vec2 a, Vec2 b) {
  double from = 0, to = 1;
  const std::array<std::array<double, 3>, 4> sides = {{{a.x - b.x, a.x - room.left, 0},
                                                       {b.x - a.x, room.right() - a.x, 0},
                                                       {a.y - b.y, a.y - room.top, 0},
                                                       {b.y - a.y, room.bottom() - a.y, 0}}};
  for (const auto& [along, rest, unused] : sides) {
    if (along == 0 && rest < 0) return false;
    if (along < 0) from = std::max(from, rest / along);
    if (along > 0) to = std::min(to, rest / along);
  }
  return from <= to;
}

/// Calls use(key, left, row) for each key.
template <class Use>
int layOut(const Canvas& canvas, std::span<const ChartKey> keys, double width, const Use& use) {
  double left = 0;
  int row = 0;
  for (const ChartKey& key : keys) {
    const double room = kKeyBox + kKeyGap + canvas.textWidth(key.text, {.size = kKeyText});
    if (left > 0 && left + room > width) left = 0, ++row;
    use(key, left, row);
    left += room + kKeysApart;
  }
  return row + 1;
}

}  // namespace

void ChartLabels::avoid(std::span<const Vec2> line) {
  lines_.emplace_back(line.begin(), line.end());
}

void ChartLabels::add(Vec2 point, std::string text, Rgb color) {
  labels_.push_back({point, std::move(text), color});
}

bool ChartLabels::isFree(const Rect& room, std::span<const Placed> others) const {
  if (room.left < plot_.left || room.right() > plot_.right() || room.top < plot_.top ||
      room.bottom() > plot_.bottom())
    return false;
  for (const Placed& other : others)
    if (areOverlapping(room, other.room)) return false;
  for (const Label& label : labels_)
    if (areOverlapping(room, {label.point.x - 6, label.point.y - 6, 12, 12})) return false;
  for (const auto& line : lines_)
    for (std::size_t i = 1; i < line.size(); ++i)
      if (isCrossed(room, line[i - 1], line[i])) return false;
  return true;
}

std::vector<ChartLabels::Placed> ChartLabels::place(const Canvas& canvas) const {
  std::vector<Placed> placed;
  for (const Label& label : labels_) {
    const double width = canvas.textWidth(label.text, {.size = kLabelText}) + 4;
    const auto roomAt = [&](double left, double middle) {
      const double most = std::max(plot_.left + 2, plot_.right() - width - 2);
      return Rect{std::clamp(left, plot_.left + 2, most), middle - kLabelHeight / 2, width, kLabelHeight};
    };
    const Vec2 p = label.point;
    // Beside the point on both sides, and centred; above before below, near before far.
    const std::array<double, 3> lefts = {p.x + 10, p.x - 10 - width, p.x - width / 2};
    Placed best{label.text, label.color, roomAt(lefts[0], p.y - 16), p, false};
    for (double away = 12; away < plot_.height && !best.isFree; away += 5)
      for (const double middle : {p.y - away, p.y + away})
        for (const double left : lefts) {
          const Rect room = roomAt(left, middle);
          if (best.isFree || !isFree(room, placed)) continue;
          best.room = room;
          best.isFree = true;
        }
    placed.push_back(std::move(best));
  }
  return placed;
}

void ChartLabels::draw(Canvas& canvas) const {
  for (const Placed& label : place(canvas)) {
    const Rect& room = label.room;
    if (!label.isFree) canvas.fill(room, {255, 255, 255}, 0.85);
    const Vec2 near = {std::clamp(label.point.x, room.left, room.right()),
                       std::clamp(label.point.y, room.top, room.bottom())};
    if (std::hypot(near.x - label.point.x, near.y - label.point.y) > kClose)
      canvas.line(near, label.point, {.color = label.color, .width = 0.8, .alpha = 0.7});
    canvas.text(label.text, {room.left + 2, room.top + room.height / 2},
                {.size = kLabelText, .color = label.color, .vertical = Align::center, .halo = 2});
  }
}

void drawChartKeys(Canvas& canvas, std::span<const ChartKey> keys, Vec2 corner, double width) {
  layOut(canvas, keys, width, [&](const ChartKey& key, double left, int row) {
    const double middle = corner.y + kKeyRow * (row + 0.5), x = corner.x + left;
    if (key.shape == ChartKey::Shape::area) {
      canvas.fill({std::round(x), std::round(middle - 7), kKeyBox, 14}, key.color);
      canvas.frame({std::round(x) - 0.5, std::round(middle - 7) - 0.5, kKeyBox + 1, 15},
                   {.color = kQuietInk, .width = 1});
    } else {
      canvas.line(
          {x, middle}, {x + kKeyBox, middle},
          {.color = key.color, .width = 2.25, .dash = key.shape == ChartKey::Shape::dashes ? 5.0 : 0.0});
    }
    canvas.text(key.text, {x + kKeyBox + kKeyGap, middle},
                {.size = kKeyText, .color = kInk, .vertical = Align::center});
  });
}

double chartKeysHeight(const Canvas& canvas, std::span<const ChartKey> keys, double width) {
  return kKeyRow * layOut(canvas, keys, width, [](const ChartKey&, double, int) {});
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/base/vec.h"
#include "viewer/picture/picture.h"

namespace arete {

/// Texts at points of a chart, placed where they cross nothing that is drawn.
class ChartLabels {
 public:
  explicit ChartLabels(const Rect& plot) : plot_(plot) {}

  /// A line that no label may cross.
  void avoid(std::span<const Vec2> line);
  void add(Vec2 point, std::string text, Rgb color);

  /// Where a text was put, and the point it names.
  struct Placed {
    std::string text;
    Rgb color;
    Rect room;
    Vec2 point;
    bool isFree = true;  ///< false: no room was free; it has a white ground
  };
  /// In the order in which they were added. O(labels x points of the lines).
  std::vector<Placed> place(const Canvas& canvas) const;
  /// Draws them, with a thin line to a point that is farther away.
  void draw(Canvas& canvas) const;

 private:
  struct Label {
    Vec2 point;
    std::string text;
    Rgb color;
  };

  bool isFree(const Rect& room, std::span<const Placed> others) const;

  Rect plot_;
  std::vector<Label> labels_;
  std::vector<std::vector<Vec2>> lines_;
};

/// What is drawn in a chart, by name.
struct ChartKey {
  enum class Shape { area, line, dashes };
  std::string text;
  Rgb color;
  Shape shape = Shape::area;
};

/// Draws keys side by side, in as many rows as they need. @param corner Left top.
void drawChartKeys(Canvas& canvas, std::span<const ChartKey> keys, Vec2 corner, double width);
double chartKeysHeight(const Canvas& canvas, std::span<const ChartKey> keys, double width);

}  // namespace arete

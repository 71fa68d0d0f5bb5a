// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "engine/base/vec.h"
#include "viewer/picture/picture.h"

namespace arete {

/// Finds room for labels in a picture, one by one: who comes first stays. Each stands above its place, or
/// else beside or below it, within the picture and over no other label; or on its place and nowhere else.
class LabelPlacement {
 public:
  enum class Where { beside, on };
  /// @param gap pixels that stay free around a label.
  LabelPlacement(int widthPixels, int heightPixels, double gap = 3, Where where = Where::beside)
      : width_(widthPixels), height_(heightPixels), gap_(gap), where_(where) {}

  /// @param at its place in pixels, y downwards
  /// @param width,height of the text; it stays `away` pixels from the place
  /// @return the rectangle it has from now on, at whole pixels; nothing where all room is taken. O(labels
  /// near by).
  std::optional<Rect> place(Vec2 at, double width, double height, double away);

  /// Whether place() would find room now; a label that has none is counted as refused.
  bool hasRoom(Vec2 at, double width, double height, double away) {
    const bool has = find(at, width, height, away).has_value();
    refused_ += has ? 0 : 1;
    return has;
  }
  /// How many labels had no room.
  std::uint64_t refused() const { return refused_; }

  /// Keeps a rectangle free: of a legend, say.
  void take(const Rect& area);

 private:
  std::optional<Rect> find(Vec2 at, double width, double height, double away) const;
  bool isFree(const Rect& area) const;

  int width_, height_;
  double gap_;
  Where where_;
  std::uint64_t refused_ = 0;
  std::vector<Rect> taken_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>>
      cells_;  // into taken_, by squares of the picture
};

}  // namespace arete

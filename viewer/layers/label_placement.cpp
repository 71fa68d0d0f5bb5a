// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/layers/label_placement.h"

#include <array>
#include <cmath>
#include <span>

namespace arete {
namespace {

constexpr double kCellPixels = 64;

template <class Visit>
void forCells(const Rect& area, const Visit& visit) {
  const auto cell = [](double v) { return std::int32_t(std::floor(v / kCellPixels)); };
  for (std::int32_t y = cell(area.top); y <= cell(area.bottom()); ++y)
    for (std::int32_t x = cell(area.left); x <= cell(area.right()); ++x)
      visit(std::uint64_t(std::uint32_t(x)) << 32 | std::uint32_t(y));
}

}  // namespace

std::optional<Rect> LabelPlacement::place(Vec2 at, double width, double height, double away) {
  const auto area = find(at, width, height, away);
  if (area)
    take(*area);
  else
    ++refused_;
  return area;
}

std::optional<Rect> LabelPlacement::find(Vec2 at, double width, double height, double away) const {
  const std::array<Vec2, 8> corners = {{{at.x - width / 2, at.y - away - height},
                                        {at.x + away, at.y - height / 2},
                                        {at.x - away - width, at.y - height / 2},
                                        {at.x - width / 2, at.y + away},
                                        {at.x + away, at.y - away - height},
                                        {at.x - away - width, at.y - away - height},
                                        {at.x + away, at.y + away},
                                        {at.x - away - width, at.y + away}}};
  const std::array<Vec2, 1> middle = {{{at.x - width / 2, at.y - height / 2}}};
  for (const Vec2& corner :
       where_ == Where::on ? std::span<const Vec2>(middle) : std::span<const Vec2>(corners)) {
    const Rect area{std::round(corner.x), std::round(corner.y), width, height};
    if (area.left < 0 || area.top < 0 || area.right() > width_ || area.bottom() > height_) continue;
    if (isFree(area)) return area;
  }
  return std::nullopt;
}

void LabelPlacement::take(const Rect& area) {
  const auto index = std::uint32_t(taken_.size());
  taken_.push_back(area);
  forCells(area, [&](std::uint64_t cell) { cells_[cell].push_back(index); });
}

bool LabelPlacement::isFree(const Rect& area) const {
  const Rect wide{area.left - gap_, area.top - gap_, area.width + 2 * gap_, area.height + 2 * gap_};
  bool isFree = true;
  forCells(wide, [&](std::uint64_t cell) {
    const auto found = cells_.find(cell);
    if (found == cells_.end()) return;
    for (const std::uint32_t i : found->second) {
      const Rect& other = taken_[i];
      isFree = isFree && !(wide.left < other.right() && other.left < wide.right() &&
                           wide.top < other.bottom() && other.top < wide.bottom());
    }
  });
  return isFree;
}

}  // namespace arete

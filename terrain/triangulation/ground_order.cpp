// SPDX-License-Identifier: GPL-3.0-or-later
//
// The points are sorted by their position on a Hilbert curve through 2^32 x 2^32 cells. Points that share a
// cell, as others are far away, are ordered by a curve of their own, recursively.
#include "terrain/triangulation/ground_order.h"

#include <algorithm>
#include <cstddef>
#include <tuple>

#include "engine/memory/uninitialized_vector.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/parallel_sort.h"
#include "terrain/model/plan_box.h"

namespace arete {
namespace {

/// The index of a cell on the curve through a square of 2^32 x 2^32 cells.
std::uint64_t indexOnCurve(std::uint32_t x, std::uint32_t y) {
  std::uint64_t index = 0;
  for (int bit = 31; bit >= 0; --bit) {
    const std::uint32_t right = x >> bit & 1, up = y >> bit & 1;
    index = index << 2 | ((3 * right) ^ up);
    // The curve through a quarter is turned or mirrored: the remaining bits are transformed so that the next
    // step can treat it as if it were not. Branch-free, as the quarter is not predictable.
    const std::uint32_t turned = up - 1, mirrored = turned & (0 - right);
    const std::uint32_t swapped = (x ^ y) & turned;
    x ^= mirrored ^ swapped;
    y ^= mirrored ^ swapped;
  }
  return index;
}

}  // namespace

std::vector<std::uint32_t> groundOrder(std::span<const Vec2> positions) {
  if (positions.empty()) return {};
  const Box2 box = planBox(positions);
  // Halves, as the whole may exceed the range of a double.
  const double halfSide = std::max(box.xMax / 2 - box.xMin / 2, box.yMax / 2 - box.yMin / 2);
  const auto cell = [&](double x, double from) {
    const double part = halfSide > 0 ? (x / 2 - from / 2) / halfSide : 0;
    return static_cast<std::uint32_t>(std::min(part * 0x1p32, 0x1p32 - 1));
  };
  struct Place {
    std::uint64_t onCurve;
    std::uint32_t point;
  };
  UninitializedVector<Place> places(positions.size());
  parallelFor(IndexRange<std::size_t>(0, positions.size(), 1 << 13), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i)
      places[i] = {indexOnCurve(cell(positions[i].x, box.xMin), cell(positions[i].y, box.yMin)),
                   static_cast<std::uint32_t>(i)};
  });
  parallelSort(places.begin(), places.end(), [&](const Place& a, const Place& b) {
    if (a.onCurve != b.onCurve) return a.onCurve < b.onCurve;
    const Vec2 &p = positions[a.point], &q = positions[b.point];
    return std::tie(p.x, p.y, a.point) < std::tie(q.x, q.y, b.point);
  });
  std::vector<std::uint32_t> order(positions.size());
  std::ranges::transform(places, order.begin(), &Place::point);

  // If a few points are far away, many others share a cell: these are ordered along a curve through their own
  // bounding square. The recursion ends, as the two points farthest apart never share a cell.
  constexpr std::size_t kFew = 16;  // points in one cell whose order by coordinates is kept
  for (std::size_t begin = 0, end = 0; begin != places.size(); begin = end) {
    while (end != places.size() && places[end].onCurve == places[begin].onCurve) ++end;
    if (end - begin <= kFew || end - begin == places.size()) continue;
    const std::vector<std::uint32_t> crowd(order.begin() + static_cast<std::ptrdiff_t>(begin),
                                           order.begin() + static_cast<std::ptrdiff_t>(end));
    std::vector<Vec2> here;
    for (const std::uint32_t point : crowd) here.push_back(positions[point]);
    const std::vector<std::uint32_t> within = groundOrder(here);
    for (std::size_t i = 0; i != within.size(); ++i) order[begin + i] = crowd[within[i]];
  }
  return order;
}

}  // namespace arete

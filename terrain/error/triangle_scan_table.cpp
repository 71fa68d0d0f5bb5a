// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each sample in the bounding box of each triangle is tested against the three edges.
#include "terrain/error/triangle_scan_table.h"

#include <algorithm>

namespace arete {
namespace {

TriangleScanTable::Rows rowsOf(int bx, int by, int cx, int cy) {
  TriangleScanTable::Rows rows;
  if (bx * cy - by * cx <= 0) return {};
  int count = 0;
  const auto isCovered = [&](int x, int y) {
    const bool isCorner = (x == 0 && y == 0) || (x == bx && y == by) || (x == cx && y == cy);
    return !isCorner && bx * y - by * x >= 0 && cy * x - cx * y >= 0 &&
           (cx - bx) * (y - by) - (cy - by) * (x - bx) >= 0;
  };
  for (int y = std::min({0, by, cy}), last = std::max({0, by, cy}); y <= last; ++y) {
    const int mostX = std::max({0, bx, cx});
    int left = std::min({0, bx, cx});
    while (left <= mostX && !isCovered(left, y)) ++left;
    int end = left;
    while (end <= mostX && isCovered(end, y)) ++end;
    if (end == left && (count == 0 || count == TriangleScanTable::Rows::kMost)) continue;
    if (end - left > TriangleScanTable::Rows::kMostSamples || count == TriangleScanTable::Rows::kMost)
      return {};
    if (count == 0) rows.top = static_cast<std::int8_t>(y);
    rows.left[count] = static_cast<std::int8_t>(left);
    rows.size[count] = static_cast<std::int8_t>(end - left);
    ++count;
  }
  while (count > 0 && rows.size[count - 1] == 0) --count;
  rows.count = static_cast<std::int8_t>(count);
  return rows;
}

}  // namespace

const TriangleScanTable& TriangleScanTable::all() {
  static const TriangleScanTable triangles;
  return triangles;
}

TriangleScanTable::TriangleScanTable() {
  for (int bx = -kReach; bx <= kReach; ++bx)
    for (int by = -kReach; by <= kReach; ++by)
      for (int cx = -kReach; cx <= kReach; ++cx)
        for (int cy = -kReach; cy <= kReach; ++cy) table_[index(bx, by, cx, cy)] = rowsOf(bx, by, cx, cy);
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The rows of small triangles, from the table and computed (triangle_rows.h), against a test of every sample.
#include "terrain/error/triangle_scan_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>

#include "terrain/error/triangle_rows.h"

namespace arete {
namespace {

using Samples = std::set<std::pair<int, int>>;

/// Samples (x, y) in the closed triangle (0, 0), (bx, by), (cx, cy), but for its corners.
Samples coveredBy(int bx, int by, int cx, int cy) {
  Samples covered;
  for (int y = std::min({0, by, cy}); y <= std::max({0, by, cy}); ++y)
    for (int x = std::min({0, bx, cx}); x <= std::max({0, bx, cx}); ++x) {
      const bool isCorner = std::pair(x, y) == std::pair(0, 0) || std::pair(x, y) == std::pair(bx, by) ||
                            std::pair(x, y) == std::pair(cx, cy);
      if (!isCorner && bx * y - by * x >= 0 && cy * x - cx * y >= 0 &&
          (cx - bx) * (y - by) - (cy - by) * (x - bx) >= 0)
        covered.insert({x, y});
    }
  return covered;
}

TEST(TriangleScanTable, HasTheSamplesThatATestOfAllFinds) {
  const TriangleScanTable& table = TriangleScanTable::all();
  int known = 0;
  for (int bx = -5; bx <= 5; ++bx)
    for (int by = -5; by <= 5; ++by)
      for (int cx = -5; cx <= 5; ++cx)
        for (int cy = -5; cy <= 5; ++cy) {
          if (bx * cy - by * cx <= 0) continue;
          const TriangleScanTable::Rows& rows = table.rows(bx, by, cx, cy);
          if (rows.count < 0) continue;  // not in the table
          ++known;
          Samples listed;
          for (int k = 0; k < rows.count; ++k)
            for (int i = 0; i < rows.size[k]; ++i) listed.insert({rows.left[k] + i, rows.top + k});
          ASSERT_EQ(listed, coveredBy(bx, by, cx, cy)) << bx << ' ' << by << ' ' << cx << ' ' << cy;
        }
  EXPECT_GT(known, 1500);
}

TEST(TriangleRows, HaveTheSamplesThatATestOfAllFinds) {
  for (int bx = -7; bx <= 7; ++bx)
    for (int by = -7; by <= 7; ++by)
      for (int cx = -7; cx <= 7; ++cx)
        for (int cy = -7; cy <= 7; ++cy) {
          if (bx * cy - by * cx <= 0) continue;
          const simd::Double2 ab = {double(bx), double(by)}, ac = {double(cx), double(cy)};
          const TriangleRows rows(ab, ac, 0.5 - 0.5 / 15);
          Samples listed;
          for (double y = rows.first(); y <= rows.last(); y += 1) {
            const simd::Double2 row = rows.columnsOf(y);
            for (double i = 0; i < row[1]; i += 1) listed.insert({int(row[0] + i), int(y)});
          }
          ASSERT_EQ(listed, coveredBy(bx, by, cx, cy)) << bx << ' ' << by << ' ' << cx << ' ' << cy;
        }
}

}  // namespace
}  // namespace arete

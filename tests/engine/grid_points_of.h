// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <array>
#include <functional>

#include "engine/base/vec.h"

namespace arete::test {

/// Calls visit(x, y, z) for every whole-numbered point of the plan that a triangle contains, its border
/// included; z is the height of the triangle's plane there. By plain search through the triangle's box.
inline void forGridPointsOf(const std::array<Vec3, 3>& p,
                            const std::function<void(int, int, double)>& visit) {
  const double area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
  const int x0 = int(std::min({p[0].x, p[1].x, p[2].x})), x1 = int(std::max({p[0].x, p[1].x, p[2].x}));
  const int y0 = int(std::min({p[0].y, p[1].y, p[2].y})), y1 = int(std::max({p[0].y, p[1].y, p[2].y}));
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      std::array<double, 3> w;
      for (int i = 0; i < 3; ++i) {
        const Vec3 &a = p[(i + 1) % 3], &b = p[(i + 2) % 3];
        w[i] = ((a.x - x) * (b.y - y) - (b.x - x) * (a.y - y)) / area;
      }
      if (w[0] < 0 || w[1] < 0 || w[2] < 0) continue;
      visit(x, y, w[0] * p[0].z + w[1] * p[1].z + w[2] * p[2].z);
    }
}

}  // namespace arete::test

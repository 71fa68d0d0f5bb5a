// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/color/light.h"

#include <cstddef>

#include "viewer/color/difference.h"

namespace arete {

Rgb lit(Rgb color, const std::array<double, 3>& light) {
  if (light == std::array<double, 3>{1, 1, 1}) return color;
  std::array<double, 3> shown = linearOf(color);
  for (std::size_t i = 0; i < 3; ++i) {
    const double x = shown[i], k = light[i];
    shown[i] = k > 1 ? k * x / (1 + (k - 1) * x) : k * x;
  }
  return rgbOfLinear(shown);
}

}  // namespace arete

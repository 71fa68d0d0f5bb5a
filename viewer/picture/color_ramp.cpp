// SPDX-License-Identifier: GPL-3.0-or-later
//
// Ramps are lists of evenly spaced colours; a colour between two is mixed linearly.
#include "viewer/picture/color_ramp.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace arete {
namespace {

constexpr std::array<Rgb, 9> kDiverging = {{{10, 48, 92},
                                            {31, 95, 148},
                                            {91, 150, 190},
                                            {170, 202, 220},
                                            {243, 241, 238},
                                            {232, 198, 168},
                                            {207, 139, 92},
                                            {166, 80, 42},
                                            {106, 34, 14}}};

constexpr std::array<Rgb, 8> kHypsometric = {{{142, 170, 138},
                                              {172, 191, 149},
                                              {204, 207, 165},
                                              {223, 210, 168},
                                              {219, 190, 150},
                                              {204, 172, 142},
                                              {213, 196, 181},
                                              {243, 240, 236}}};

}  // namespace

Rgb rampColor(std::span<const Rgb> ramp, double fraction) {
  if (!(fraction > 0)) return ramp.front();
  const double position = std::min(fraction, 1.0) * double(ramp.size() - 1);
  const std::size_t below = std::min(std::size_t(position), ramp.size() - 2);
  return mix(ramp[below], ramp[below + 1], position - double(below));
}

std::span<const Rgb> divergingRamp() {
  return kDiverging;
}
std::span<const Rgb> hypsometricRamp() {
  return kHypsometric;
}

}  // namespace arete

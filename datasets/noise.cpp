// SPDX-License-Identifier: GPL-3.0-or-later
// Each lattice corner has a gradient, one of sixteen directions picked by a hash of the corner; a point takes
// the four corners' planes through zero and blends them with the quintic fade 6t^5 - 15t^4 + 10t^3, whose
// first and second derivatives vanish at the lattice lines.
#include "datasets/noise.h"

#include <array>
#include <cmath>

#include "datasets/random.h"
#include "engine/base/vec.h"

namespace arete {
namespace {

// Sixteen unit directions from Pythagorean triples (3-4-5, 5-12-13) and the axes: exact enough without a
// cosine.
constexpr std::array<Vec2, 16> kGradients = {{{1, 0},
                                              {12. / 13, 5. / 13},
                                              {0.8, 0.6},
                                              {5. / 13, 12. / 13},
                                              {0, 1},
                                              {-5. / 13, 12. / 13},
                                              {-0.8, 0.6},
                                              {-12. / 13, 5. / 13},
                                              {-1, 0},
                                              {-12. / 13, -5. / 13},
                                              {-0.6, -0.8},
                                              {-5. / 13, -12. / 13},
                                              {0, -1},
                                              {5. / 13, -12. / 13},
                                              {0.6, -0.8},
                                              {12. / 13, -5. / 13}}};

double cornerValue(std::uint64_t seed, std::int64_t column, std::int64_t row, double dx, double dy) {
  const Vec2 g = kGradients[Random::at(seed, column, row) & 15];
  return g.x * dx + g.y * dy;
}

double fade(double t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}

double blend(double a, double b, double t) {
  return a + (b - a) * t;
}

}  // namespace

double gradientNoise(std::uint64_t seed, double x, double y) {
  const double x0 = std::floor(x), y0 = std::floor(y);
  const auto column = static_cast<std::int64_t>(x0), row = static_cast<std::int64_t>(y0);
  const double dx = x - x0, dy = y - y0;
  const double u = fade(dx), v = fade(dy);
  const double top =
      blend(cornerValue(seed, column, row, dx, dy), cornerValue(seed, column + 1, row, dx - 1, dy), u);
  const double bottom = blend(cornerValue(seed, column, row + 1, dx, dy - 1),
                              cornerValue(seed, column + 1, row + 1, dx - 1, dy - 1), u);
  constexpr double kSqrt2 = 1.4142135623730951;  // the noise's range is -1/sqrt(2) .. 1/sqrt(2)
  return blend(top, bottom, v) * kSqrt2;
}

double fractalNoise(std::uint64_t seed, double x, double y, const FractalOptions& options) {
  double sum = 0, amplitude = 1, total = 0, frequency = 1;
  for (int octave = 0; octave < options.octaves; ++octave) {
    // An irrational-looking shift per octave, or all lattices' zeros would meet at the origin.
    const double shift = 0.37 * octave;
    sum += amplitude * gradientNoise(seed + static_cast<std::uint64_t>(octave), x * frequency + shift,
                                     y * frequency - shift);
    total += amplitude;
    amplitude *= options.persistence;
    frequency *= options.lacunarity;
  }
  return sum / total;
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
// The coast is a straight line bent by fractal noise. Inland, ranges rise where ridged noise (1 - |noise|)
// over bent coordinates is high; the bending keeps their crests from looking like noise. The plan of the
// ranges has the map's scale, up to 26 km; its detail is water's work, not ours.
#include "datasets/landscape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "datasets/noise.h"
#include "datasets/random.h"

namespace arete {
namespace {

double smoothStep(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace

Landscape::Landscape(std::uint64_t seed, double extentMetres, bool sea)
    : seed_(Random::mix(seed + 0x5EA)), extent_(extentMetres), sea_(sea) {
  constexpr std::array<Vec2, 8> kDirections = {
      {{1, 0}, {0.8, 0.6}, {0, 1}, {-0.6, 0.8}, {-1, 0}, {-0.8, -0.6}, {0, -1}, {0.6, -0.8}}};
  inland_ = kDirections[Random(seed_).below(kDirections.size())];
}

Landscape::Place Landscape::at(Vec2 metres) const {
  const double u = metres.x / extent_, v = metres.y / extent_;
  Place place{};
  place.inland = 1;
  if (sea_) {
    const double bays = 0.30 * fractalNoise(seed_ + 10, 2.1 * u, 2.1 * v, {7, 2, 0.5});
    place.inland = u * inland_.x + v * inland_.y + 0.36 + bays;
  }

  const double wavelength = std::min(26000.0, 0.75 * extent_);
  const double x = metres.x / wavelength, y = metres.y / wavelength;
  const double bendX = 0.55 * fractalNoise(seed_ + 20, 0.9 * x, 0.9 * y, {4, 2, 0.5});
  const double bendY = 0.55 * fractalNoise(seed_ + 30, 0.9 * x, 0.9 * y, {4, 2, 0.5});
  const double ridged = 1 - std::abs(fractalNoise(seed_ + 40, x + bendX, y + bendY, {3, 2, 0.45})) * 2.2;
  const double broad = 0.5 + 0.5 * fractalNoise(seed_ + 50, 0.6 * x, 0.6 * y, {2, 2, 0.5});
  const double ranges = std::clamp(0.65 * std::max(ridged, 0.0) + 0.5 * broad, 0.0, 1.0);
  place.uplift = (0.10 + 0.90 * ranges * ranges) * (0.05 + 0.95 * smoothStep(0.0, 0.38, place.inland));

  const double rock = fractalNoise(seed_ + 60, 3 * x + bendX, 3 * y + bendY, {4, 2, 0.6});
  place.erodibility = std::clamp(1 + 1.1 * rock, 0.4, 2.0);
  return place;
}

double Landscape::edgeHeight(const Place& place) const {
  return 700 * smoothStep(0.0, 0.7, place.inland) * (0.4 + 0.6 * place.uplift);
}

}  // namespace arete

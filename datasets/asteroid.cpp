// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lattice of a cube's surface, drawn onto a sphere, moved along its rays by noise and by craters: bowls
// with a rim, of which small ones are many and large ones few. Noise of the plane is taken on three planes
// and added up.
#include "datasets/asteroid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "datasets/noise.h"
#include "datasets/random.h"
#include "engine/base/vec.h"

namespace arete {
namespace {

constexpr int kCraters = 220;

struct Crater {
  Vec3 middle;  ///< on the unit sphere
  double radius = 0;
};

Vec3 direction(Random& random) {
  for (;;) {
    const Vec3 p{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
    const double length = norm(p);
    if (length > 0.1 && length < 1) return p / length;
  }
}

std::vector<Crater> cratersOf(std::uint64_t seed) {
  Random random(seed);
  std::vector<Crater> craters;
  for (int i = 0; i < kCraters; ++i) {
    const Vec3 middle = direction(random);
    const double u = random.unit();
    craters.push_back(
        {middle, 0.035 / std::sqrt(1 - 0.994 * u)});  // as many of 2 r as a quarter of those of r
  }
  return craters;
}

double heightOf(const std::vector<Crater>& craters, const Vec3& p) {
  double height = 0;
  for (const Crater& crater : craters) {
    const double t = norm(p - crater.middle) / crater.radius;
    if (t >= 1.6) continue;
    const double bowl = t < 1 ? t * t - 1 : 0, rim = 1 - std::min(1.0, std::abs(t - 1) / 0.6);
    height += crater.radius * (0.30 * bowl + 0.10 * rim * rim);
  }
  return height;
}

double noiseOf(std::uint64_t seed, const Vec3& p, double frequency, int octaves) {
  const FractalOptions options{.octaves = octaves};
  const Vec3 q = frequency * p;
  return (fractalNoise(seed, q.x + 11.3, q.y, options) + fractalNoise(seed + 1, q.y, q.z + 7.7, options) +
          fractalNoise(seed + 2, q.z, q.x + 3.1, options)) /
         3;
}

/// The lattice points of the surface of a cube of `cells` cells a side, as vertices of a mesh.
class CubeLattice {
 public:
  using Place = std::array<std::uint32_t, 3>;
  explicit CubeLattice(std::uint32_t cells) : cells_(cells) {}

  std::uint32_t vertexAt(const Place& place) {
    const std::uint64_t side = cells_ + 1;
    const auto [at, isNew] = numberOf_.try_emplace((place[0] * side + place[1]) * side + place[2],
                                                   static_cast<std::uint32_t>(places_.size()));
    if (isNew) places_.push_back(place);
    return at->second;
  }
  /// On the unit sphere.
  Vec3 pointOf(std::size_t vertex) const {
    const Place& p = places_[vertex];
    const auto along = [&](std::uint32_t i) { return 2.0 * i / cells_ - 1; };
    const Vec3 q{along(p[0]), along(p[1]), along(p[2])};
    return q / norm(q);
  }
  std::size_t size() const { return places_.size(); }

 private:
  std::uint32_t cells_;
  std::unordered_map<std::uint64_t, std::uint32_t> numberOf_;
  std::vector<Place> places_;
};

}  // namespace

TriangleMesh generateAsteroid(const AsteroidOptions& options) {
  const auto cells =
      static_cast<std::uint32_t>(std::max(1.0, std::sqrt(std::max(options.vertices, 8u) / 6.0)));
  CubeLattice lattice(cells);
  TriangleMesh mesh;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const std::uint32_t level : {0u, cells})
      for (std::uint32_t i = 0; i < cells; ++i)
        for (std::uint32_t j = 0; j < cells; ++j) {
          const auto at = [&](std::uint32_t u, std::uint32_t v) {
            CubeLattice::Place place{};
            place[axis] = level;
            place[(axis + 1) % 3] = i + u;
            place[(axis + 2) % 3] = j + v;
            return lattice.vertexAt(place);
          };
          std::array<std::uint32_t, 4> quad{at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
          if (level == 0) std::swap(quad[1], quad[3]);
          const bool isOdd = (i + j) % 2 != 0;
          const auto corner = [&](std::size_t k) { return quad[(k + (isOdd ? 1 : 0)) % 4]; };
          mesh.triangles.push_back({corner(0), corner(1), corner(2)});
          mesh.triangles.push_back({corner(0), corner(2), corner(3)});
        }
  const std::vector<Crater> craters = cratersOf(options.seed);
  for (std::size_t v = 0; v < lattice.size(); ++v) {
    const Vec3 p = lattice.pointOf(v);
    const double radius = 1 + 0.32 * noiseOf(options.seed, p, 1.1, 2) +
                          0.02 * noiseOf(options.seed + 10, p, 6, 4) + heightOf(craters, p);
    mesh.positions.push_back(
        {float(1.2 * radius * p.x), float(0.95 * radius * p.y), float(0.85 * radius * p.z)});
  }
  return mesh;
}

}  // namespace arete

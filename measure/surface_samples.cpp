// SPDX-License-Identifier: GPL-3.0-or-later
//
// Systematic sampling along the triangles' areas laid end to end. With A the whole area, marks stand at
// (i + u) A / count, u from the seed, and a triangle gets as many samples as marks fall on it: its share,
// rounded up or down. Within the triangle the samples follow the R2 sequence [Roberts2018], shifted by an
// offset of the triangle's own and folded from the unit square into the triangle.
#include "measure/surface_samples.h"

#include <algorithm>
#include <cmath>

#include "engine/base/nearest_on_triangle.h"

namespace arete {
namespace {

constexpr double kStepU = 0.7548776662466927, kStepV = 0.5698402909980532;  // 1 / g and 1 / g^2, g^3 = g + 1

/// SplitMix64's step and finaliser: a hash of 64 bits.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15ull;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
  return x ^ (x >> 31);
}

double unit(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

double fraction(double x) {
  return x - std::floor(x);
}

SpaceTriangle cornersOf(const TriangleMesh& mesh, std::size_t triangle) {
  const auto& v = mesh.triangles[triangle];
  return {mesh.positions[v[0]], mesh.positions[v[1]], mesh.positions[v[2]]};
}

double areaOf(const TriangleMesh& mesh, std::size_t triangle) {
  const Vec3 normal = areaNormal(cornersOf(mesh, triangle));
  return std::sqrt(dot(normal, normal)) / 2;
}

}  // namespace

double surfaceArea(const TriangleMesh& mesh) {
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) area += areaOf(mesh, t);
  return area;
}

SurfaceSamples::SurfaceSamples(const TriangleMesh& mesh, std::uint64_t count, std::uint64_t seed)
    : mesh_(mesh), seed_(mixed(seed)) {
  const double scale = static_cast<double>(count) / surfaceArea(mesh), offset = unit(seed_);
  begin_.reserve(mesh.triangles.size() + 1);
  double area = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    begin_.push_back(std::min(count, static_cast<std::uint64_t>(area * scale + offset)));
    area += areaOf(mesh, t);
  }
  begin_.push_back(count);
}

std::uint32_t SurfaceSamples::triangleOf(std::uint64_t i) const {
  return static_cast<std::uint32_t>(std::ranges::upper_bound(begin_, i) - begin_.begin() - 1);
}

Vec3 SurfaceSamples::at(std::uint64_t i, std::uint32_t& triangle) const {
  while (begin_[triangle + 1] <= i) ++triangle;
  const std::uint64_t bits = mixed(seed_ + triangle), more = mixed(bits);
  const auto k = static_cast<double>(i - begin_[triangle]);
  double u = fraction(unit(bits) + k * kStepU), v = fraction(unit(more) + k * kStepV);
  if (u + v > 1) {
    u = 1 - u;
    v = 1 - v;
  }
  const SpaceTriangle t = cornersOf(mesh_, triangle);
  return t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
}

}  // namespace arete

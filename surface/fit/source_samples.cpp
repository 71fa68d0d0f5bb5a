// SPDX-License-Identifier: GPL-3.0-or-later
//
// One sample for each equal share of the area, in the order of the triangles, so that every triangle gets the
// number that is due to it; where in its triangle a sample lies follows from its number.
#include "surface/fit/source_samples.h"

#include <cmath>

#include "surface/topology/edges.h"

namespace arete {
namespace {

/// The i-th number of the sequence of multiples of an irrational, in [0, 1).
double fraction(std::uint64_t i, double step) {
  const double x = static_cast<double>(i) * step;
  return x - std::floor(x);
}

// The sequence R2 of Roberts: multiples of the powers of the plastic number's inverse fill the square evenly.
constexpr double kFirst = 0.7548776662466927, kSecond = 0.5698402909980532;

}  // namespace

SourceSamples sampleSource(const TriangleMesh& source, std::uint64_t count) {
  SourceSamples samples;
  const auto at = [&](std::uint32_t v) -> const Vec3& { return source.positions[v]; };
  double area = 0;
  for (const auto& [i, j, k] : source.triangles) area += norm(cross(at(j) - at(i), at(k) - at(i))) / 2;
  if (!(area > 0) || !std::isfinite(area) || count == 0) return samples;
  const double share = area / static_cast<double>(count);
  samples.ofArea.reserve(count + 1);
  double sum = 0;
  for (std::uint32_t t = 0; t < source.triangles.size(); ++t) {
    const auto& [i, j, k] = source.triangles[t];
    sum += norm(cross(at(j) - at(i), at(k) - at(i))) / 2;
    while ((static_cast<double>(samples.ofArea.size()) + 0.5) * share < sum &&
           samples.ofArea.size() <= count) {
      double u = fraction(samples.ofArea.size(), kFirst), v = fraction(samples.ofArea.size(), kSecond);
      if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
      }
      samples.ofArea.push_back(at(i) + u * (at(j) - at(i)) + v * (at(k) - at(i)));
      samples.whereOfArea.push_back({t, {1 - u - v, u, v}});
    }
  }
  const double width = samples.width = std::sqrt(share);
  const MeshEdges edges(source.triangles, source.positions.size());
  double length = 0;
  const auto sample = [&](const Vec3& p, const Vec3& q) {
    const double begin = length, end = begin + norm(q - p);
    length = end;
    while ((static_cast<double>(samples.ofBorder.size()) + 0.5) * width < end) {
      const double x = (static_cast<double>(samples.ofBorder.size()) + 0.5) * width;
      samples.ofBorder.push_back(p + (x - begin) / (end - begin) * (q - p));
    }
  };
  for (std::size_t e = 0; e < edges.size(); ++e)
    if (edges[e].isBorder()) sample(at(edges[e].low.index()), at(edges[e].high.index()));
  return samples;
}

}  // namespace arete

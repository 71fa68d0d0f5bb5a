// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/displacement/displaced_places.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "engine/mt/enclosing_ball.h"
#include "surface/topology/turn_guard.h"

namespace arete {
namespace {

/// Scales are taken a billionth smaller, which makes up for rounding.
constexpr double kRounded = 1 - 1e-9;

}  // namespace

std::vector<double> promisedErrors(const MultiTriangulation& mt, const Cut& cut,
                                   const BoundedCriterion* criterion) {
  std::vector<double> promised(cut.ids.size(), cut.achievedError);
  if (criterion == nullptr || criterion->uniformError() || !cut.isComplete) return promised;
  const MetricFrame& metric = mt.metric();
  for (std::size_t t = 0; t < cut.ids.size(); ++t) {
    std::array<Vec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = metric.toMetric(mt.position(VertexId(cut.vertices[cut.triangles[t][i]])));
    // A ball around the source that the triangle stands for, then around what is drawn of it too.
    const double error = mt.error(TriangleId(cut.ids[t]));
    const EnclosingBall ball = EnclosingBall::around(corners);
    double allowed = cut.achievedError;
    for (int i = 0; i < 2; ++i) {
      EnclosingBall wider = ball;
      wider.radius += error + (i == 0 ? 0 : allowed);
      allowed = std::min(allowed, criterion->allowedError(wider.rounded()));
    }
    promised[t] = std::max(error, allowed);
  }
  return promised;
}

std::vector<Vec3> displacedPlaces(const MultiTriangulation& mt, const SurfaceDisplacement& displacement,
                                  const Cut& cut, std::span<const double> promised) {
  struct Scale {
    double wanted = 0, weight = 0, most = std::numeric_limits<double>::infinity();
  };
  std::vector<Vec3> before, directions;
  for (const std::uint32_t v : cut.vertices) {
    before.push_back(mt.position(VertexId(v)));
    directions.push_back(displacement.direction(v));
  }
  std::vector<Scale> scales(before.size());
  for (std::size_t t = 0; t < cut.ids.size(); ++t) {
    const auto& [a, b, c] = cut.triangles[t];
    const std::uint32_t id = cut.ids[t];
    const double error = mt.error(TriangleId(id)), rms = mt.decoded(kRms, TriangleId(id));
    const double longest = std::max({norm(directions[a]), norm(directions[b]), norm(directions[c])});
    const double most = longest > 0 ? displacement.reach(id, error) + (promised[t] - error) / longest
                                    : std::numeric_limits<double>::infinity();
    const double area = norm(cross(before[b] - before[a], before[c] - before[a]));
    for (const std::uint32_t v : cut.triangles[t]) {
      scales[v].wanted += area * rms;
      scales[v].weight += area;
      scales[v].most = std::min(scales[v].most, most);
    }
  }
  std::vector<std::uint8_t> stays(before.size(), 0);
  std::vector<Vec3> places = before;
  const TurnGuard guard(cut.triangles, before);
  do {
    for (std::size_t v = 0; v < places.size(); ++v) {
      const auto& [wanted, weight, most] = scales[v];
      const double scale = stays[v] == 0 && weight > 0 ? std::min(wanted / weight, most) : 0;
      places[v] = before[v] + kRounded * scale * directions[v];
    }
  } while (guard.mark(places, stays));
  return places;
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Where a box has no heights, they come from the root: every sample lies within the bounds of one of its
// triangles, so the terrain in a box of the plan lies in a column between the lowest and the highest bound.
// At most kMostBalls balls, one on top of the other and about as wide as the box, cover the column.
#include "io/query/extract/view_footprint.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace arete {
namespace {

constexpr double kMostBalls = 16;
/// Enlarges the balls, because a triangle in the column is tested by a ball of its own.
constexpr double kWiderBall = 1.25;

struct HeightRange {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

/// In metric space.
HeightRange metricHeights(const MultiTriangulation& mt) {
  HeightRange range;
  for (std::uint32_t t = 0; t < mt.rootTriangleCount(); ++t)
    for (const Vec3& p : prismOf(mt, TriangleId(t), mt.rootTriangles()[t])) {
      range.low = std::min(range.low, p.z);
      range.high = std::max(range.high, p.z);
    }
  return range;
}

}  // namespace

RequiredError requiredInView(const ViewError& view, const TerrainModel& outline) {
  const HeightRange heights = metricHeights(outline.mt);
  const MetricFrame metric = outline.mt.metric();
  return [view, heights, metric](const Box3& box) {
    const Vec3 low = metric.toMetric(box.low), high = metric.toMetric(box.high);
    // A box without heights is a column of all of the terrain's.
    const double bottom = std::max(low.z, heights.low), top = std::min(high.z, heights.high);
    const double across = std::hypot(high.x - low.x, high.y - low.y), up = std::max(top - bottom, 0.0);
    if (!std::isfinite(across + up)) return 0.0;  // not known: require everything
    const double balls = std::clamp(std::ceil(up / std::max(across, 1e-300)), 1.0, kMostBalls);
    const double radius = kWiderBall * std::hypot(across, up / balls) / 2;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < balls; ++i) {
      const double middle = bottom + (i + 0.5) * up / balls;
      least = std::min(least, view.allowedError({static_cast<float>((low.x + high.x) / 2),
                                                 static_cast<float>((low.y + high.y) / 2),
                                                 static_cast<float>(middle), static_cast<float>(radius)}));
    }
    return least;
  };
}

}  // namespace arete

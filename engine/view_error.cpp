// SPDX-License-Identifier: GPL-3.0-or-later
#include "engine/view_error.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace arete {

std::array<Vec3, 6> prismOf(const MultiTriangulation& mt, TriangleId t, const Criterion::Corners& corners) {
  const MtArrays& a = mt.arrays();
  const double above = a.scale.decode(a.above[t.index()]), below = a.scale.decode(a.below[t.index()]);
  std::array<Vec3, 6> prism;
  for (int i = 0; i < 3; ++i) {
    const Vec3 p = mt.position(VertexId(corners[i]));
    // z_TIN - z_reference lies in [-below, above].
    prism[i] = a.metric.toMetric({p.x, p.y, p.z - above});
    prism[i + 3] = a.metric.toMetric({p.x, p.y, p.z + below});
  }
  return prism;
}

ViewError::ViewError(const Options& options, const MetricFrame& metric)
    : o_(options),
      frustum_(options.view),
      errorPerReach_(options.pixels / frustum_.pixelsPerUnit() / std::abs(metric.scale.z)),
      filter_(options.view, errorPerReach_, options.outsideError) {}

double ViewError::allowedFor(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const {
  std::array<Vec3, 6> prism = prismOf(mt, t, corners);
  for (Vec3& p : prism) p = frustum_.toView(p);
  if (!frustum_.mayMeet(prism)) return o_.outsideError;
  Vec3 low = prism[0], high = prism[0];
  for (const Vec3& p : prism) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const Vec3 centre{(low.x + high.x) / 2, (low.y + high.y) / 2, (low.z + high.z) / 2};
  double squared = 0;
  for (const Vec3& p : prism)
    squared = std::max(squared, (p.x - centre.x) * (p.x - centre.x) + (p.y - centre.y) * (p.y - centre.y) +
                                    (p.z - centre.z) * (p.z - centre.z));
  return std::min(errorPerReach_ * frustum_.reach(centre, std::sqrt(squared), low.z), o_.outsideError);
}

bool ViewError::isFineEnough(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const {
  const double error = mt.error(t);
  return error == 0 || error <= allowedFor(mt, t, corners);
}

double ViewError::severity(const MultiTriangulation& mt, TriangleId t, const Corners& corners) const {
  const double error = mt.error(t);
  return error == 0 ? 0 : o_.pixels * error / allowedFor(mt, t, corners);
}

std::uint64_t ViewError::exceeding(std::span<const Sphere> balls, std::span<const float> errors) const {
  auto [exceeds, unsure] = filter_.test(balls, errors);
  for (; unsure != 0; unsure &= unsure - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(unsure));
    if (errors[i] > allowedError(balls[i])) exceeds |= std::uint64_t(1) << i;
  }
  return exceeds;
}

double ViewError::allowedError(const Sphere& s) const {
  if (!frustum_.mayMeet(s)) return o_.outsideError;
  const Vec3 centre = frustum_.toView({s.x, s.y, s.z});
  const double reach = frustum_.reach(centre, s.radius, centre.z - s.radius);
  return std::min(errorPerReach_ * reach, o_.outsideError);
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/fit/line_samples.h"

#include <algorithm>
#include <cmath>

namespace arete {

void LineSamples::add(std::uint32_t edge, const Vec3& p, const Vec3& q, double width) {
  if (!(width > 0)) return;
  const double begin = length_, end = begin + norm(q - p);
  length_ = end;
  for (;;) {
    const double at = (static_cast<double>(samples_.size()) + 0.5) * width;
    if (!(at < end)) return;
    samples_.push_back({p + (at - begin) / (end - begin) * (q - p), edge});
  }
}

double LineSamples::assign(std::span<const Vec3> positions) {
  constexpr int kMostSteps = 64;
  double sum = 0;
  for (Sample& s : samples_) {
    const auto put = [&](std::uint32_t edge) {
      const auto& [i, j] = lines_->edges[edge].ends;
      const Vec3 a = positions[i], along = positions[j] - a;
      const double squared = dot(along, along);
      const double at = squared > 0 ? std::clamp(dot(s.place - a, along) / squared, 0.0, 1.0) : 0;
      Sample put = s;
      put.edge = edge;
      put.shares = {1 - at, at};
      put.residual = s.place - (a + at * along);
      return put;
    };
    Sample best = put(s.edge);
    for (int step = 0; step < kMostSteps; ++step) {
      const std::array<std::uint32_t, 2> around = lines_->edges[best.edge].next;
      const Sample before = best;
      for (const std::uint32_t next : around) {
        if (next == MeshAttributes::kNone) continue;
        const Sample other = put(next);
        if (dot(other.residual, other.residual) < dot(best.residual, best.residual)) best = other;
      }
      if (best.edge == before.edge) break;
    }
    s = best;
    sum += dot(s.residual, s.residual);
  }
  return sum;
}

double LineSamples::largest() const {
  double most = 0;
  for (const Sample& s : samples_) most = std::max(most, norm(s.residual));
  return most;
}

}  // namespace arete

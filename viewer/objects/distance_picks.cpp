// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/objects/distance_picks.h"

namespace arete {
namespace {

constexpr Rgba kInk = {255, 196, 0, 255};

}  // namespace

void DistancePicks::add(const Pick& pick) {
  if (picks_.size() >= 2) picks_.clear();
  picks_.push_back(pick);
  layers_.remove(kLayer);
  if (picks_.size() < 2) return;
  SpaceVertices line;
  line.isAlwaysSeen = true;
  line.addLine(picks_[0].metric, picks_[1].metric, kInk);
  layers_.put(kLayer, std::move(line));
}

void DistancePicks::clear() {
  picks_.clear();
  layers_.remove(kLayer);
}

Vec3 DistancePicks::way() const {
  const Pick &a = picks_[0], &b = picks_[1];
  return a.object == b.object ? b.inObject - a.inObject : b.metric - a.metric;
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/objects/distance_picks.h"

#include <fmt/format.h>

namespace arete {
namespace {

constexpr Rgba kInk = {255, 196, 0, 255};

}  // namespace

std::string storedErrorText(double error, const std::string& unit) {
  return fmt::format("stored error {:.4g}{}{}", error, unit.empty() ? "" : " ", unit);
}

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

std::string DistancePicks::text(const std::string& unit) const {
  std::string text;
  for (std::size_t i = 0; i < picks_.size(); ++i) {
    const Pick& pick = picks_[i];
    text += fmt::format("{} {},{},{}", i == 0 ? "A" : "B", pick.inObject.x, pick.inObject.y, pick.inObject.z);
    if (!pick.material.empty()) text += " material " + pick.material;
    if (!pick.parts.empty()) text += " " + pick.parts;
    if (pick.drawnError) text += ", of the drawn triangle: " + storedErrorText(*pick.drawnError, unit);
    text += "\n";
  }
  if (picks_.size() < 2) return text;
  const Vec3 by = way();
  return text + fmt::format("distance {}{}{}, dx {}, dy {}, dz {}\n", norm(by), unit.empty() ? "" : " ", unit,
                            by.x, by.y, by.z);
}

}  // namespace arete

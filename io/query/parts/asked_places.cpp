// SPDX-License-Identifier: GPL-3.0-or-later
//
// Each question marks what it reads in a footprint, and requires full resolution of what is marked.
#include "io/query/parts/asked_places.h"

#include <cmath>

#include "io/query/extract/query_footprint.h"
#include "terrain/sight/paths.h"

namespace arete {

Result<TerrainModel> outlineOf(const AmtFile& file, const RunContext& context) {
  if (!file.model().isRaster) return file.read({}, context);
  return file.read({.wanted = requiredNowhere()}, context);
}

Result<TerrainModel> readWanted(const AmtFile& file, const TerrainModel& outline, const RequiredError& wanted,
                                const RunContext& context) {
  if (!outline.isRaster) return outline;
  return file.read({.wanted = wanted}, context);
}

RequiredError wantedAt(std::span<const Vec2> plan, const TerrainModel& outline) {
  QueryFootprint places(outline);
  for (const Vec2 place : plan) places.add(place);
  return places.within(0);
}

RequiredError wantedBetween(std::span<const std::array<Vec2, 2>> ends, const SightEarth& earth,
                            const TerrainModel& outline) {
  QueryFootprint places(outline);
  for (const auto& [first, second] : ends) {
    const Vec2 from = sightPlan(outline, first), to = sightPlan(outline, second);
    for (const Vec2 place : {from, outline.toPlan(first), to, outline.toPlan(second)}) places.add(place);
    if (!std::isfinite(from.x + from.y + to.x + to.y)) continue;
    if (const auto track = earth.track(from, to))
      places.addTrack(*track);  // without a track, the answer is an error
  }
  return places.within(0);
}

RequiredError wantedAlong(std::span<const std::vector<Vec2>> lines, const SightEarth& earth,
                          const TerrainModel& outline) {
  QueryFootprint places(outline);
  std::vector<Vec2> plan;
  for (const std::vector<Vec2>& line : lines) {
    if (line.empty()) continue;
    plan.clear();
    for (const Vec2 vertex : line) {
      places.add(outline.toPlan(vertex));
      plan.push_back(sightPlan(outline, vertex));
    }
    if (const auto track = trackAlong(plan, earth))
      places.addTrack(*track);  // without a track, the answer is an error
  }
  return places.within(0);
}

Result<RequiredError> wantedInRange(std::span<const AskedRange> observers, const SightEarth& earth,
                                    const TerrainModel& outline, std::optional<double> margin,
                                    const RunContext& context) {
  QueryFootprint places(outline);
  for (std::size_t i = 0; i < observers.size(); ++i) {
    const auto& [place, metres] = observers[i];
    context.report("find what is in range", static_cast<double>(i) / static_cast<double>(observers.size()));
    if (context.cancelled()) return failure(ErrorCode::interrupted, "the viewshed was stopped");
    if (!std::isfinite(metres)) return RequiredError();
    const Vec2 plan = sightPlan(outline, place);
    places.add(plan);
    places.addDisc(earth, plan, metres);
  }
  if (margin) places.addRectangle(*margin);
  return places.within(0);
}

}  // namespace arete

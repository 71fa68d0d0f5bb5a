// SPDX-License-Identifier: GPL-3.0-or-later
//
// Plane tracks: the map coordinates of both ends, scaled to metres by the units and the scale of the CRS.
#include "terrain/sight/earth.h"

#include <cmath>
#include <numbers>

namespace arete {
namespace {

class PlaneEarth final : public SightEarth {
 public:
  explicit PlaneEarth(const TerrainModel& model) : model_(model) {
    const Georeference& g = model.georeference;
    perX_ = perY_ = g.crsWkt.empty() ? 1 : g.linearUnitMetres;
    if (g.mapScale) {
      perX_ /= (*g.mapScale)[0];
      perY_ /= (*g.mapScale)[1];
    }
    if (g.isGeographic && model.isRaster) {
      const Vec2 unit = groundUnit(g, g.toSource((model.columns - 1) / 2.0, (model.rows - 1) / 2.0).y);
      perX_ = unit.x;
      perY_ = unit.y;
    }
  }

  Result<SightTrack> track(Vec2 from, Vec2 to) const override {
    from = sightEnd(model_, from);
    to = sightEnd(model_, to);
    const Vec2 a = model_.toSource(from), b = model_.toSource(to);
    const double east = (b.x - a.x) * perX_, north = (b.y - a.y) * perY_;
    SightTrack track;
    track.points = {{from, 0}, {to, std::hypot(east, north)}};
    const double degrees = std::atan2(east, north) * 180 / std::numbers::pi;
    track.azimuthDegrees = degrees < 0 ? degrees + 360 : degrees;
    return track;
  }

  std::optional<PlaneSteps> planeSteps() const override {
    const Vec2 origin = model_.toSource({0, 0}), x = model_.toSource({1, 0}), y = model_.toSource({0, 1});
    return PlaneSteps{{(x.x - origin.x) * perX_, (x.y - origin.y) * perY_},
                      {(y.x - origin.x) * perX_, (y.y - origin.y) * perY_}};
  }

 private:
  const TerrainModel& model_;
  double perX_ = 1, perY_ = 1;
};

}  // namespace

std::optional<double> SightEarth::distance(Vec2 from, Vec2 to) const {
  const auto found = track(from, to);
  if (!found) return std::nullopt;
  return found->points.back().distance;
}

Result<SightTrack> trackAlong(std::span<const Vec2> places, const SightEarth& earth) {
  Result<SightTrack> whole = earth.track(places[0], places[places.size() > 1 ? 1 : 0]);
  for (std::size_t i = 2; whole && i < places.size(); ++i) {
    const auto part = earth.track(places[i - 1], places[i]);
    if (!part) return part;
    const double before = whole->points.back().distance;
    for (std::size_t k = 1; k < part->points.size(); ++k)
      whole->points.push_back({part->points[k].plan, before + part->points[k].distance});
  }
  return whole;
}

Vec2 sightEnd(const TerrainModel& model, Vec2 plan, double margin) {
  const auto onLine = [margin](double v) {
    const double line = std::round(v);
    return std::fabs(v - line) <= margin ? line : v;
  };
  return model.isRaster ? Vec2{onLine(plan.x), onLine(plan.y)} : plan;
}

std::unique_ptr<SightEarth> makePlaneEarth(const TerrainModel& model) {
  return std::make_unique<PlaneEarth>(model);
}

}  // namespace arete

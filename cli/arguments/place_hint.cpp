// SPDX-License-Identifier: GPL-3.0-or-later
//
// The numbers are the only evidence. On a map in metres a place of a few hundred at most, and off the DEM, is
// degrees far more often than a place.
#include "cli/arguments/place_hint.h"

#include <cmath>

#include "terrain/model/plan_box.h"

namespace arete {
namespace {

bool isOnBox(Vec2 xy, const TerrainModel& model) {
  const Box2 box = planBox(model);
  const Vec2 p = model.toPlan(xy);
  // Half a pixel around the first and last samples belongs to the raster.
  const double rim = model.isRaster ? 0.5 : 0;
  return p.x >= box.xMin - rim && p.x <= box.xMax + rim && p.y >= box.yMin - rim && p.y <= box.yMax + rim;
}

bool isMapOfLengths(const TerrainModel& model) {
  return !model.georeference.crsWkt.empty() && !model.georeference.isGeographic;
}

bool mayBeLonLat(Vec2 p) {
  return std::abs(p.x) <= 180 && std::abs(p.y) <= 90;
}

}  // namespace

std::string degreesHint(Vec2 place, const TerrainModel& model) {
  if (!isMapOfLengths(model) || isOnBox(place, model)) return {};
  if (mayBeLonLat(place)) return "longitude,latitude? add --lonlat";
  if (mayBeLonLat({place.y, place.x})) return "latitude,longitude? state longitude,latitude and add --lonlat";
  return {};
}

std::string degreesHint(const Box2& box, const TerrainModel& model) {
  if (!isMapOfLengths(model)) return {};
  const Vec2 low{box.xMin, box.yMin}, high{box.xMax, box.yMax};
  if (isOnBox(low, model) || isOnBox(high, model)) return {};
  if (mayBeLonLat(low) && mayBeLonLat(high)) return "longitude,latitude? add --region-crs EPSG:4326";
  if (mayBeLonLat({low.y, low.x}) && mayBeLonLat({high.y, high.x}))
    return "latitude,longitude? state longitude,latitude and add --region-crs EPSG:4326";
  return {};
}

std::string behindSemicolon(const std::string& hint) {
  return hint.empty() ? hint : "; " + hint;
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/bent/utm.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "io/geo/crs/lonlat.h"
#include "io/geo/crs/reader.h"
#include "io/geo/gdal/support.h"

namespace arete {
namespace {

constexpr const char* kUtmCulprit = "toCrs utm";
constexpr double kSouthernmost = -80, kNorthernmost = 84, kBeyondZone = 3;

/// The codes of EPSG for UTM on a datum: EPSG:32600 + zone in the north.
struct UtmFamily {
  int geographic, north, south, firstZone, lastZone;  // 0: there is none in the south
};
constexpr std::array kUtmFamilies = {UtmFamily{4326, 32600, 32700, 1, 60}, UtmFamily{4269, 26900, 0, 1, 23},
                                     UtmFamily{4258, 25800, 0, 28, 38}};

int codeOf(const OGRSpatialReference& own, int zone, bool isNorth) {
  for (const UtmFamily& family : kUtmFamilies) {
    OGRSpatialReference known;
    if (known.importFromEPSG(family.geographic) != OGRERR_NONE) continue;
    known.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const int base = isNorth ? family.north : family.south;
    if (known.IsSame(&own) && base != 0 && zone >= family.firstZone && zone <= family.lastZone)
      return base + zone;
  }
  return 0;
}

}  // namespace

UtmZone utmZoneAt(double longitude, double latitude, bool hasWiderZones) {
  const double turned = longitude - 360 * std::floor((longitude + 180) / 360);  // -180 to 180
  const int number = std::clamp(static_cast<int>(std::floor((turned + 180) / 6)) + 1, 1, 60);
  const double whole = longitude - turned;
  const auto zone = [&](int n, double west, double east) { return UtmZone{n, whole + west, whole + east}; };
  if (hasWiderZones && latitude >= 56 && latitude < 64) {
    if (turned >= 0 && turned < 3) return zone(31, 0, 3);
    if (turned >= 3 && turned < 12) return zone(32, 3, 12);
  }
  if (hasWiderZones && latitude >= 72 && turned >= 0 && turned < 42) {
    if (turned < 9) return zone(31, 0, 9);
    if (turned < 21) return zone(33, 9, 21);
    if (turned < 33) return zone(35, 21, 33);
    return zone(37, 33, 42);
  }
  return zone(number, 6.0 * number - 186, 6.0 * number - 180);
}

Result<OGRSpatialReference> utmOf(const Georeference& georeference, std::span<const Vec3> positions) {
  const auto refuse = [](ErrorCode code, std::string message) {
    return failure(code, std::move(message), kUtmCulprit);
  };
  auto lonLat = CrsLonLat::of(georeference);
  if (!lonLat) return refuse(lonLat.error().code, lonLat.error().message);
  std::vector<Vec2> places;
  places.reserve(positions.size());
  for (const Vec3& p : positions) places.push_back({p.x, p.y});
  lonLat->toLonLat(places);
  Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high{-low.x, -low.y};
  for (Vec2 p : places) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y))
      return refuse(ErrorCode::invalidData, "a vertex has no longitude and latitude");
    // Longitudes of a map jump at the antimeridian; a CRS in degrees has no such jump.
    if (!lonLat->isPlain()) p.x = places[0].x + std::remainder(p.x - places[0].x, 360);
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  if (places.empty()) return refuse(ErrorCode::usage, "has no vertex that a zone could be chosen for");
  constexpr double kEarthMetres = 6378137;
  const bool isOnEarth = std::abs(georeference.semiMajorAxisMetres / kEarthMetres - 1) < 0.01;
  const Vec2 middle = 0.5 * (low + high);
  const UtmZone zone = utmZoneAt(middle.x, middle.y, isOnEarth);
  if (low.y < kSouthernmost || high.y > kNorthernmost)
    return refuse(
        ErrorCode::usage,
        fmt::format("latitudes from {:.6g} to {:.6g} are beyond UTM, which ends at -80 and 84; a polar "
                    "map has them (EPSG:3413 in the north, EPSG:3031 in the south)",
                    low.y, high.y));
  if (low.x < zone.west - kBeyondZone || high.x > zone.east + kBeyondZone)
    return refuse(
        ErrorCode::usage,
        fmt::format("longitudes from {:.6g} to {:.6g} are more than 3 degrees beyond zone {} of the "
                    "middle, {} to {}; state another CRS, or take `metric`",
                    low.x, high.x, zone.number, zone.west, zone.east));

  registerGdal();
  ARETE_TRY(const auto crs, crsFromText(georeference.crsWkt));
  OGRSpatialReference own;
  own.CopyGeogCSFrom(&crs);
  own.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  if (own.GetPrimeMeridian() != 0)
    return refuse(ErrorCode::unsupported,
                  "the longitudes of its CRS do not count from Greenwich; state the CRS itself");
  const bool isNorth = middle.y >= 0;
  OGRSpatialReference utm;
  const int code = codeOf(own, zone.number, isNorth);
  if (code == 0 || utm.importFromEPSG(code) != OGRERR_NONE) {
    const char* const name = own.GetName();
    utm.SetProjCS(
        fmt::format("{} / UTM zone {}{}", name ? name : "unknown", zone.number, isNorth ? "N" : "S").c_str());
    utm.CopyGeogCSFrom(&own);
    utm.SetUTM(zone.number, isNorth ? TRUE : FALSE);
    utm.AutoIdentifyEPSG();
  }
  utm.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return utm;
}

}  // namespace arete

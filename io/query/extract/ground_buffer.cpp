// SPDX-License-Identifier: GPL-3.0-or-later
//
// The chains are cut into runs that a local map shows without distortion: azimuthal equidistant about the
// middle of the run ([Karney2013], GeographicLib). GEOS draws the buffer of the run there, wider by what it
// simplifies (a hundredth of the distance), by what its polygons cut off the arcs, and by what the map
// stretches. The rings of the buffer are brought into the CRS, and all are united with the polygons
// themselves.
#include "io/query/extract/ground_buffer.h"

#include <fmt/format.h>
#include <ogr_geometry.h>

#include <GeographicLib/AzimuthalEquidistant.hpp>
#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "engine/base/caught_failure.h"
#include "io/geo/crs/chain_projection.h"
#include "io/geo/crs/longitude_turns.h"
#include "io/geo/crs/lonlat.h"
#include "io/geo/gdal/polygon_set.h"
#include "io/geo/gdal/support.h"

namespace arete {
namespace {

using GeographicLib::AzimuthalEquidistant;
using GeographicLib::Geodesic;

/// Parts of the distance: what the buffer is wider by, how far an edge may be from the geodesic that stands
/// for it, and a ring in the CRS from the ring of the buffer.
constexpr double kWider = 1.018, kEdgeDeviation = 1e-3, kRingDeviation = 2e-3;
/// The least of these deviations, in metres.
constexpr double kLeastSlack = 1e-3;
constexpr int kQuadrantSegments = 16;
/// Extent of a run in metres: within these, and at most kRunDistances times the distance.
constexpr double kShortestRun = 1e3, kLongestRun = 5e4, kRunDistances = 2e3;
constexpr int kMostBisections = 30;
constexpr std::size_t kRunsPerReport = 64;

/// A position on the map, with its longitude and latitude.
struct Place {
  Vec2 xy, lonLat;
};

class GroundBuffer {
 public:
  GroundBuffer(const Georeference& georeference, const CrsLonLat& lonLat, double distance)
      : lonLat_(lonLat),
        geodesic_(georeference.semiMajorAxisMetres,
                  georeference.inverseFlattening == 0 ? 0 : 1 / georeference.inverseFlattening),
        azimuthal_(geodesic_),
        radius_(georeference.semiMajorAxisMetres),
        distance_(distance),
        slack_(std::max(kEdgeDeviation * distance, kLeastSlack)),
        run_(std::clamp(kRunDistances * distance, kShortestRun, kLongestRun)) {
    projection_.turn = turnOf(georeference);
    projection_.pole = georeference.isGeographic ? projection_.turn / 4 : projection_.turn;
  }

  /// Adds the buffer of a chain.
  Status add(std::vector<Vec2> chain, bool isRing, const RunContext& context) {
    if (isRing) chain.push_back(chain.front());
    std::vector<Place> places;
    if (!addPlace(chain[0], places)) return outOfReach();
    for (std::size_t i = 1; i < chain.size(); ++i) {
      const auto end = placeOf(chain[i]);
      if (!end || !addEdge(places.back(), *end, 0, places)) return outOfReach();
    }
    for (std::size_t begin = 0, n = 0;; ++n) {
      if (n % kRunsPerReport == 0 && context.cancelled())
        return failure(ErrorCode::interrupted, "reading was stopped");
      std::size_t end = begin + 1;
      while (end < places.size() && metresBetween(places[begin], places[end]) <= run_) ++end;
      if (Status added =
              addRun({places.begin() + std::ptrdiff_t(begin), places.begin() + std::ptrdiff_t(end)});
          !added)
        return added;
      if (end == places.size()) return {};
      begin = std::max(end - 1, begin + 1);
    }
  }

  OGRMultiPolygon polygons;

 private:
  static tl::unexpected<Error> outOfReach() {
    return failure(ErrorCode::invalidData,
                   "has ground within the distance that the CRS of the DEM has no coordinates for");
  }

  std::optional<Place> placeOf(Vec2 xy) const {
    Place place{xy, xy};
    lonLat_.toLonLat({&place.lonLat, 1});
    if (!std::isfinite(place.lonLat.x) || !(std::abs(place.lonLat.y) <= 90 + 1e-9)) return std::nullopt;
    place.lonLat.y = std::clamp(place.lonLat.y, -90.0, 90.0);
    return place;
  }
  bool addPlace(Vec2 xy, std::vector<Place>& places) const {
    const auto place = placeOf(xy);
    if (place) places.push_back(*place);
    return place.has_value();
  }
  double metresBetween(const Place& a, const Place& b) const {
    double metres = 0;
    geodesic_.Inverse(a.lonLat.y, a.lonLat.x, b.lonLat.y, b.lonLat.x, metres);
    return metres;
  }
  Vec2 onLocalMap(const Place& centre, const Place& place) const {
    Vec2 p;
    azimuthal_.Forward(centre.lonLat.y, centre.lonLat.x, place.lonLat.y, place.lonLat.x, p.x, p.y);
    return p;
  }

  /// Appends what divides the edge from a to b into parts that are short and nearly geodesics, and b.
  bool addEdge(const Place a, const Place& b, int depth, std::vector<Place>& places) const {
    const Vec2 end = onLocalMap(a, b);
    const double length = std::hypot(end.x, end.y);
    bool isStraight = length <= run_ / 2;
    for (const double t : {0.25, 0.5, 0.75}) {
      if (!isStraight) break;
      const auto at = placeOf((1 - t) * a.xy + t * b.xy);
      if (!at) return false;
      const Vec2 p = onLocalMap(a, *at);
      isStraight = std::abs(cross(end, p)) <= slack_ * length &&
                   std::hypot(p.x, p.y) <= length * (1 + kEdgeDeviation) + kLeastSlack;
    }
    if (isStraight || depth == kMostBisections) {
      places.push_back(b);
      return isStraight;
    }
    const auto middle = placeOf(0.5 * (a.xy + b.xy));
    return middle && addEdge(a, *middle, depth + 1, places) && addEdge(*middle, b, depth + 1, places);
  }

  Status addRun(const std::vector<Place>& run) {
    const Place centre = run[run.size() / 2];
    OGRLineString line;
    double farthest = 0;
    for (const Place& place : run) {
      const Vec2 p = onLocalMap(centre, place);
      farthest = std::max(farthest, std::hypot(p.x, p.y));
      line.addPoint(p.x, p.y);
    }
    // Across the direction from its centre the map stretches lengths by 1 + r^2 / (6 R^2), and hardly more on
    // an ellipsoid.
    const double angle = (farthest + 1.1 * distance_) / radius_;
    const double wide = distance_ * (kWider + angle * angle / 5) + 2 * kLeastSlack;
    const GdalErrors quiet;
    const OGRPoint point(line.getX(0), line.getY(0));
    const bool isPoint = farthest == 0;
    const std::unique_ptr<OGRGeometry> drawn(isPoint ? point.Buffer(wide, kQuadrantSegments)
                                                     : line.Buffer(wide, kQuadrantSegments));
    if (!drawn || wkbFlatten(drawn->getGeometryType()) != wkbPolygon)
      return failure(ErrorCode::unsupported, "cannot be extended: GDAL has no GEOS, or it fails");
    OGRMultiPolygon buffer;
    buffer.addGeometry(drawn.get());
    std::vector<Ring> rings;
    for (const Ring& ring : ringsOf(buffer)) {
      auto projected = projectRing(ring, aboutPlace(centre));
      if (!projected) return outOfReach();
      rings.push_back(std::move(*projected));
    }
    const OGRMultiPolygon onMap = polygonsOf(rings);
    for (const OGRPolygon* polygon : onMap) polygons.addGeometry(polygon);
    return {};
  }

  ChainProjection aboutPlace(const Place& centre) const {
    ChainProjection projection = projection_;
    projection.deviation = std::max(kRingDeviation * distance_, kLeastSlack);
    projection.forward = [this, centre](Vec2 p) -> std::optional<Vec2> {
      Vec2 at;
      azimuthal_.Reverse(centre.lonLat.y, centre.lonLat.x, p.x, p.y, at.y, at.x);
      lonLat_.toCrs({&at, 1});
      if (!std::isfinite(at.x) || !std::isfinite(at.y)) return std::nullopt;
      return at;
    };
    projection.back = [this, centre](Vec2 p) -> std::optional<Vec2> {
      // The poles, which are asked for, have any longitude.
      return onLocalMap(centre, {p, {0, p.y > 0 ? 90.0 : -90.0}});
    };
    return projection;
  }

  const CrsLonLat& lonLat_;
  Geodesic geodesic_;
  AzimuthalEquidistant azimuthal_;
  ChainProjection projection_;
  double radius_, distance_, slack_, run_;
};

}  // namespace

Result<RegionShape> extendedOnGround(const RegionShape& shape, const Georeference& georeference,
                                     Warnings& warnings, const RunContext& context) try {
  const auto lonLat = CrsLonLat::of(georeference);
  if (!(shape.distance > 0) || !lonLat) return shape;
  if (shape.distance > kLargestGroundDistance)
    return failure(ErrorCode::usage, fmt::format("a distance above {:.0f} km is too large to be drawn around",
                                                 kLargestGroundDistance / 1000));
  GroundBuffer buffer(georeference, *lonLat, shape.distance);
  for (const auto& ring : shape.rings) ARETE_CHECK(buffer.add(ring, true, context));
  for (const auto& line : shape.lines) ARETE_CHECK(buffer.add(line, false, context));
  OGRMultiPolygon all = polygonsOf(shape.rings);
  for (const OGRPolygon* polygon : buffer.polygons) all.addGeometry(polygon);
  return RegionShape{.rings = ringsOf(united(repaired(all, warnings), warnings))};
} catch (...) {
  return caughtFailure();
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The geodesic is halved until it is straight enough: level k has 2^k + 1 places, and the places that level
// k + 1 adds are the middles that level k is judged by, so nothing is computed twice but the last level.
// Longitudes run on without a jump (LONG_UNROLL), so a geographic CRS needs care only in the end: where the
// target is stated a turn away from where the geodesic arrives.
#include "io/crs/ellipsoid_earth.h"

#include <fmt/format.h>

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/GeodesicLine.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "io/crs/lonlat.h"
#include "terrain/model/plan_box.h"

namespace arete {
namespace {

using GeographicLib::Geodesic;
using GeographicLib::GeodesicLine;

/// Of a sample's step, in either direction.
constexpr double kPlanError = 1e-3;
/// A line that is not straight after this many halvings is none in plan: it passes a pole or a seam.
constexpr int kMostHalvings = 14;
/// Of the effective Earth, in radians; half a turn is where the formula ends.
constexpr double kLongestAngle = 3;
/// Latitudes this little beyond a pole are rounding.
constexpr double kPoleDegrees = 1e-9;

/// What the plan of a model is like.
struct PlanExtent {
  double step = 1;    ///< of a sample; of points, their mean spacing
  double middle = 0;  ///< of x
  double lowest = 0;  ///< y
};

PlanExtent extentOf(const TerrainModel& model) {
  if (model.isRaster) return {1, (model.columns - 1) / 2.0, 0};
  const Box2 box = planBox(model);
  const double area = (box.xMax - box.xMin) * (box.yMax - box.yMin);
  return {std::sqrt(area / std::max(1u, model.mt.vertexCount())), (box.xMin + box.xMax) / 2, box.yMin};
}

class EllipsoidEarth final : public SightEarth {
 public:
  EllipsoidEarth(const TerrainModel& model, CrsLonLat lonLat, double refraction)
      : model_(model),
        lonLat_(std::move(lonLat)),
        a_(model.georeference.semiMajorAxisMetres),
        f_(model.georeference.inverseFlattening == 0 ? 0 : 1 / model.georeference.inverseFlattening),
        geodesic_(a_, f_),
        bend_(1 - refraction) {
    const PlanExtent extent = extentOf(model);
    tolerance_ = kPlanError * extent.step;
    middle_ = extent.middle;
    lowest_ = extent.lowest;
  }

  std::optional<double> distance(Vec2 from, Vec2 to) const override {
    const Vec2 stated[2] = {model_.toSource(sightEnd(model_, from)), model_.toSource(sightEnd(model_, to))};
    const auto ends = lonLatOf(stated);
    if (!ends) return std::nullopt;
    double length = 0;
    geodesic_.Inverse((*ends)[0].y, (*ends)[0].x, (*ends)[1].y, (*ends)[1].x, length);
    return length;
  }

  Result<SightTrack> track(Vec2 from, Vec2 to) const override {
    from = sightEnd(model_, from);
    to = sightEnd(model_, to);
    const Vec2 stated[2] = {model_.toSource(from), model_.toSource(to)};
    const auto places = lonLatOf(stated);
    if (!places) return tl::unexpected(places.error());
    const auto& ends = *places;
    double length = 0, azimuth = 0, arrival = 0;
    geodesic_.Inverse(ends[0].y, ends[0].x, ends[1].y, ends[1].x, length, azimuth, arrival);
    SightTrack track;
    track.azimuthDegrees = azimuth < 0 ? azimuth + 360 : azimuth;
    if (!(length > 0)) {
      track.azimuthDegrees = 0;
      track.points = {{from, 0}, {from, 0}};
      return track;
    }
    const GeodesicLine line =
        geodesic_.Line(ends[0].y, ends[0].x, azimuth,
                       Geodesic::LATITUDE | Geodesic::LONGITUDE | Geodesic::AZIMUTH | Geodesic::DISTANCE_IN);
    track.groundCurvature = curvatureInTheMiddle(line, length);
    track.curvature = bend_ * track.groundCurvature;
    if (!(std::abs(track.curvature) * length < kLongestAngle))
      return failure(ErrorCode::invalidData,
                     fmt::format("a line of {:.0f} km is too long for the effective radius of {:.0f} km",
                                 length / 1000, 1 / std::abs(track.curvature) / 1000),
                     lineText(stated));
    // How many turns further east than the geodesic arrives the target is stated. The way back from a map's
    // coordinates knows where to go.
    const double turns = lonLat_.isPlain() ? std::round((ends[1].x - lonLatOn(line, length).x) / 360) : 0;
    const auto plan = straightened(line, length, from, turns == 0 ? std::optional(to) : std::nullopt);
    if (!plan)
      return failure(
          ErrorCode::invalidData,
          "is no line on the map: the shortest way passes a pole or a seam of the CRS, or leaves its reach",
          lineText(stated));
    const std::size_t pieces = plan->size() - 1;
    track.points.reserve(pieces + 1);
    for (std::size_t i = 0; i <= pieces; ++i)
      track.points.push_back({(*plan)[i], length * static_cast<double>(i) / static_cast<double>(pieces)});
    if (turns != 0 && !goRound(track.points, turns, to))
      return failure(ErrorCode::invalidData,
                     "is no line on the map: the shortest way leaves it where longitudes begin again",
                     lineText(stated));
    return track;
  }

  /// The middles of pieces are held to the tolerance; the rest of an arc is hardly farther off.
  std::optional<double> geodesicError() const override { return 1.1 * tolerance_; }

 private:
  /// Of two places in source coordinates. Errors: invalidData, naming the one that has none.
  Result<std::array<Vec2, 2>> lonLatOf(const Vec2 (&stated)[2]) const {
    std::array<Vec2, 2> ends{stated[0], stated[1]};
    lonLat_.toLonLat(ends);
    for (int i = 0; i < 2; ++i) {
      if (std::abs(ends[i].y) <= 90 + kPoleDegrees) ends[i].y = std::clamp(ends[i].y, -90.0, 90.0);
      if (!std::isfinite(ends[i].x) || !(std::abs(ends[i].y) <= 90))
        return failure(ErrorCode::invalidData, "the CRS of the DEM can tell no longitude and latitude there",
                       placeText(stated[i]));
    }
    return ends;
  }

  static std::string placeText(Vec2 p) { return fmt::format("{},{}", p.x, p.y); }
  static std::string lineText(const Vec2 (&ends)[2]) {
    return fmt::format("{} to {}", placeText(ends[0]), placeText(ends[1]));
  }

  /// 1 / R, by Euler's theorem.
  double curvatureInTheMiddle(const GeodesicLine& line, double length) const {
    double latitude = 0, longitude = 0, azimuth = 0;
    line.Position(length / 2, latitude, longitude, azimuth);
    constexpr double kRadians = std::numbers::pi / 180;
    const double e2 = f_ * (2 - f_), s = std::sin(latitude * kRadians), w2 = 1 - e2 * s * s;
    const double alongMeridian = w2 * std::sqrt(w2) / (a_ * (1 - e2)), across = std::sqrt(w2) / a_;
    const double north = std::cos(azimuth * kRadians), east = std::sin(azimuth * kRadians);
    return north * north * alongMeridian + east * east * across;
  }

  /// The places of the geodesic that cut it into equal pieces, straight enough. Nothing where none are.
  std::optional<std::vector<Vec2>> straightened(const GeodesicLine& line, double length, Vec2 from,
                                                std::optional<Vec2> to) const {
    std::vector<Vec2> plan = {from, to ? *to : placeOn(line, length)}, middles;
    for (int halvings = 0; halvings <= kMostHalvings; ++halvings) {
      const std::size_t pieces = plan.size() - 1;
      middles.resize(pieces);
      const double step = length / static_cast<double>(pieces);
      for (std::size_t i = 0; i < pieces; ++i) middles[i] = lonLatOn(line, (double(i) + 0.5) * step);
      toPlan(middles);
      bool isStraight = true;
      for (std::size_t i = 0; i < pieces; ++i) {
        const double dx = std::abs((plan[i].x + plan[i + 1].x) / 2 - middles[i].x),
                     dy = std::abs((plan[i].y + plan[i + 1].y) / 2 - middles[i].y);
        if (!std::isfinite(dx + dy)) return std::nullopt;
        if (dx > tolerance_ || dy > tolerance_) isStraight = false;
      }
      if (isStraight) return plan;
      std::vector<Vec2> finer;
      finer.reserve(2 * pieces + 1);
      for (std::size_t i = 0; i < pieces; ++i) {
        finer.push_back(plan[i]);
        finer.push_back(middles[i]);
      }
      finer.push_back(plan.back());
      plan = std::move(finer);
    }
    return std::nullopt;
  }

  static Vec2 lonLatOn(const GeodesicLine& line, double distance) {
    double latitude = 0, longitude = 0, unused = 0;
    line.GenPosition(false, distance, Geodesic::LATITUDE | Geodesic::LONGITUDE | Geodesic::LONG_UNROLL,
                     latitude, longitude, unused, unused, unused, unused, unused, unused);
    return {longitude, latitude};
  }
  void toPlan(std::span<Vec2> lonLat) const {
    lonLat_.toCrs(lonLat);
    for (Vec2& p : lonLat) p = model_.toPlan(p);
  }
  Vec2 placeOn(const GeodesicLine& line, double distance) const {
    Vec2 p = lonLatOn(line, distance);
    toPlan({&p, 1});
    return p;
  }

  /// Lets a track that runs out of one side of the map go on where it enters the other: what is behind the
  /// seam is moved by a turn, and the way between, of no length, is led around the map. False where there is
  /// no such seam. Precondition: a geographic CRS.
  bool goRound(std::vector<SightPoint>& points, double turns, Vec2 to) const {
    Vec2 turn{360, 0}, none{0, 0};
    lonLat_.toCrs({&turn, 1});
    const Vec2 zero = model_.toPlan(none), one = model_.toPlan(turn);
    if (std::abs(turns) != 1 || zero.y != one.y) return false;  // not along the rows: a rotated raster
    const double shift = turns * (one.x - zero.x), out = shift > 0 ? -1 : 1;
    const double seam = middle_ + out * std::abs(shift) / 2;
    if (out * (seam - points.front().plan.x) < 0) return false;
    std::size_t after = 1;
    while (after < points.size() && out * (points[after].plan.x - seam) < 0) ++after;
    if (after == points.size()) return false;
    const SightPoint p = points[after - 1], q = points[after];
    const double t = (seam - p.plan.x) / (q.plan.x - p.plan.x);
    const double y = p.plan.y + t * (q.plan.y - p.plan.y), s = p.distance + t * (q.distance - p.distance);
    const double far = lowest_ - 1000;
    for (std::size_t i = after; i < points.size(); ++i) points[i].plan.x += shift;
    points.back().plan = to;
    points.insert(points.begin() + static_cast<std::ptrdiff_t>(after), {{{seam, y}, s},
                                                                        {{seam + out, y}, s},
                                                                        {{seam + out, far}, s},
                                                                        {{seam + shift - out, far}, s},
                                                                        {{seam + shift - out, y}, s},
                                                                        {{seam + shift, y}, s}});
    return true;
  }

  const TerrainModel& model_;
  CrsLonLat lonLat_;
  double a_, f_;
  Geodesic geodesic_;
  double bend_, tolerance_ = 0, middle_ = 0, lowest_ = 0;
};

}  // namespace

Result<std::unique_ptr<SightEarth>> makeEllipsoidEarth(const TerrainModel& model, double refraction) {
  auto lonLat = CrsLonLat::of(model.georeference);
  if (!lonLat) return tl::unexpected(lonLat.error());
  const Georeference& g = model.georeference;
  const bool isEllipsoid = std::isfinite(g.semiMajorAxisMetres) && g.semiMajorAxisMetres > 0 &&
                           (g.inverseFlattening == 0 || g.inverseFlattening > 1);
  if (!isEllipsoid || !std::isfinite(refraction))
    return failure(ErrorCode::invalidData, "an ellipsoid or a refraction that makes no sense");
  return std::make_unique<EllipsoidEarth>(model, std::move(*lonLat), refraction);
}

}  // namespace arete

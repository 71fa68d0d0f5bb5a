// SPDX-License-Identifier: GPL-3.0-or-later
//
// The geodesic is halved until its segments are straight in plan within the tolerance. Level k has 2^k + 1
// points. The points that level k + 1 adds are the middles that level k is tested with, so only those of the
// last level are not used again. A curve that is symmetric about its middle, such as a geodesic across the
// equator, deviates to both sides of its chord and not in the middle. So each segment is tested at its
// quarters too, which are the middles of the next level: a deviation that is a polynomial of third degree is
// nowhere larger than 1.1 times that at the three points. Longitudes are continuous (LONG_UNROLL), so a
// geographic CRS needs care only at the end: if the target is stated a whole turn away from the end of the
// geodesic.
#include "io/geo/crs/ellipsoid_earth.h"

#include <fmt/format.h>

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/GeodesicLine.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "io/geo/crs/lonlat.h"
#include "terrain/model/plan_box.h"
#include "terrain/sight/line.h"

namespace arete {
namespace {

using GeographicLib::Geodesic;
using GeographicLib::GeodesicLine;

/// Tolerance of straightness, in steps of the samples, per axis.
constexpr double kPlanError = 1e-3;
/// A line that is not straight after this many halvings passes a pole or a seam: it is not a line in plan.
constexpr int kMostHalvings = 14;
/// Longer segments, in metres, are tested at their eighths too.
constexpr double kLongLeg = 1e6;
/// The longest line, in radians of the effective Earth; the formula ends at half a turn.
constexpr double kLongestAngle = 3;
/// Latitudes beyond a pole by less are due to rounding.
constexpr double kPoleDegrees = 1e-9;

/// Extent and scale of the plan of a model.
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

/// Lines are geodesics of the ellipsoid of the CRS, and distances are their lengths.
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
    if (model.isRaster && model.georeference.repeatsFirstColumn) lastColumn_ = model.columns - 1.0;
  }

  std::optional<double> distance(Vec2 from, Vec2 to) const override {
    const Vec2 stated[2] = {model_.toSource(sightEnd(model_, from)), model_.toSource(sightEnd(model_, to))};
    const auto ends = lonLatOf(stated);
    if (!ends) return std::nullopt;
    double length = 0;
    geodesic_.Inverse((*ends)[0].y, (*ends)[0].x, (*ends)[1].y, (*ends)[1].x, length);
    return length;
  }

  // An end at a pole has any longitude; it takes the one of the other end, so that the line arrives straight.
  Result<SightTrack> track(Vec2 from, Vec2 to) const override {
    from = sightEnd(model_, from);
    to = sightEnd(model_, to);
    const Vec2 stated[2] = {model_.toSource(from), model_.toSource(to)};
    meetAtPole(stated, from, to);
    const Vec2 met[2] = {model_.toSource(from), model_.toSource(to)};
    ARETE_TRY(const auto places, lonLatOf(met));
    const auto& ends = places;
    double length = 0, azimuth = 0, arrival = 0;
    geodesic_.Inverse(ends[0].y, ends[0].x, ends[1].y, ends[1].x, length, azimuth, arrival);
    SightTrack track;
    track.azimuthDegrees = azimuth < 0 ? azimuth + 360 : azimuth;
    if (!(length > 0)) {
      track.azimuthDegrees = 0;
      track.points = {{from, 0}, {from, 0}};
      return track;
    }
    // The curvature of the ellipsoid along the line, lessened by refraction, is what a line of sight sees;
    // too long a line would leave the approximation.
    const GeodesicLine line =
        geodesic_.Line(ends[0].y, ends[0].x, azimuth,
                       Geodesic::LATITUDE | Geodesic::LONGITUDE | Geodesic::AZIMUTH | Geodesic::DISTANCE_IN);
    track.groundCurvature = curvatureAtMiddle(line, length);
    track.curvature = bend_ * track.groundCurvature;
    if (!(std::abs(track.curvature) * length < kLongestAngle))
      return failure(ErrorCode::invalidData,
                     fmt::format("a line of {:.0f} km is too long for the effective radius of {:.0f} km",
                                 length / 1000, 1 / std::abs(track.curvature) / 1000),
                     lineText(stated));
    // The number of turns by which the stated target lies east of the end of the geodesic. For a projected
    // CRS toCrs() gives the position on the map itself.
    const double turns = lonLat_.isPlain() ? std::round((ends[1].x - lonLatOn(line, length).x) / 360) : 0;
    const auto plan = straightened(line, length, from, turns == 0 ? std::optional(to) : std::nullopt);
    if (!plan)
      return failure(
          ErrorCode::invalidData,
          "is not a line on the map: the geodesic passes a pole or a seam of the CRS, or leaves its domain",
          lineText(stated));
    const std::size_t pieces = plan->size() - 1;
    track.points.reserve(pieces + 1);
    for (std::size_t i = 0; i <= pieces; ++i)
      track.points.push_back({(*plan)[i], length * static_cast<double>(i) / static_cast<double>(pieces)});
    if (turns != 0 && !crossSeam(track.points, turns, to))
      return failure(ErrorCode::invalidData,
                     "is not a line on the map: the geodesic leaves it at the seam of longitudes",
                     lineText(stated));
    return track;
  }

  /// The quarters of each segment are within the tolerance; the rest of the arc deviates hardly more.
  std::optional<double> geodesicError() const override { return 1.1 * tolerance_; }

 private:
  /// Longitude and latitude of two positions in source coordinates. Errors: invalidData: one has none.
  Result<std::array<Vec2, 2>> lonLatOf(const Vec2 (&stated)[2]) const {
    std::array<Vec2, 2> ends{stated[0], stated[1]};
    lonLat_.toLonLat(ends);
    for (int i = 0; i < 2; ++i) {
      if (std::abs(ends[i].y) <= 90 + kPoleDegrees) ends[i].y = std::clamp(ends[i].y, -90.0, 90.0);
      if (!std::isfinite(ends[i].x) || !(std::abs(ends[i].y) <= 90))
        return failure(ErrorCode::invalidData, "the CRS of the DEM defines no longitude and latitude there",
                       positionText(stated[i]));
    }
    return ends;
  }

  /// A pole has any longitude: an end there takes that of the other one, from which the geodesic comes along
  /// a meridian.
  void meetAtPole(const Vec2 (&stated)[2], Vec2& from, Vec2& to) const {
    const double pole = std::numbers::pi / 2 / model_.georeference.angularUnitRadians,
                 rounding = 1e-12 * pole;
    if (!lonLat_.isPlain()) return;
    if (std::abs(std::abs(stated[1].y) - pole) <= rounding)
      to = model_.toPlan({stated[0].x, stated[1].y});
    else if (std::abs(std::abs(stated[0].y) - pole) <= rounding)
      from = model_.toPlan({stated[1].x, stated[0].y});
  }

  static std::string positionText(Vec2 p) { return fmt::format("{},{}", p.x, p.y); }
  static std::string lineText(const Vec2 (&ends)[2]) {
    return fmt::format("{} to {}", positionText(ends[0]), positionText(ends[1]));
  }

  /// 1 / R by Euler's theorem, at the middle of the line.
  double curvatureAtMiddle(const GeodesicLine& line, double length) const {
    double latitude = 0, longitude = 0, azimuth = 0;
    line.Position(length / 2, latitude, longitude, azimuth);
    constexpr double kRadians = std::numbers::pi / 180;
    const double e2 = f_ * (2 - f_), s = std::sin(latitude * kRadians), w2 = 1 - e2 * s * s;
    const double alongMeridian = w2 * std::sqrt(w2) / (a_ * (1 - e2)), across = std::sqrt(w2) / a_;
    const double north = std::cos(azimuth * kRadians), east = std::sin(azimuth * kRadians);
    return north * north * alongMeridian + east * east * across;
  }

  /// Points that divide the geodesic into equal segments, each straight within the tolerance. Nothing if a
  /// point is undefined or the segments never become straight.
  std::optional<std::vector<Vec2>> straightened(const GeodesicLine& line, double length, Vec2 from,
                                                std::optional<Vec2> to) const {
    std::vector<Vec2> plan = {from, to ? *to : positionOn(line, length)};
    std::vector<Vec2> middles = middlesOf(line, length, 1), quarters;
    for (int halvings = 0; halvings <= kMostHalvings; ++halvings) {
      const std::size_t pieces = plan.size() - 1;
      quarters = middlesOf(line, length, 2 * pieces);
      double bend = std::max(bendOf(plan, middles), bendOf(plan, quarters));
      if (bend <= tolerance_ && length > kLongLeg * static_cast<double>(pieces))
        bend = bendOf(plan, middlesOf(line, length, 4 * pieces));
      if (bend <= tolerance_) return plan;
      // A halving takes three quarters of a bend away; near a pole or a seam, less.
      if (!(bend < tolerance_ * std::pow(4.0, kMostHalvings + 1 - halvings))) return std::nullopt;
      std::vector<Vec2> finer;
      finer.reserve(2 * pieces + 1);
      for (std::size_t i = 0; i < pieces; ++i) {
        finer.push_back(plan[i]);
        finer.push_back(middles[i]);
      }
      finer.push_back(plan.back());
      plan = std::move(finer);
      middles = std::move(quarters);
    }
    return std::nullopt;
  }

  /// How far points of the geodesic, the middles of equal parts of each segment, are from the chords, along x
  /// or y; infinite if one is undefined.
  double bendOf(const std::vector<Vec2>& plan, const std::vector<Vec2>& points) const {
    const std::size_t pieces = plan.size() - 1, each = points.size() / pieces;
    double bend = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2 a = plan[i / each], b = plan[i / each + 1];
      const double t = (static_cast<double>(i % each) + 0.5) / static_cast<double>(each);
      const double dx = std::abs((1 - t) * a.x + t * b.x - points[i].x),
                   dy = std::abs((1 - t) * a.y + t * b.y - points[i].y);
      if (!std::isfinite(dx + dy)) return std::numeric_limits<double>::infinity();
      bend = std::max({bend, dx, dy});
    }
    return bend;
  }

  /// The plan positions of the middles of so many equal segments of the geodesic.
  std::vector<Vec2> middlesOf(const GeodesicLine& line, double length, std::size_t pieces) const {
    std::vector<Vec2> middles(pieces);
    const double step = length / static_cast<double>(pieces);
    for (std::size_t i = 0; i < pieces; ++i) middles[i] = lonLatOn(line, (double(i) + 0.5) * step);
    toPlan(middles);
    return middles;
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
  Vec2 positionOn(const GeodesicLine& line, double distance) const {
    Vec2 p = lonLatOn(line, distance);
    toPlan({&p, 1});
    return p;
  }

  /// Continues a track that leaves the map on one side where it enters on the other: the part behind the seam
  /// is shifted by a turn, and the connection between, of length 0, runs outside the map. An end may lie on
  /// the seam. Where the first column is repeated, the borders of the raster are the seam, though rounded
  /// steps may put them a little off a whole turn. False if the track crosses no such seam. Precondition: a
  /// geographic CRS.
  bool crossSeam(std::vector<SightPoint>& points, double turns, Vec2 to) const {
    Vec2 turn{360, 0}, none{0, 0};
    lonLat_.toCrs({&turn, 1});
    const Vec2 zero = model_.toPlan(none), one = model_.toPlan(turn);
    if (std::abs(turns) != 1 || zero.y != one.y) return false;  // not along the rows: a rotated raster
    const double shift = turns * (one.x - zero.x), out = shift > 0 ? -1 : 1;
    const double seam = middle_ + out * std::abs(shift) / 2;
    const double here = lastColumn_ ? (out > 0 ? *lastColumn_ : 0) : seam,
                 there = lastColumn_ ? (out > 0 ? 0 : *lastColumn_) : seam + shift;
    const double rounding = kShortestInPlan + std::abs(seam - here);
    if (out * (points.front().plan.x - seam) > rounding) return false;
    std::size_t after = 1;
    while (after < points.size() && out * (points[after].plan.x - seam) < -rounding) ++after;
    if (after == points.size()) return false;
    const SightPoint p = points[after - 1], q = points[after];
    const double across = q.plan.x - p.plan.x;
    const double t = across == 0 ? 0 : std::clamp((seam - p.plan.x) / across, 0.0, 1.0);
    const double y = p.plan.y + t * (q.plan.y - p.plan.y), s = p.distance + t * (q.distance - p.distance);
    const double far = lowest_ - 1000;
    for (std::size_t i = 0; i < after; ++i)
      if (out * (points[i].plan.x - here) > 0) points[i].plan.x = here;
    for (std::size_t i = after; i < points.size(); ++i) {
      points[i].plan.x += shift;
      if (out * (points[i].plan.x - there) < 0) points[i].plan.x = there;
    }
    points.back().plan = to;
    std::vector<SightPoint> connection = {{{here, y}, s},         {{here + out, y}, s},
                                          {{here + out, far}, s}, {{there - out, far}, s},
                                          {{there - out, y}, s},  {{there, y}, s}};
    // An end on the seam is there already.
    if (t == 0 && points[after - 1].plan == connection.front().plan) connection.erase(connection.begin());
    if (t == 1 && points[after].plan == connection.back().plan) connection.pop_back();
    points.insert(points.begin() + static_cast<std::ptrdiff_t>(after), connection.begin(), connection.end());
    return true;
  }

  const TerrainModel& model_;
  CrsLonLat lonLat_;
  double a_, f_;
  Geodesic geodesic_;
  double bend_, tolerance_ = 0, middle_ = 0, lowest_ = 0;
  std::optional<double> lastColumn_;  ///< of a raster that goes round the Earth
};

}  // namespace

bool isOnEllipsoid(const Georeference& georeference) {
  return !georeference.crsWkt.empty() && CrsLonLat::of(georeference).has_value();
}

Result<std::unique_ptr<SightEarth>> makeEllipsoidEarth(const TerrainModel& model, double refraction) try {
  ARETE_TRY(auto lonLat, CrsLonLat::of(model.georeference));
  const Georeference& g = model.georeference;
  const bool isEllipsoid = std::isfinite(g.semiMajorAxisMetres) && g.semiMajorAxisMetres > 0 &&
                           (g.inverseFlattening == 0 || g.inverseFlattening > 1);
  if (!isEllipsoid || !std::isfinite(refraction))
    return failure(ErrorCode::invalidData, "the ellipsoid or the refraction is invalid");
  return std::make_unique<EllipsoidEarth>(model, std::move(lonLat), refraction);
} catch (...) {
  return caughtFailure();
}

}  // namespace arete

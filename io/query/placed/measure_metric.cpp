// SPDX-License-Identifier: GPL-3.0-or-later
//
// The vertices are brought from the frame into geocentric coordinates, by the rotation that latitude and
// longitude of the origin give. A sample is a line: from its foot on the ellipsoid along the normal. Three
// triple products say on which sides of a triangle's edges the line passes, and their sum weighs the height
// at which it meets the triangle's plane: no other approximation is made.
//
// Which samples may meet a triangle follows from the longitudes and latitudes of its corners: its image lies
// between them, but for what its edges rise towards the pole above the parallels.
#include <GeographicLib/Geocentric.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "io/query/placed/measure_placed.h"
#include "io/query/placed/samples.h"

namespace arete::placed {
namespace {

constexpr double kGapMetres = 3e-8;     // between neighbours, by rounding
constexpr double kInsideMetres = 1e-6;  // a sample so far within two triangles is covered twice
constexpr double kTurn = 360;

/// The ellipsoid of a CRS in degrees, as geocentric positions about an origin.
class Ellipsoid {
 public:
  explicit Ellipsoid(const Georeference& dem)
      : degrees_(dem.angularUnitRadians * 180 / std::numbers::pi),
        a_(dem.semiMajorAxisMetres),
        f_(dem.inverseFlattening == 0 ? 0 : 1 / dem.inverseFlattening),
        geocentric_(a_, f_) {}

  double degreesPerUnit() const { return degrees_; }
  /// The normal at a place, and the point of the ellipsoid there.
  void lineAt(Vec2 place, Vec3& foot, Vec3& normal) const {
    const double radians = degrees_ * std::numbers::pi / 180;
    const double sinLat = std::sin(place.y * radians), cosLat = std::cos(place.y * radians);
    const double turned = std::remainder(place.x * degrees_, kTurn) * std::numbers::pi / 180;
    const double sinLon = std::sin(turned), cosLon = std::cos(turned);
    const double e2 = f_ * (2 - f_);
    const double n = a_ / std::sqrt(1 - e2 * sinLat * sinLat);
    normal = {cosLat * cosLon, cosLat * sinLon, sinLat};
    foot = {n * normal.x, n * normal.y, n * (1 - e2) * sinLat};
  }
  /// Longitude and latitude in degrees.
  Vec2 placeOf(const Vec3& p) const {
    double latitude = 0, longitude = 0, height = 0;
    geocentric_.Reverse(p.x, p.y, p.z, latitude, longitude, height);
    return {longitude, latitude};
  }
  double radius() const { return a_ * (1 - std::abs(f_)) * 0.99; }

 private:
  double degrees_, a_, f_;
  GeographicLib::Geocentric geocentric_;
};

/// Samples in square buckets of longitude and latitude.
class Buckets {
 public:
  Buckets(const std::vector<PlacedSample>& samples, double degreesPerUnit) {
    if (samples.empty()) return;
    Vec2 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    low_ = {-high.x, -high.y};
    for (const PlacedSample& s : samples) {
      low_ = {std::min(low_.x, s.source.x * degreesPerUnit), std::min(low_.y, s.source.y * degreesPerUnit)};
      high = {std::max(high.x, s.source.x * degreesPerUnit), std::max(high.y, s.source.y * degreesPerUnit)};
    }
    const double w = high.x - low_.x, h = high.y - low_.y, n = double(samples.size());
    side_ = std::max(1.5 * std::sqrt(w * h / n), std::max(w, h) / n);
    if (!(side_ > 0)) side_ = 1;
    columns_ = std::int64_t(w / side_) + 1;
    rows_ = std::int64_t(h / side_) + 1;
    begin_.assign(std::size_t(columns_ * rows_) + 1, 0);
    const auto bucketOf = [&](const PlacedSample& s) {
      const auto c = std::min(std::int64_t((s.source.x * degreesPerUnit - low_.x) / side_), columns_ - 1);
      const auto r = std::min(std::int64_t((s.source.y * degreesPerUnit - low_.y) / side_), rows_ - 1);
      return std::size_t(r * columns_ + c);
    };
    for (const PlacedSample& s : samples) ++begin_[bucketOf(s) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<std::uint64_t> next(begin_.begin(), begin_.end() - 1);
    order_.resize(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) order_[next[bucketOf(samples[i])]++] = i;
  }

  template <class Visit>
  void visit(double west, double south, double east, double north, const Visit& each) const {
    if (order_.empty()) return;
    const auto column = [&](double x) { return std::clamp((x - low_.x) / side_, -1.0, double(columns_)); };
    const auto row = [&](double y) { return std::clamp((y - low_.y) / side_, -1.0, double(rows_)); };
    const auto c0 = std::max<std::int64_t>(std::int64_t(std::floor(column(west))), 0),
               c1 = std::min<std::int64_t>(std::int64_t(std::floor(column(east))), columns_ - 1),
               r0 = std::max<std::int64_t>(std::int64_t(std::floor(row(south))), 0),
               r1 = std::min<std::int64_t>(std::int64_t(std::floor(row(north))), rows_ - 1);
    for (std::int64_t r = r0; r <= r1; ++r)
      if (c0 <= c1)
        for (std::uint64_t i = begin_[std::size_t(r * columns_ + c0)];
             i < begin_[std::size_t(r * columns_ + c1) + 1]; ++i)
          each(order_[i]);
  }

 private:
  Vec2 low_;
  double side_ = 1;
  std::int64_t columns_ = 0, rows_ = 0;
  std::vector<std::uint64_t> begin_, order_;
};

}  // namespace

Result<double> findInMetres(const TriangleMesh& mesh, const Vec3& about, const Georeference& dem, Vec2 pixel,
                            std::vector<PlacedSample>& samples, const RunContext& context) {
  if (!dem.isGeographic)
    return failure(ErrorCode::unsupported, "has no longitude and latitude as coordinates", dem.crsWkt);
  const Ellipsoid ellipsoid(dem);
  const double unit = dem.verticalUnitMetres;
  Vec3 foot, up;
  ellipsoid.lineAt({about.x, about.y}, foot, up);
  const Vec3 origin = foot + (about.z * unit) * up;
  const double lon = std::remainder(about.x * ellipsoid.degreesPerUnit(), kTurn) * std::numbers::pi / 180;
  const Vec3 east{-std::sin(lon), std::cos(lon), 0}, north = cross(up, east);
  std::vector<Vec3> geocentric;
  std::vector<Vec2> places;  // degrees
  geocentric.reserve(mesh.positions.size());
  for (const Vec3& p : mesh.positions) {
    geocentric.push_back(origin + p.x * east + p.y * north + p.z * up);
    places.push_back(ellipsoid.placeOf(geocentric.back()));
  }
  const Buckets buckets(samples, ellipsoid.degreesPerUnit());
  double area = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (t % 8192 == 0 && context.cancelled()) return failure(ErrorCode::interrupted, "was interrupted");
    const auto& v = mesh.triangles[t];
    const std::array<Vec3, 3> corner = {geocentric[v[0]], geocentric[v[1]], geocentric[v[2]]};
    double reach = 0, south = 90, north_ = -90, west = 0, east_ = 0;
    const double first = places[v[0]].x;
    for (int k = 0; k < 3; ++k) {
      reach = std::max(reach, norm(corner[(k + 1) % 3] - corner[k]));
      const Vec2& place = places[v[k]];
      south = std::min(south, place.y);
      north_ = std::max(north_, place.y);
      const double turned = std::remainder(place.x - first, kTurn);
      west = std::min(west, turned);
      east_ = std::max(east_, turned);
    }
    const double angle = reach / ellipsoid.radius();
    const double farthest = std::max(std::abs(south), std::abs(north_)) * std::numbers::pi / 180;
    const double rise =
        angle * angle / 8 * std::min(std::tan(farthest), 1 / angle) * 1.5 * 180 / std::numbers::pi;
    const double tiny = 1e-9;
    const bool isAtPole =
        farthest + 2 * angle > std::numbers::pi / 2 && (east_ - west > 90 || farthest > 1.5707);
    const double aside = tiny + 0.01 * (east_ - west) + rise;
    const Vec3 normal = cross(corner[1] - corner[0], corner[2] - corner[0]);
    area += std::abs(dot(normal, arete::unit(corner[0]))) / 2;
    const auto meet = [&](std::uint64_t i) {
      PlacedSample& s = samples[i];
      Vec3 from, n;
      ellipsoid.lineAt(s.source, from, n);
      const double along = dot(normal, n);
      if (std::abs(along) <= 1e-9 * norm(normal)) return;
      if (dot(n, corner[0]) <= 0) return;  // the other side of the Earth
      double least = std::numeric_limits<double>::infinity();
      const double sign = along > 0 ? 1 : -1;
      for (int k = 0; k < 3; ++k) {
        const Vec3 p = corner[k] - from, q = corner[(k + 1) % 3] - from;
        const double width = norm(cross(n, q - p));
        if (!(width > 0)) return;
        least = std::min(least, sign * dot(n, cross(p, q)) / width);
      }
      if (least < -kGapMetres) return;
      const double height = dot(normal, corner[0] - from) / along / unit;
      // NODATA is never on the rim, which joins samples.
      if (least > (std::isnan(s.height) ? 0 : kInsideMetres) && s.holders < 2) ++s.holders;
      if (std::isnan(s.height)) return;
      if (std::isnan(s.tin) || std::abs(height - s.height) > std::abs(s.tin - s.height)) {
        s.tin = height;
        s.triangle = t;
      }
    };
    if (isAtPole) {
      buckets.visit(-1e9, south - rise - tiny, 1e9, north_ + rise + tiny, meet);
      continue;
    }
    // A DEM may reach beyond half a turn, and its columns have one of these longitudes.
    for (const int turns : {-2, -1, 0, 1, 2})
      buckets.visit(first + west - aside + turns * kTurn, south - rise - tiny,
                    first + east_ + aside + turns * kTurn, north_ + rise + tiny, meet);
  }
  std::vector<Vec2> planOfSamples;
  planOfSamples.reserve(samples.size());
  const double middle = about.x * ellipsoid.degreesPerUnit();
  for (const PlacedSample& s : samples)
    planOfSamples.push_back({middle + std::remainder(s.source.x * ellipsoid.degreesPerUnit() - middle, kTurn),
                             s.source.y * ellipsoid.degreesPerUnit()});
  for (Vec2& place : places) place.x = middle + std::remainder(place.x - middle, kTurn);
  coverBesideRim(
      samples, planOfSamples, rimOf(mesh), places,
      {2 * pixel.x * ellipsoid.degreesPerUnit(), 2 * pixel.y * ellipsoid.degreesPerUnit()}, kTurn,
      kBeyondRimPixels * std::sqrt(area / double(std::max<std::size_t>(samples.size(), 1))),
      [&](std::size_t i, const RimSide& side) {
        Vec3 from, n;
        ellipsoid.lineAt(samples[i].source, from, n);
        const Vec3 aside = arete::unit(cross(std::abs(n.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0}, n));
        const Vec3 ahead = cross(n, aside);
        const auto seen = [&](std::uint32_t vertex) {
          const Vec3 d = geocentric[vertex] - from;
          return Vec3{dot(d, aside), dot(d, ahead), dot(d, n) / unit};
        };
        return std::pair(seen(side.from), seen(side.to));
      });
  return area;
}

}  // namespace arete::placed

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The curved Earth by GeographicLib's geocentric coordinates and projections, for tests: maps with heights of
// a formula, the space that they are drawn in, and what a camera sees. The viewer goes by PROJ.
#pragma once

#include <gtest/gtest.h>

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "datasets/random.h"
#include "terrain/builder/build.h"
#include "terrain/model/camera.h"
#include "viewer/camera_models.h"

namespace arete::test {

constexpr double kRadians = std::numbers::pi / 180;

inline const GeographicLib::Geocentric& wgs84() {
  return GeographicLib::Geocentric::WGS84();
}

/// Earth-centred, of longitude and latitude in degrees.
inline Vec3 centred(double lon, double lat, double height) {
  Vec3 p;
  wgs84().Forward(lat, lon, height, p.x, p.y, p.z);
  return p;
}

/// East, north and up of a place in Earth-centred coordinates.
struct Directions {
  Vec3 at, east, north, up;
  Directions(double lon, double lat, double height) : at(centred(lon, lat, height)) {
    const double l = lon * kRadians, b = lat * kRadians;
    east = {-std::sin(l), std::cos(l), 0};
    north = {-std::sin(b) * std::cos(l), -std::sin(b) * std::sin(l), std::cos(b)};
    up = {std::cos(b) * std::cos(l), std::cos(b) * std::sin(l), std::sin(b)};
  }
  Vec3 local(const Vec3& p) const {
    const Vec3 d = p - at;
    return {dot(d, east), dot(d, north), dot(d, up)};
  }
  Vec3 centredOf(const Vec3& p) const {
    return {at.x + p.x * east.x + p.y * north.x + p.z * up.x,
            at.y + p.x * east.y + p.y * north.y + p.z * up.y,
            at.z + p.x * east.z + p.y * north.z + p.z * up.z};
  }
};

using Height = std::function<double(double lon, double lat)>;

/// A map, and its model with heights of a formula.
struct Map {
  const char* name;
  int zone = 0;  // UTM, north; 0 = longitude and latitude
  TerrainModel model;

  Vec2 lonLat(Vec2 xy) const {
    if (zone == 0) return xy;
    Vec2 p;
    double convergence = 0, scale = 0;
    GeographicLib::UTMUPS::Reverse(zone, true, xy.x, xy.y, p.y, p.x, convergence, scale, true);
    return p;
  }
  Vec2 xy(Vec2 lonLat) const {
    if (zone == 0) return lonLat;
    Vec2 p;
    int z = 0;
    bool isNorth = true;
    double convergence = 0, scale = 0;
    GeographicLib::UTMUPS::Forward(lonLat.y, lonLat.x, z, isNorth, p.x, p.y, convergence, scale, zone, true);
    return p;
  }
  /// Degrees from the map's north to true north, clockwise.
  double trueAzimuth(Vec2 xy, double azimuth) const {
    if (zone == 0) return azimuth;
    double lat = 0, lon = 0, convergence = 0, scale = 0;
    GeographicLib::UTMUPS::Reverse(zone, true, xy.x, xy.y, lat, lon, convergence, scale, true);
    return azimuth + convergence;
  }
  Vec3 centred(Vec2 xy, double height) const {
    const Vec2 p = lonLat(xy);
    return test::centred(p.x, p.y, height);
  }
};

/// `corner`: the upper left one's centre; steps to the right and down.
inline Map mapOf(const char* name, int zone, Vec2 corner, double step, std::uint32_t columns,
                 std::uint32_t rows, const Height& height, bool isSouthUp = false) {
  Map map{name, zone, {}};
  RasterHeightfield field;
  field.columns = columns;
  field.rows = rows;
  field.heights.resize(std::size_t(columns) * rows);
  Georeference& g = field.georeference;
  const double down = isSouthUp ? step : -step;
  g.geoTransform = {corner.x - step / 2, step, 0, corner.y - down / 2, 0, down};
  g.hasGeoTransform = true;
  g.isGeographic = zone == 0;
  g.crsWkt = zone == 0 ? "EPSG:4326" : "EPSG:326" + std::to_string(zone);
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t col = 0; col < columns; ++col) {
      const Vec2 p = map.lonLat(g.toSource(col, row));
      field.heights[std::size_t(row) * columns + col] = float(height(p.x, p.y));
    }
  Result<TerrainModel> model = build(field);
  EXPECT_TRUE(model);
  map.model = std::move(*model);
  return map;
}

inline double hills(double lon, double lat) {
  return 900 + 700 * std::sin(7 * lon) * std::cos(9 * lat) +
         300 * std::sin(61 * lon + 2 * lat) * std::sin(47 * lat);
}

inline const std::vector<Map>& maps() {
  static const std::vector<Map> all = [] {
    std::vector<Map> made;
    made.push_back(mapOf("geographic", 0, {8, 61}, 0.02, 121, 97, hills));
    made.push_back(mapOf("geographic, south up", 0, {8, 44}, 0.02, 81, 97, hills, true));
    made.push_back(mapOf("UTM", 33, {150000, 5300000}, 1500, 131, 97, hills));
    made.push_back(mapOf("far north", 0, {-20, 82}, 0.1, 301, 61, hills));
    return made;
  }();
  return all;
}

/// The space of a CurvedGround of a map with its north up, or down: its x axis is the rows' direction.
struct Space {
  Directions middle;
  Vec2 x;  // in east and north
  double side = 1;
  explicit Space(const Map& map) : middle(at(map)) {
    const MetricFrame& metric = map.model.mt.arrays().metric;
    const auto place = [&](double dx) {
      return middle.local(
          map.centred(map.model.toSource({metric.origin.x + dx, metric.origin.y}), metric.origin.z));
    };
    const Vec3 a = place(-0.01), b = place(0.01);
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    x = {(b.x - a.x) / length, (b.y - a.y) / length};
    side = map.model.isFlipped() ? -1 : 1;
  }
  static Directions at(const Map& map) {
    const MetricFrame& metric = map.model.mt.arrays().metric;
    const Vec2 p = map.lonLat(map.model.toSource({metric.origin.x, metric.origin.y}));
    return {p.x, p.y, metric.origin.z};
  }
  Vec3 in(const Vec3& centred) const {
    const Vec3 p = middle.local(centred);
    return {p.x * x.x + p.y * x.y, side * (-p.x * x.y + p.y * x.x), p.z};
  }
  Vec3 out(const Vec3& p) const {
    return middle.centredOf({p.x * x.x - side * p.y * x.y, p.x * x.y + side * p.y * x.x, p.z});
  }
};

/// What a camera sees, from directions of its own place.
struct TrueCamera {
  Directions here;
  Vec3 right, up, forward;
  double focal, width, height;
  TrueCamera(const Map& map, const Camera& c) : here(map.lonLat(c.xy).x, map.lonLat(c.xy).y, c.height) {
    const double a = map.trueAzimuth(c.xy, c.azimuthDegrees) * kRadians, p = c.pitchDegrees * kRadians;
    forward = {std::sin(a) * std::cos(p), std::cos(a) * std::cos(p), std::sin(p)};
    right = {std::cos(a), -std::sin(a), 0};
    up = {-std::sin(a) * std::sin(p), -std::cos(a) * std::sin(p), std::cos(p)};
    width = c.widthPixels;
    height = c.heightPixels;
    focal = height / 2 / std::tan(c.verticalFieldOfViewDegrees * kRadians / 2);
  }
  Vec3 project(const Vec3& centred) const {
    const Vec3 p = here.local(centred);
    const double depth = dot(p, forward);
    return {width / 2 + focal * dot(p, right) / depth, height / 2 - focal * dot(p, up) / depth, depth};
  }
  bool sees(const Vec3& s) const { return s.z > 0 && s.x >= 0 && s.x <= width && s.y >= 0 && s.y <= height; }
  /// What is at a depth in the middle of a pixel, Earth-centred.
  Vec3 at(int x, int y, double depth) const {
    const double r = (x + 0.5 - width / 2) / focal, u = (height / 2 - y - 0.5) / focal;
    return here.centredOf({depth * (forward.x + r * right.x + u * up.x),
                           depth * (forward.y + r * right.y + u * up.y),
                           depth * (forward.z + r * right.z + u * up.z)});
  }
  /// Depth of the ellipsoid itself in a pixel, or infinity.
  double depthOfEllipsoid(int x, int y) const {
    const Vec3 o = here.at, d = at(x, y, 1) - o;
    const double a = wgs84().EquatorialRadius(), b = a * (1 - wgs84().Flattening());
    const Vec3 p{o.x / a, o.y / a, o.z / b}, v{d.x / a, d.y / a, d.z / b};
    const double half = dot(p, v), square = dot(v, v), rest = half * half - square * (dot(p, p) - 1);
    return rest < 0 || half > 0 ? INFINITY : (-half - std::sqrt(rest)) / square;
  }
};

inline Camera anyCamera(Random& random, const TerrainModel& model, int width = 1280, int height = 720) {
  const Vec2 plan{random.between(0, 1) * model.columns, random.between(0, 1) * model.rows};
  return {.xy = model.toSource(plan),
          .height = 2000 + std::pow(10.0, random.between(1, 4.5)),
          .azimuthDegrees = random.between(0, 360),
          .pitchDegrees = random.between(-50, 5),
          .verticalFieldOfViewDegrees = random.between(20, 70),
          .widthPixels = double(width),
          .heightPixels = double(height)};
}

}  // namespace arete::test

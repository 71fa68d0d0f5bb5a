// SPDX-License-Identifier: GPL-3.0-or-later
//
// Random regions over DEMs everywhere on the Earth, sample by sample against PROJ and GeographicLib
// themselves: the sample is brought into the CRS of the region and tested against the polygon as it was
// drawn; distances are those to points close together on its edges. The files state the polygons whole,
// turned by 360 degrees, or cut at the antimeridian.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <proj.h>

#include <GeographicLib/Geocentric.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>

#include "datasets/random.h"
#include "io/georeference_fixture.h"
#include "io/io_fixture.h"
#include "io/query/extract/ground_buffer.h"
#include "io/query/extract/region_argument.h"
#include "terrain/model/plan_region.h"

namespace arete {
namespace {

using test::georeferenceOf;
using test::TemporaryFolder;
using EarthChain = std::vector<Vec2>;

class Proj {
 public:
  Proj(const std::string& from, const std::string& to) {
    context_ = proj_context_create();
    proj_log_level(context_, PJ_LOG_NONE);
    PJ* axes = proj_create_crs_to_crs(context_, from.c_str(), to.c_str(), nullptr);
    EXPECT_NE(axes, nullptr) << from << " to " << to;
    pj_ = proj_normalize_for_visualization(context_, axes);
    proj_destroy(axes);
  }
  ~Proj() {
    proj_destroy(pj_);
    proj_context_destroy(context_);
  }
  Proj(const Proj&) = delete;
  Proj& operator=(const Proj&) = delete;
  Vec2 operator()(Vec2 p) const {
    const PJ_COORD q = proj_trans(pj_, PJ_FWD, proj_coord(p.x, p.y, 0, 0));
    return {q.xy.x, q.xy.y};
  }

 private:
  PJ_CONTEXT* context_;
  PJ* pj_;
};

struct Place {
  const char* name;
  const char* crs;
  std::array<double, 6> geoTransform;
  std::uint32_t columns, rows;
  const char* regionCrs;  ///< in which the polygons are drawn
  double size;            ///< of a polygon, in its unit
};

const Place kPlaces[] = {
    {"global", "EPSG:4326", {-180, 2, 0, 90, 0, -2}, 180, 90, "EPSG:4326", 25},
    {"global, from a polar map", "EPSG:4326", {-180, 2, 0, 90, 0, -2}, 180, 90, "EPSG:3995", 3e6},
    {"0..360", "EPSG:4326", {0, 2, 0, 90, 0, -2}, 180, 90, "EPSG:4326", 25},
    {"0..360, points at the seam", "EPSG:4326", {-0.5, 1, 0, 60.5, 0, -1}, 361, 121, "EPSG:4326", 12},
    {"dateline, from the east", "EPSG:4326", {179, .02, 0, -16, 0, -.02}, 100, 50, "EPSG:4326", .7},
    {"dateline, from the west", "EPSG:4326", {-181, .02, 0, 62, 0, -.02}, 100, 50, "EPSG:4326", .7},
    {"dateline, from UTM", "EPSG:4326", {179, .02, 0, -16, 0, -.02}, 100, 50, "EPSG:32760", 60000},
    {"dateline in UTM", "EPSG:32701", {0, 2000, 0, 8200000, 0, -2000}, 100, 80, "EPSG:4326", .8},
    {"dateline in Mercator", "EPSG:3857", {19900000, 2000, 0, -1800000, 0, -2000}, 130, 80, "EPSG:4326", .8},
    {"Mercator far north", "EPSG:3857", {1100000, 500, 0, 11500000, 0, -500}, 90, 80, "EPSG:4326", .3},
    {"north pole", "EPSG:3413", {-1e6, 25000, 0, 1e6, 0, -25000}, 80, 80, "EPSG:4326", 12},
    {"south pole", "EPSG:3031", {-1e6, 25000, 0, 1e6, 0, -25000}, 80, 80, "EPSG:4326", 12},
    {"around the pole in degrees", "EPSG:4326", {-180, 2, 0, 90, 0, -.1}, 180, 60, "EPSG:3413", 2e5},
    {"LAEA", "EPSG:3035", {3e6, 20000, 0, 4e6, 0, -20000}, 80, 80, "EPSG:4326", 5},
};

double reduced(double degrees) {
  return degrees - 360 * std::round(degrees / 360);
}

/// The even-odd rule; of longitudes, which the ring has without a jump, modulo a turn.
bool isInside(const EarthChain& ring, Vec2 p, bool isLonLat) {
  if (isLonLat) p.x = ring[0].x + reduced(p.x - ring[0].x);
  bool inside = false;
  for (const double turn : {0.0, -360.0, 360.0}) {
    if (turn != 0 && !isLonLat) continue;
    const double x = p.x + turn;
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
      if ((ring[i].y > p.y) != (ring[j].y > p.y) &&
          x < (ring[j].x - ring[i].x) * (p.y - ring[i].y) / (ring[j].y - ring[i].y) + ring[i].x)
        inside = !inside;
  }
  return inside;
}

/// The part of a ring on one side of a meridian.
EarthChain clipped(const EarthChain& ring, double meridian, bool isWest) {
  EarthChain part;
  const auto isKept = [&](Vec2 p) { return isWest ? p.x <= meridian : p.x >= meridian; };
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
    const Vec2 a = ring[j], b = ring[i];
    if (isKept(a) != isKept(b))
      part.push_back({meridian, a.y + (b.y - a.y) * (meridian - a.x) / (b.x - a.x)});
    if (isKept(b)) part.push_back(b);
  }
  return part;
}

std::string coordinates(const EarthChain& chain, double shift, bool isRing) {
  std::string text = "(";
  for (std::size_t i = 0; i < chain.size() + (isRing ? 1 : 0); ++i) {
    const Vec2 p = chain[i % chain.size()];
    text += fmt::format("{}{:.17g} {:.17g}", i ? "," : "", p.x + shift, p.y);
  }
  return text + ")";
}

/// A table with one geometry, as it may be drawn.
std::string tableOf(const EarthChain& chain, bool isRing, bool isLonLat, std::uint32_t way) {
  std::string wkt;
  const auto [west, east] = std::ranges::minmax(chain, {}, &Vec2::x);
  const double seam = 180 + 360 * std::round(((west.x + east.x) / 2 - 180) / 360);
  if (chain.size() == 1)
    wkt = "POINT " + coordinates({{isLonLat ? reduced(chain[0].x) : chain[0].x, chain[0].y}}, 0, false);
  else if (!isRing)
    wkt = "LINESTRING " + coordinates(chain, isLonLat && way == 1 ? 360 : 0, false);
  else if (isLonLat && way == 1)
    wkt = "POLYGON (" + coordinates(chain, -360, true) + ")";
  else if (isLonLat && way == 2 && west.x < seam && east.x > seam)
    wkt = "MULTIPOLYGON ((" + coordinates(clipped(chain, seam, true), 180 - seam, true) + "),(" +
          coordinates(clipped(chain, seam, false), -180 - seam, true) + "))";
  else
    wkt = "POLYGON (" + coordinates(chain, 0, true) + ")";
  return "WKT,id\n\"" + wkt + "\",1\n";
}

/// Positions in space of points close together along a chain.
std::vector<Vec3> inSpace(const EarthChain& chain, bool isRing, const Proj& toLonLat,
                          const GeographicLib::Geocentric& earth, int perEdge) {
  std::vector<Vec3> points;
  const auto add = [&](Vec2 p) {
    const Vec2 at = toLonLat(p);
    Vec3 q;
    earth.Forward(at.y, at.x, 0, q.x, q.y, q.z);
    points.push_back(q);
  };
  if (chain.size() == 1) add(chain[0]);
  for (std::size_t i = 0; i + (isRing ? 0 : 1) < chain.size(); ++i)
    for (int k = 0; k <= perEdge; ++k)
      add(chain[i] + double(k) / perEdge * (chain[(i + 1) % chain.size()] - chain[i]));
  return points;
}

struct Tally {
  std::size_t inside = 0, outside = 0, near = 0;
};

/// Compares every sample; those within the stated deviation of the border may be either.
void compare(const Place& place, const EarthChain& chain, bool isRing, double distance, std::uint32_t way,
             Tally& tally) {
  const TemporaryFolder folder;
  RasterHeightfield field;
  field.columns = place.columns;
  field.rows = place.rows;
  field.heights.assign(std::size_t{place.columns} * place.rows, 0);
  field.georeference = georeferenceOf(place.crs, place.geoTransform);
  const bool isLonLat = std::string(place.regionCrs) == "EPSG:4326";
  const std::string table = tableOf(chain, isRing, isLonLat, way);
  SCOPED_TRACE(table);
  const auto read = readRegionArgument({folder.write("region.csv", table), distance, place.regionCrs},
                                       field.georeference, LongitudeTurns(field));
  ASSERT_TRUE(read) << read.error().describe();
  EXPECT_TRUE(read->warnings.empty()) << test::joined(read->warnings);
  const auto mask = samplesInside(planRegion(read->shape, field), field);

  const Proj toRegion(place.crs, place.regionCrs), toLonLat(place.crs, "OGC:CRS84"),
      fromRegion(place.regionCrs, "OGC:CRS84");
  const auto& earth = GeographicLib::Geocentric::WGS84();
  constexpr int kPerEdge = 250;
  const std::vector<Vec3> border = inSpace(chain, isRing, fromRegion, earth, kPerEdge);
  double step = 0;
  for (std::size_t i = 1; i < border.size(); ++i)
    if (i % (kPerEdge + 1) != 0) step = std::max(step, norm(border[i] - border[i - 1]));
  std::size_t wrong = 0;
  for (std::uint32_t row = 0; row < field.rows; ++row)
    for (std::uint32_t column = 0; column < field.columns; ++column) {
      const Vec2 xy = field.georeference.toSource(column, row), lonLat = toLonLat(xy);
      Vec3 at;
      earth.Forward(lonLat.y, lonLat.x, 0, at.x, at.y, at.z);
      double chord = std::numeric_limits<double>::infinity();
      for (const Vec3& p : border) chord = std::min(chord, dot(p - at, p - at));
      chord = std::sqrt(chord);
      const double metres = 2 * 6371000 * std::asin(std::min(1.0, chord / (2 * 6371000)));
      const bool isIn = isRing && isInside(chain, toRegion(xy), isLonLat);
      const bool isMarked = mask[field.index(column, row)] != 0;
      // Edges are reprojected within 1e-4 of their length; the oracle's points are a step apart.
      const double rounding =
          1e-4 * step * kPerEdge + (distance > 0 ? step / 2 : 0) + 1e-3 * std::min(metres, 1e5);
      const bool mustBe = isIn ? distance > 0 || metres > rounding : metres + rounding < distance;
      const bool mustNotBe = !isIn && metres - rounding > 1.04 * distance;
      if (mustBe) ++tally.inside;
      if (mustNotBe) ++tally.outside;
      if (!mustBe && !mustNotBe) ++tally.near;
      if ((mustBe && !isMarked) || (mustNotBe && isMarked)) {
        if (wrong++ < 3)
          ADD_FAILURE() << "sample " << column << ", " << row << " at " << lonLat.x << ", " << lonLat.y
                        << ", " << metres << " m from the border, " << (isIn ? "inside" : "outside")
                        << ", distance " << distance << (isMarked ? " is marked" : " is not marked");
      }
    }
  EXPECT_EQ(wrong, 0u);
}

TEST(RegionOnEarth, HoldsTheSamplesThatPROJAndGeographicLibSay) {
  constexpr std::uint64_t kSeed = 4101;
  Random random(kSeed);
  Tally tally;
  constexpr int kOfEach = 8;
  for (const Place& place : kPlaces)
    for (int i = 0; i < kOfEach; ++i) {
      const bool isLonLat = std::string(place.regionCrs) == "EPSG:4326";
      const Georeference georeference = georeferenceOf(place.crs, place.geoTransform);
      const Proj toRegion(place.crs, place.regionCrs);
      // Middles near the western or eastern border half of the time: there the turns are.
      double u = random.unit();
      if (i % 2 == 0) u = u < 0.5 ? u / 10 : 1 - u / 10;
      const double v = random.between(0.25, 0.75);
      Vec2 middle = toRegion(georeference.toSource(u * place.columns, v * place.rows));
      const double size = place.size * random.between(0.3, 1);
      const int kind = i % 4 == 3 ? (i == 3 ? 1 : 0) : 2;  // point, line or polygon
      EarthChain chain;
      const int corners = 4 + int(random.below(5));
      for (int k = 0; k < corners; ++k) {
        const double angle = 2 * std::numbers::pi * (k + 0.6 * random.unit()) / corners;
        const double radius = size * random.between(0.4, 1);
        Vec2 p{middle.x + radius * std::cos(angle), middle.y + radius * std::sin(angle)};
        if (isLonLat) p.y = std::clamp(p.y, -89.5, 89.5);
        chain.push_back(p);
      }
      if (kind == 0) chain.resize(1);
      const double metres = place.size * (isLonLat ? 111e3 : 1);
      const double distance = kind != 2 || i % 3 == 1 ? std::min(9e5, metres * random.between(0.05, 0.4)) : 0;
      SCOPED_TRACE(testing::Message() << place.name << ", region " << i << ", seed " << kSeed);
      compare(place, chain, kind == 2, distance, random.below(3), tally);
    }
  EXPECT_GT(tally.inside, 20000u);
  EXPECT_GT(tally.outside, 200000u);
  EXPECT_LT(tally.near, (tally.inside + tally.outside) / 100);
}

}  // namespace
}  // namespace arete

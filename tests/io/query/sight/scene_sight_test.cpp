// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lines of sight through meshes, against every triangle of every object, cut with fine chords of the line in
// extended precision.
#include "io/query/sight/scene_sight.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "datasets/crs_wkt.h"
#include "io/geo/crs/ellipsoid_earth.h"
#include "io/geo/crs/transform.h"
#include "io/geo/dem/raster_writer.h"
#include "io/query/sight/crossing.h"
#include "io/written_amt.h"
#include "terrain/model/camera.h"

namespace arete {
namespace {

using test::TemporaryFolder;
using Exact = long double;
struct ExactPoint {
  Exact x, y, z;
};

/// A ball of triangles of radius 10 about 0,0,0, with bumps.
std::string bumpyBall(unsigned seed, int rings) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> bump(0.8, 1.2);
  std::string text;
  const int around = 2 * rings;
  text += "v 0 0 -10\nv 0 0 10\n";
  for (int i = 1; i < rings; ++i)
    for (int k = 0; k < around; ++k) {
      const double v = std::numbers::pi * (double(i) / rings - 0.5), u = std::numbers::pi * k / rings,
                   r = 10 * bump(random);
      text += fmt::format("v {} {} {}\n", r * std::cos(v) * std::cos(u), r * std::cos(v) * std::sin(u),
                          r * std::sin(v));
    }
  const auto at = [&](int i, int k) { return 3 + (i - 1) * around + k % around; };
  for (int k = 0; k < around; ++k) {
    text +=
        fmt::format("f 1 {} {}\nf 2 {} {}\n", at(1, k + 1), at(1, k), at(rings - 1, k), at(rings - 1, k + 1));
    for (int i = 1; i + 1 < rings; ++i)
      text += fmt::format("f {0} {1} {2}\nf {0} {2} {3}\n", at(i, k), at(i, k + 1), at(i + 1, k + 1),
                          at(i + 1, k));
  }
  return text;
}

/// Whether a segment meets a triangle: by signed volumes.
bool meetsExactly(const ExactPoint& p, const ExactPoint& q, const std::array<ExactPoint, 3>& t) {
  const auto volume = [](const ExactPoint& a, const ExactPoint& b, const ExactPoint& c, const ExactPoint& d) {
    const Exact ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z, vx = c.x - a.x, vy = c.y - a.y,
                vz = c.z - a.z, wx = d.x - a.x, wy = d.y - a.y, wz = d.z - a.z;
    return ux * (vy * wz - vz * wy) - uy * (vx * wz - vz * wx) + uz * (vx * wy - vy * wx);
  };
  if ((volume(p, t[0], t[1], t[2]) > 0) == (volume(q, t[0], t[1], t[2]) > 0)) return false;
  const bool a = volume(p, q, t[0], t[1]) > 0, b = volume(p, q, t[1], t[2]) > 0,
             c = volume(p, q, t[2], t[0]) > 0;
  return a == b && b == c;
}

class SightThroughMeshes : public testing::Test {
 protected:
  /// A plain at height 100 from 500000,5200000 on, a kilometre wide.
  void makeScene(const std::string& objects) {
    Georeference georeference;
    georeference.geoTransform = {500000, pixel_, 0, 5200000 + 100 * pixel_, 0, -pixel_};
    georeference.hasGeoTransform = true;
    georeference.crsWkt = kUtm32Wkt;
    georeference.verticalUnit = std::string("m");
    const std::vector<double> heights(101 * 101, 100.0);
    ASSERT_TRUE(writeGeoTiff(folder_.file("dem.tif"), 101, 101, heights, georeference));
    std::ofstream(folder_.file("scene.json")) << "{\"objects\": [{\"file\": \"dem.tif\"}" << objects << "]}";
    auto file = readScene(folder_.file("scene.json"));
    ASSERT_TRUE(file) << file.error().describe();
    auto scene = openScene(*std::move(file));
    ASSERT_TRUE(scene) << scene.error().describe();
    scene_.emplace(*std::move(scene));
  }
  void put(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.file(name)) << text;
  }
  SightPath path(Vec2 from, double fromHeight, Vec2 to, double toHeight) const {
    const TerrainModel& model = *scene_->terrainModel();
    return {sightPlan(model, from), sightPlan(model, to), fromHeight, toHeight};
  }
  std::optional<MeshObstruction> first(const SightPath& path, const SightEarth& earth) const {
    const auto line = sightLine(path, earth, *scene_->terrainModel());
    EXPECT_TRUE(line);
    return SceneSight(*scene_, *scene_->terrainModel()).first(*line);
  }

  /// The objects that fine chords of the line meet, both raised and lowered.
  std::optional<std::size_t> bruteForce(const SightLine& line, int chords) const {
    const TerrainModel& model = *scene_->terrainModel();
    std::optional<std::size_t> found;
    Exact nearest = 1e30L;
    for (std::size_t i = 0; i < scene_->objects.size(); ++i) {
      const SurfaceModel* surface = scene_->surfaceOf(i);
      if (!surface) continue;
      Exact at[2] = {1e30L, 1e30L};
      for (int side = 0; side < 2; ++side) {
        const double raised = (side == 0 ? 1 : -1) * line.tolerance();
        const auto place = [&](double s) {
          const Vec3 p = scene_->metricOf(
              metricPosition(model.toSource(line.planAt(s)), line.height(s) + raised, model));
          return ExactPoint{p.x, p.y, p.z};
        };
        for (std::uint32_t t = 0; t < surface->mt.triangleIdCount(); ++t) {
          const TriangleId id(t);
          const NodeId creator = surface->mt.creator(id);
          if (surface->mt.remover(id).isValid()) continue;
          std::array<ExactPoint, 3> corners;
          const auto c = surface->mt.corners(id, creator);
          for (int k = 0; k < 3; ++k) corners[k] = placed(i, surface->mt.position(VertexId(c[k])));
          for (int k = 0; k < chords; ++k) {
            const double s0 = line.length() * k / chords, s1 = line.length() * (k + 1) / chords;
            if (meetsExactly(place(s0), place(s1), corners)) at[side] = std::min(at[side], Exact(s0));
          }
        }
      }
      if (at[0] < 1e29L && at[1] < 1e29L && std::min(at[0], at[1]) < nearest) {
        nearest = std::min(at[0], at[1]);
        found = i;
      }
    }
    return found;
  }

  /// The placement as the page defines it: roll, then pitch, then heading, in extended precision.
  ExactPoint placed(std::size_t i, const Vec3& file) const {
    const SceneObject& o = scene_->file.objects[i];
    const TerrainModel& model = *scene_->terrainModel();
    constexpr Exact kDegree = std::numbers::pi_v<Exact> / 180;
    ExactPoint p{file.x, file.y, file.z};
    const Exact r = o.turn.roll * kDegree, e = o.turn.pitch * kDegree, h = o.turn.heading * kDegree;
    p = {p.x * std::cos(r) + p.z * std::sin(r), p.y, p.z * std::cos(r) - p.x * std::sin(r)};
    p = {p.x, p.y * std::cos(e) - p.z * std::sin(e), p.y * std::sin(e) + p.z * std::cos(e)};
    p = {p.x * std::cos(h) + p.y * std::sin(h), p.y * std::cos(h) - p.x * std::sin(h), p.z};
    const Vec3 stand = scene_->metricOf(metricPosition(o.place->xy, o.place->height.value_or(100), model));
    return {stand.x + o.scale * p.x, stand.y + o.scale * p.y, stand.z + o.above + o.scale * p.z};
  }

  double pixel_ = 10;  ///< metres
  TemporaryFolder folder_;
  std::optional<OpenScene> scene_;
};

TEST_F(SightThroughMeshes, EveryVerdictIsThatOfAllTriangles) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> part(0, 1);
  put("a.obj", bumpyBall(1, 6));
  put("b.obj", bumpyBall(2, 9));
  std::string objects;
  for (int i = 0; i < 6; ++i)
    objects += fmt::format(
        R"(, {{"file": "{}.obj", "at": [{}, {}], "above": {}, "turn": [{}, {}, {}], "scale": {}}})",
        i % 2 ? "a" : "b", 500350 + 300 * part(random), 5200350 + 300 * part(random), 20 * part(random),
        360 * part(random), 180 * part(random), 180 * part(random), 2 + 3 * part(random));
  makeScene(objects);
  const TerrainModel& model = *scene_->terrainModel();
  const auto plane = makePlaneEarth(model);
  const auto curved = makeEllipsoidEarth(model);
  ASSERT_TRUE(curved);
  const SceneSight sight(*scene_, *scene_->terrainModel());
  int blocked = 0;
  for (int i = 0; i < 200; ++i) {
    const auto place = [&] { return Vec2{500100 + 800 * part(random), 5200100 + 800 * part(random)}; };
    const SightPath one = path(place(), 101 + 30 * part(random), place(), 101 + 30 * part(random));
    const bool isPlane = i % 2 == 0;
    const auto line = sightLine(one, isPlane ? *plane : **curved, model);
    ASSERT_TRUE(line);
    const auto answer = sight.first(*line);
    const auto truth = bruteForce(*line, 1 + 7 * !isPlane);
    ASSERT_EQ(answer.has_value(), truth.has_value()) << "seed 5, line " << i;
    if (!answer) continue;
    ++blocked;
    EXPECT_NEAR(answer->height, line->height(answer->distance), 1e-6);
  }
  EXPECT_GT(blocked, 40);
  EXPECT_LT(blocked, 160);
}

/// A tower of 10 by 10 m, 30 m high, around 0,0.
constexpr const char* kTower =
    "v -5 -5 0\nv 5 -5 0\nv 5 5 0\nv -5 5 0\nv -5 -5 30\nv 5 -5 30\nv 5 5 30\nv -5 5 30\n"
    "f 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\nf 5 6 7 8\nf 4 3 2 1\n";

TEST_F(SightThroughMeshes, ATowerBlocksUpToItsTopWhichTouchesAndIsSeenAtItsVertices) {
  put("tower.obj", kTower);
  makeScene(R"(, {"name": "tower", "file": "tower.obj", "at": [500500, 5200500]},
                {"name": "ghost", "file": "tower.obj", "at": [500300, 5200500], "visible": false})");
  const auto earth = makePlaneEarth(*scene_->terrainModel());
  const auto level = [&](double y, double z) { return first(path({500200, y}, z, {500800, y}, z), *earth); };
  const auto blocked = level(5200501.3, 129.999);
  ASSERT_TRUE(blocked);
  EXPECT_EQ(scene_->file.objects[blocked->object].name, "tower") << "what is hidden is not in the way";
  EXPECT_NEAR(blocked->distance, 295, 1e-6);
  EXPECT_NEAR(blocked->height, 129.999, 1e-9);
  EXPECT_FALSE(level(5200501.3, 130)) << "touches the roof";
  EXPECT_FALSE(level(5200501.3, 130.00001));
  EXPECT_TRUE(level(5200501.3, 129.99));
  EXPECT_TRUE(level(5200500, 115)) << "through the middle, along edges of its faces";
  EXPECT_FALSE(level(5200505.001, 115)) << "beside it";
  // Its own vertices, edges and faces are seen from outside, and not through it.
  for (const double z : {130.0, 117.3, 100.5}) {
    EXPECT_FALSE(first(path({500200, 5200500}, 125, {500495, 5200500}, z), *earth)) << z;
    EXPECT_FALSE(first(path({500200, 5200300}, 125, {500495, 5200495}, z), *earth)) << z;
    EXPECT_TRUE(first(path({500200, 5200500}, 125, {500505, 5200503}, z - 1e-3), *earth)) << z;
  }
  EXPECT_FALSE(first(path({500500, 5200500}, 130, {500800, 5200500}, 130), *earth)) << "along the roof";
  EXPECT_TRUE(first(path({500500, 5200500}, 120, {500800, 5200500}, 101), *earth)) << "from inside";
  // Upright lines.
  EXPECT_TRUE(first(path({500501, 5200502}, 150, {500501, 5200502}, 101), *earth));
  EXPECT_FALSE(first(path({500501, 5200502}, 150, {500501, 5200502}, 130), *earth));
  EXPECT_FALSE(first(path({500511, 5200502}, 150, {500511, 5200502}, 101), *earth));
}

TEST_F(SightThroughMeshes, TheLineOfACurvedEarthSagsTowardsObjects) {
  put("tower.obj", kTower);
  pixel_ = 300;
  // Over 28 km the line sags by some 13 m: between heights of 150 it is at 136.8 above the middle.
  for (const auto& [above, isPlane, isBlocked] : {std::tuple{6.0, false, false},
                                                  {7.5, false, true},
                                                  {7.5, true, false},
                                                  {19.9, true, false},
                                                  {20.1, true, true}}) {
    makeScene(fmt::format(R"(, {{"file": "tower.obj", "at": [515000, 5215000], "above": {}}})", above));
    const TerrainModel& model = *scene_->terrainModel();
    const auto plane = makePlaneEarth(model);
    const auto curved = makeEllipsoidEarth(model);
    ASSERT_TRUE(curved);
    const auto met = first(path({501000, 5215000}, 150, {529000, 5215000}, 150), isPlane ? *plane : **curved);
    EXPECT_EQ(met.has_value(), isBlocked) << above << " " << isPlane;
    if (met) {
      EXPECT_NEAR(met->height, isPlane ? 150 : 136.8, 0.2);
      EXPECT_NEAR(met->distance, 13995, 5.5 * 4);
    }
  }
}

TEST_F(SightThroughMeshes, TinyObjectsAndSteepLinesAreSeenExactly) {
  put("tower.obj", kTower);
  // A post of 1 cm, whose middle is at 500500.5,5200500.
  makeScene(R"(, {"file": "tower.obj", "at": [500500.5, 5200500], "scale": 0.001})");
  const auto earth = makePlaneEarth(*scene_->terrainModel());
  const auto at = [&](double y, double z) {
    return first(path({500300, y}, z, {500800, y}, z), *earth).has_value();
  };
  EXPECT_TRUE(at(5200500.0049, 100.02));
  EXPECT_FALSE(at(5200500.0051, 100.02));
  EXPECT_TRUE(at(5200500.003, 100.0299));
  EXPECT_FALSE(at(5200500.003, 100.0301));
  // From a satellite down to the plain behind the post, and beside it.
  const auto down = [&](double y) {
    return first(path({500500.5, y}, 500000, {500500.5 + 1e-7, y}, 99), *earth).has_value();
  };
  EXPECT_TRUE(down(5200500.004));
  EXPECT_FALSE(down(5200500.006));
}

TEST_F(SightThroughMeshes, OnADemInDegreesObjectsHaveTheirMetres) {
  put("tower.obj", kTower);
  Georeference georeference;
  georeference.geoTransform = {9, 0.0001, 0, 47.01, 0, -0.0001};
  georeference.hasGeoTransform = true;
  georeference.crsWkt = kWgs84Wkt;
  georeference.isGeographic = true;
  georeference.verticalUnit = std::string("m");
  const std::vector<double> heights(101 * 101, 100.0);
  ASSERT_TRUE(writeGeoTiff(folder_.file("degrees.tif"), 101, 101, heights, georeference));
  put("degrees.json",
      R"({"objects": [{"file": "degrees.tif"}, {"file": "tower.obj", "lonlat": [9.005, 47.005]}]})");
  auto file = readScene(folder_.file("degrees.json"));
  ASSERT_TRUE(file);
  auto opened = openScene(*std::move(file));
  ASSERT_TRUE(opened) << opened.error().describe();
  scene_.emplace(*std::move(opened));
  const auto earth = makeEllipsoidEarth(*scene_->terrainModel());
  ASSERT_TRUE(earth);
  constexpr double kNorth = 1 / 111180.0, kEast = 1 / 76080.0;  // degrees of a metre at 47 degrees
  const auto eastwards = [&](double metres) {
    const double y = 47.005 + metres * kNorth;
    return first(path({9.002, y}, 110, {9.008, y}, 110), **earth).has_value();
  };
  const auto northwards = [&](double metres) {
    const double x = 9.005 + metres * kEast;
    return first(path({x, 47.002}, 110, {x, 47.008}, 110), **earth).has_value();
  };
  for (const double side : {-1.0, 1.0}) {
    EXPECT_TRUE(eastwards(4.95 * side));
    EXPECT_FALSE(eastwards(5.05 * side));
    EXPECT_TRUE(northwards(4.95 * side));
    EXPECT_FALSE(northwards(5.05 * side));
  }
}

TEST_F(SightThroughMeshes, PlacesOfAnotherCrsStandAndHeadByThatCrs) {
  put("tower.obj", kTower);
  makeScene(R"(, {"file": "tower.obj", "at": [500500, 5200500]})");
  const auto toLonLat = CrsTransform::between(kUtm32Wkt, "EPSG:4326");
  ASSERT_TRUE(toLonLat);
  const Vec2 lonLat = *(*toLonLat)({500500, 5200500});
  const auto to33 = CrsTransform::between(kUtm32Wkt, "EPSG:32633");
  ASSERT_TRUE(to33);
  const Vec2 in33 = *(*to33)({500500, 5200500}), north = *(*to33)({500500, 5200600});
  const Vec3 here = scene_->objects[1].placement({0, 0, 0});
  const auto standsHere = [&](const std::string& crs, const std::string& place, double clockwise) {
    const std::string text = fmt::format(
        R"({{"crs": "{}", "objects": [{{"file": "dem.tif"}}, {{"file": "tower.obj", {}}}]}})", crs, place);
    put("other.json", text);
    auto file = readScene(folder_.file("other.json"));
    ASSERT_TRUE(file) << file.error().describe();
    const auto scene = openScene(*std::move(file));
    ASSERT_TRUE(scene) << scene.error().describe();
    const Vec3 there = scene->objects[1].placement({0, 0, 0});
    EXPECT_LT(norm(there - here), 1e-3) << place;
    const Vec3 front = scene->objects[1].placement.direction({0, 1, 0});
    EXPECT_NEAR(std::atan2(front.x, front.y) * 180 / std::numbers::pi, clockwise, 1e-4) << crs;
  };
  // Zone 33 is to the east: its grid north leans to the west here, and the front with it, or against it.
  const double lean = std::atan2(north.x - in33.x, north.y - in33.y) * 180 / std::numbers::pi;
  EXPECT_GT(std::abs(lean), 3);
  standsHere("EPSG:32633", fmt::format(R"("at": [{:.4f}, {:.4f}])", in33.x, in33.y), -lean);
  // True north leans by the meridian's convergence.
  const double convergence = (lonLat.x - 9) * std::sin(lonLat.y * std::numbers::pi / 180);
  standsHere("EPSG:4326", fmt::format(R"("at": [{:.10f}, {:.10f}])", lonLat.x, lonLat.y), -convergence);
  standsHere("EPSG:32632", fmt::format(R"("lonlat": [{:.10f}, {:.10f}])", lonLat.x, lonLat.y), 0);
  standsHere("EPSG:32633",
             fmt::format(R"("lonlat": [{:.10f}, {:.10f}], "turn": [90, 0, 0])", lonLat.x, lonLat.y),
             90 - lean);
}

TEST_F(SightThroughMeshes, LinesThroughSharedEdgesAndVerticesDoNotLeak) {
  put("ball.obj", bumpyBall(3, 8));
  makeScene(R"(, {"file": "ball.obj", "at": [500500, 5200500], "above": 20, "turn": [33, 21, 7]})");
  const auto earth = makePlaneEarth(*scene_->terrainModel());
  const SurfaceModel& ball = *scene_->surfaceOf(1);
  const TerrainModel& model = *scene_->terrainModel();
  const SceneSight sight(*scene_, *scene_->terrainModel());
  int tried = 0;
  for (std::uint32_t v = 0; v < ball.mt.vertexCount(); ++v)
    for (std::uint32_t w = v; w < std::min(v + 20, ball.mt.vertexCount()); w += 3) {
      // From outside through a vertex, or the middle of two, to the other side through the middle of the
      // ball.
      const Vec3 a = scene_->objects[1].placement(ball.mt.position(VertexId(v))),
                 b = scene_->objects[1].placement(ball.mt.position(VertexId(w)));
      const Vec3 centre = scene_->objects[1].placement({0, 0, 0}), through = a * 0.5 + b * 0.5;
      const Vec3 out = through - centre;
      if (std::hypot(out.x, out.y) < 1) continue;
      const auto pathEnd = [&](double t) {
        const Vec3 p = scene_->metricOf(centre + t * out);
        const MetricFrame& m = model.mt.metric();
        return Vec3{p.x / m.scale.x + m.origin.x, p.y / m.scale.y + m.origin.y, p.z / m.scale.z + m.origin.z};
      };
      const double far = 100 / norm(out);
      const Vec3 from = pathEnd(far), to = pathEnd(-far);
      const auto line = sightLine({{from.x, from.y}, {to.x, to.y}, from.z, to.z}, *earth, model);
      ASSERT_TRUE(line);
      EXPECT_TRUE(sight.first(*line)) << v << " " << w;
      ++tried;
    }
  EXPECT_GT(tried, 300);
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Models on grids of every orientation and kind of CRS, for tests of cameras, and what a picture shows by a
// projection written out plainly.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "datasets/families.h"
#include "datasets/random.h"
#include "terrain/builder/build.h"
#include "terrain/model/camera.h"

namespace arete::test {

struct CameraModel {
  std::string name;
  TerrainModel model;
};

inline TerrainModel modelOn(const RasterFamily& family, const std::array<double, 6>& geoTransform,
                            bool isGeographic = false, double unitMetres = 1, std::uint64_t seed = 7) {
  RasterHeightfield field = family.make(47, 31, seed);
  field.georeference.geoTransform = geoTransform;
  field.georeference.hasGeoTransform = true;
  field.georeference.crsWkt = isGeographic ? "a geographic CRS" : "a projected CRS";
  field.georeference.isGeographic = isGeographic;
  field.georeference.verticalUnitMetres = unitMetres;
  Result<TerrainModel> model = build(field);
  EXPECT_TRUE(model);
  return std::move(*model);
}

inline const std::vector<CameraModel>& cameraModels() {
  static const std::vector<CameraModel> all = [] {
    const RasterFamily& family = rasterFamilies()[2];
    const double c = 30 * std::cos(0.4), s = 30 * std::sin(0.4);
    std::vector<CameraModel> made;
    made.push_back({"north up", modelOn(family, {500000, 30, 0, 4000000, 0, -30})});
    made.push_back({"south up", modelOn(family, {500000, 30, 0, 4000000, 0, 30})});
    made.push_back({"turned", modelOn(family, {500000, c, s, 4000000, s, -c})});
    made.push_back({"sheared", modelOn(family, {500000, 30, 10, 4000000, 0, -20})});
    made.push_back({"in feet", modelOn(family, {500000, 30, 0, 4000000, 0, -30}, false, 0.3048)});
    made.push_back({"geographic", modelOn(family, {10, 0.001, 0, 60.015, 0, -0.001}, true)});
    Result<TerrainModel> points = build(pointFamilies()[0].make(300, 5));
    EXPECT_TRUE(points);
    made.push_back({"points", std::move(*points)});
    return made;
  }();
  return all;
}

/// Where in a picture of 2 x 2, y up, a camera has a metric point; nothing behind it.
inline std::optional<Vec2> inPicture(const Camera& camera, const Vec3& p, const TerrainModel& model) {
  const Result<View> view = viewOf(camera, model);
  if (!view) return std::nullopt;
  const Frustum frustum(*view);
  Vec3 q = frustum.toView(p);
  if (!(q.z > 0)) return std::nullopt;
  const auto planes = frustum.planes();
  return Vec2{q.x / (q.z * planes.slopeX), q.y / (q.z * planes.slopeY)};
}

/// A camera somewhere over a model, looking anywhere.
inline Camera randomCamera(Random& random, const TerrainModel& model) {
  const double columns = model.isRaster ? model.columns : 0, rows = model.isRaster ? model.rows : 0;
  const MetricFrame& metric = model.mt.arrays().metric;
  const Vec2 plan =
      model.isRaster ? Vec2{random.between(-5, columns + 5), random.between(-5, rows + 5)}
                     : Vec2{metric.origin.x + random.between(-1, 1), metric.origin.y + random.between(-1, 1)};
  return {.xy = model.toSource(plan),
          .height = metric.origin.z + random.between(-500, 3000),
          .azimuthDegrees = random.between(0, 360),
          .pitchDegrees = random.between(-90, 90),
          .verticalFieldOfViewDegrees = random.between(10, 100)};
}

inline double apart(const Vec3& a, const Vec3& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

/// Degrees between two azimuths.
inline double turned(double a, double b) {
  return std::abs(std::remainder(a - b, 360));
}

}  // namespace arete::test

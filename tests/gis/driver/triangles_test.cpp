// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <tuple>
#include <vector>

#include "engine/cut/cut.h"
#include "gis/driver/driver_fixture.h"
#include "io/store/amt/surface_file.h"
#include "surface/builder/build.h"
#include "surface/families.h"

namespace arete {
namespace {

using test::Dataset;

struct Triangle {
  std::array<Vec3, 3> corners;
  double error;
};

class TriangleDriver : public test::DriverFixture {
 protected:
  /// @param isInPlan counter-clockwise from above, as terrain is
  static std::map<GIntBig, Triangle> trianglesOf(OGRLayer& layer, bool isInPlan = true) {
    std::map<GIntBig, Triangle> all;
    layer.ResetReading();
    for (std::unique_ptr<OGRFeature> f(layer.GetNextFeature()); f; f.reset(layer.GetNextFeature())) {
      const OGRLinearRing* const ring = f->GetGeometryRef()->toPolygon()->getExteriorRing();
      EXPECT_EQ(ring->getNumPoints(), 4);
      EXPECT_TRUE(ring->get_IsClosed());
      if (isInPlan) {
        EXPECT_FALSE(ring->isClockwise());
      }
      Triangle t{{}, f->GetFieldAsDouble("error")};
      for (int i = 0; i < 3; ++i) t.corners[std::size_t(i)] = {ring->getX(i), ring->getY(i), ring->getZ(i)};
      EXPECT_TRUE(all.emplace(f->GetFID(), t).second) << "a number twice";
    }
    return all;
  }
};

TEST_F(TriangleDriver, GivesTheTrianglesOfTheCutWithTheirErrors) {
  const std::string path = terrain("hills.amt", 120, 90, hills);
  const Dataset dataset = open(path, {"TOLERANCE=4"}, GDAL_OF_VECTOR);
  ASSERT_TRUE(dataset) << message();
  ASSERT_EQ(dataset->GetLayerCount(), 1);
  OGRLayer& layer = *dataset->GetLayer(0);
  EXPECT_STREQ(layer.GetName(), "triangles");
  EXPECT_EQ(layer.GetGeomType(), wkbPolygon25D);
  ASSERT_NE(layer.GetSpatialRef(), nullptr);
  EXPECT_STREQ(layer.GetSpatialRef()->GetAuthorityCode(nullptr), "32611");
  const auto model = loadAmt(path);
  ASSERT_TRUE(model);
  const auto cut = takeCut(model->mt, UniformError(4));
  ASSERT_TRUE(cut);
  EXPECT_EQ(layer.GetFeatureCount(), GIntBig(cut->ids.size()));
  const auto triangles = trianglesOf(layer, false);
  EXPECT_EQ(triangles.size(), cut->ids.size());
  double area = 0;
  for (const auto& [id, t] : triangles) {
    EXPECT_LE(t.error, 4);
    EXPECT_NEAR(t.error, model->mt.error(TriangleId(std::uint32_t(id))), 1e-5);
    for (const Vec3& p : t.corners) ASSERT_NEAR(p.z, hills(p.x, p.y), 1e-9);
    area += ((t.corners[1].x - t.corners[0].x) * (t.corners[2].y - t.corners[0].y) -
             (t.corners[2].x - t.corners[0].x) * (t.corners[1].y - t.corners[0].y)) /
            2;
  }
  EXPECT_NEAR(area, 119 * 30 * 89 * 30, 1e-3);
  OGREnvelope box;
  ASSERT_EQ(layer.GetExtent(&box), OGRERR_NONE);
  EXPECT_DOUBLE_EQ(box.MinX, 500015);
  EXPECT_DOUBLE_EQ(box.MaxX, 500000 + 119.5 * 30);
}

TEST_F(TriangleDriver, GivesItsExtentWhateverWasInTheCallersMemory) {
  const std::string path = terrain("hills.amt", 40, 30, hills);
  const Dataset dataset = open(path, {"TOLERANCE=4"}, GDAL_OF_VECTOR);
  ASSERT_TRUE(dataset) << message();
  OGRLayer& layer = *dataset->GetLayer(0);
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  const double garbage[] = {0,        -0.0,     1,   -1e300,   1e300,     5e-324,
                            3.7e-315, 6.9e-310, nan, infinity, -infinity, 500100};
  for (const double x : garbage)
    for (const double y : garbage)
      for (const bool isThroughC : {false, true}) {
        OGREnvelope box;
        box.MinX = box.MaxY = x;
        box.MaxX = box.MinY = y;
        ASSERT_EQ(isThroughC ? OGR_L_GetExtent(OGRLayer::ToHandle(&layer), &box, TRUE)
                             : layer.GetExtent(0, &box, TRUE),
                  OGRERR_NONE);
        ASSERT_DOUBLE_EQ(box.MinX, 500015) << x << ", " << y;
        ASSERT_DOUBLE_EQ(box.MaxX, 500000 + 39.5 * 30);
        ASSERT_DOUBLE_EQ(box.MinY, 4000000 - 29.5 * 30);
        ASSERT_DOUBLE_EQ(box.MaxY, 3999985);
      }
}

TEST_F(TriangleDriver, NumbersATriangleAlikeAtEveryTolerance) {
  const std::string path = terrain("hills.amt", 120, 90, hills);
  const Dataset coarse = open(path, {"TOLERANCE=4"}), fine = open(path, {"TOLERANCE=2"});
  ASSERT_TRUE(coarse && fine);
  const auto few = trianglesOf(*coarse->GetLayer(0)), many = trianglesOf(*fine->GetLayer(0));
  int same = 0;
  for (const auto& [id, t] : few)
    if (const auto other = many.find(id); other != many.end()) {
      ++same;
      EXPECT_EQ(t.corners, other->second.corners);
    }
  EXPECT_GT(same, 5);
}

TEST_F(TriangleDriver, NumbersTheTrianglesOfPagesAsTheWholeDoes) {
  const auto surface = buildSurface(SurfaceMesh(shapes::globe(90, 60)));
  ASSERT_TRUE(surface);
  const std::string globe = folder().file("globe.amt");
  ASSERT_TRUE(writeSurfaceAmt(globe, *surface, {}, {.isPaged = true}));
  const auto wholeGlobe = loadSurfaceAmt(globe);
  const auto ground = loadAmt(terrain("plain.amt", 200, 150, hills));
  ASSERT_TRUE(wholeGlobe && ground);
  const std::string country = folder().file("country.amt");
  ASSERT_TRUE(writeAmt(country, *ground, {}, {.isPaged = true}));
  const auto wholeCountry = loadAmt(country);
  ASSERT_TRUE(wholeCountry);
  for (const auto& [path, mt, tolerance] : {std::tuple{globe, &wholeGlobe->mt, 0.02},
                                            {globe, &wholeGlobe->mt, 0.002},
                                            {country, &wholeCountry->mt, 8.0},
                                            {country, &wholeCountry->mt, 1.0}}) {
    const Dataset dataset = open(path, {fmt::format("TOLERANCE={}", tolerance).c_str()}, GDAL_OF_VECTOR);
    ASSERT_TRUE(dataset) << message();
    const auto cut = takeCut(*mt, UniformError(tolerance));
    ASSERT_TRUE(cut);
    std::vector<GIntBig> numbers, ids(cut->ids.begin(), cut->ids.end());
    for (const auto& [id, t] : trianglesOf(*dataset->GetLayer(0), path == country)) numbers.push_back(id);
    std::ranges::sort(ids);
    EXPECT_EQ(numbers, ids) << path << " within " << tolerance;
  }
}

TEST_F(TriangleDriver, FiltersByPlaceAndByErrorAndFindsByNumber) {
  const std::string path = terrain("hills.amt", 120, 90, hills);
  const Dataset dataset = open(path, {"TOLERANCE=4"});
  ASSERT_TRUE(dataset) << message();
  OGRLayer& layer = *dataset->GetLayer(0);
  const auto all = trianglesOf(layer);
  layer.SetSpatialFilterRect(501000, 3998000, 501500, 3998500);
  const auto near = trianglesOf(layer);
  EXPECT_EQ(layer.GetFeatureCount(), GIntBig(near.size()));
  EXPECT_GT(near.size(), 0u);
  EXPECT_LT(near.size(), all.size() / 2);
  layer.SetSpatialFilter(nullptr);
  ASSERT_EQ(layer.SetAttributeFilter("error > 3"), OGRERR_NONE);
  std::size_t wanted = 0;
  for (const auto& [id, t] : all) wanted += t.error > 3 ? 1 : 0;
  EXPECT_EQ(trianglesOf(layer).size(), wanted);
  EXPECT_EQ(layer.GetFeatureCount(), GIntBig(wanted));
  layer.SetAttributeFilter(nullptr);
  EXPECT_EQ(layer.GetFeatureCount(), GIntBig(all.size()));
  const std::unique_ptr<OGRFeature> one(layer.GetFeature(all.begin()->first));
  ASSERT_TRUE(one);
  EXPECT_EQ(one->GetFID(), all.begin()->first);
  EXPECT_FALSE(std::unique_ptr<OGRFeature>(layer.GetFeature(-1)));
  EXPECT_FALSE(std::unique_ptr<OGRFeature>(layer.GetFeature(GIntBig(1) << 40)));
}

TEST_F(TriangleDriver, OpensASurfaceAsTrianglesAndSaysWhyNotAsARaster) {
  const auto model = buildSurface(SurfaceMesh(shapes::globe(20, 12)));
  ASSERT_TRUE(model);
  const std::string path = folder().file("globe.amt");
  ASSERT_TRUE(writeSurfaceAmt(path, *model));
  const Dataset raster = open(path, {}, GDAL_OF_RASTER);
  EXPECT_FALSE(raster);
  EXPECT_NE(message().find("opens as a layer of triangles"), std::string::npos) << message();
  const Dataset dataset = open(path, {"TOLERANCE=0.05"}, GDAL_OF_VECTOR);
  ASSERT_TRUE(dataset) << message();
  EXPECT_EQ(dataset->GetRasterCount(), 0);
  const auto cut = takeCut(model->mt, UniformError(0.05));
  ASSERT_TRUE(cut);
  EXPECT_EQ(dataset->GetLayer(0)->GetFeatureCount(), GIntBig(cut->ids.size()));
  const std::unique_ptr<OGRFeature> first(dataset->GetLayer(0)->GetNextFeature());
  ASSERT_TRUE(first);
  EXPECT_LE(first->GetFieldAsDouble("error"), 0.05);
}

TEST_F(TriangleDriver, ReadsOfASurfaceInPagesWhatItsToleranceNeeds) {
  const auto model = buildSurface(SurfaceMesh(shapes::globe(90, 60)));
  ASSERT_TRUE(model);
  const std::string path = folder().file("globe.amt");
  ASSERT_TRUE(writeSurfaceAmt(path, *model, {}, {.isPaged = true}));
  const auto whole = loadSurfaceAmt(path);
  ASSERT_TRUE(whole);
  // The last page has fine triangles alone, and is damaged.
  const std::uintmax_t size = std::filesystem::file_size(path);
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(std::streamoff(size - 64));
  file.write("damage", 6);
  file.close();
  const Dataset dataset = open(path, {"TOLERANCE=0.05"}, GDAL_OF_VECTOR);
  ASSERT_TRUE(dataset) << message();
  const auto cut = takeCut(whole->mt, UniformError(0.05));
  ASSERT_TRUE(cut);
  OGRLayer& layer = *dataset->GetLayer(0);
  EXPECT_EQ(layer.GetFeatureCount(), GIntBig(cut->ids.size()));
  const auto triangles = trianglesOf(layer, false);
  for (std::size_t t = 0; t < cut->ids.size(); ++t) {
    const auto found = std::ranges::find_if(triangles, [&](const auto& one) {
      return std::ranges::all_of(cut->triangles[t], [&](std::uint32_t v) {
        return std::ranges::count(one.second.corners, whole->mt.position(VertexId(cut->vertices[v]))) == 1;
      });
    });
    ASSERT_NE(found, triangles.end());
    EXPECT_EQ(found->second.error, double(static_cast<float>(whole->mt.error(TriangleId(cut->ids[t])))));
  }
  const Dataset finest = open(path, {}, GDAL_OF_VECTOR);
  ASSERT_TRUE(finest) << message();
  CPLPushErrorHandler(CPLQuietErrorHandler);
  EXPECT_EQ(finest->GetLayer(0)->GetFeatureCount(), 0);
  CPLPopErrorHandler();
  EXPECT_NE(std::string(CPLGetLastErrorMsg()).find(path), std::string::npos) << CPLGetLastErrorMsg();
}

}  // namespace
}  // namespace arete

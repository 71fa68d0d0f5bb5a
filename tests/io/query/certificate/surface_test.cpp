// SPDX-License-Identifier: GPL-3.0-or-later
//
// Meshes that are off by planted lengths, held against a sheet whose distances are known without any search.
#include "io/query/certificate/surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/criteria/space_region.h"
#include "surface/builder/build.h"
#include "surface/front/front.h"

namespace arete {
namespace {

constexpr int kSide = 8;

/// A flat sheet of unit squares.
/// @param height of vertices with x above 4
TriangleMesh sheet(double height = 0) {
  TriangleMesh mesh;
  for (int y = 0; y <= kSide; ++y)
    for (int x = 0; x <= kSide; ++x) mesh.positions.push_back({double(x), double(y), x > 4 ? height : 0});
  for (std::uint32_t y = 0; y < kSide; ++y)
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const std::uint32_t a = (kSide + 1) * y + x;
      mesh.triangles.push_back({a, a + 1, a + kSide + 2});
      mesh.triangles.push_back({a, a + kSide + 2, a + kSide + 1});
    }
  return mesh;
}

class CertificateOfASurface : public ::testing::Test {
 protected:
  void SetUp() override {
    auto built = buildSurface(SurfaceMesh(sheet()));
    ASSERT_TRUE(built) << built.error().describe();
    model_ = std::move(*built);
  }
  SurfaceMeasure measured(const TriangleMesh& mesh, const CutRequest& request, bool isComplete = true) {
    auto found = measureSurface(sheet(), mesh, model_, request, isComplete, 1000);
    EXPECT_TRUE(found) << found.error().describe();
    return *found;
  }

  SurfaceModel model_;
};

TEST_F(CertificateOfASurface, IsKeptUpToTheDistanceThatIsThereAndNotBelow) {
  // Lifted beyond x = 5; from 4 to 5 it is a slope.
  const SurfaceMeasure found = measured(sheet(0.25), {});
  EXPECT_NEAR(found.distances.backward.maximum, 0.25, 1e-12);
  EXPECT_TRUE(keepsPromise(found, 0.25));
  EXPECT_FALSE(keepsPromise(found, 0.2499));
  EXPECT_FALSE(found.places);
}

TEST_F(CertificateOfASurface, HoldsAVertexAgainstTheErrorOfItsPlace) {
  CutRequest region;
  region.maxError = 0.1;
  region.spaceRegion = std::make_shared<BoxRegion>(Vec3{-1, -1, -1}, Vec3{4.5, 9, 1});
  const SurfaceMeasure inside = measured(sheet(0.25), region);
  ASSERT_TRUE(inside.places);
  EXPECT_EQ(inside.places->vertices, 5u * 9u) << "elsewhere nothing is asked for";
  EXPECT_EQ(inside.places->beyond, 0u);
  region.spaceRegion = std::make_shared<BoxRegion>(Vec3{-1, -1, -1}, Vec3{6.5, 9, 1});
  const SurfaceMeasure wide = measured(sheet(0.25), region);
  ASSERT_TRUE(wide.places);
  EXPECT_EQ(wide.places->beyond, 2u * 9u) << "of x = 5 and x = 6";
  EXPECT_FALSE(keepsPromise(wide, 1)) << "though all of it is within the promise";
  EXPECT_FALSE(measured(sheet(0.25), region, false).places) << "a cut that is not complete promises no place";

  CutRequest focus;
  focus.maxError = 0.05;
  focus.focus = {.xy = {0, 4}, .growth = 0.05, .z = 0};
  EXPECT_EQ(measured(sheet(0.25), focus).places->beyond, 0u) << "at a distance of 5, 0.3 are allowed";
  focus.focus->growth = 0.03;
  const auto near = measured(sheet(0.25), focus).places;
  std::uint64_t expected = 0;
  for (int x = 5; x <= kSide; ++x)
    for (int y = 0; y <= kSide; ++y) expected += 0.25 > 0.05 + 0.03 * std::hypot(x, y - 4) ? 1 : 0;
  ASSERT_GT(expected, 0u);
  EXPECT_EQ(near->beyond, expected);
  EXPECT_GT(near->largestShare, 1);
}

TEST_F(CertificateOfASurface, RaisesWhatItMeasuresByWhatRoundingMoved) {
  model_.positionError = 0.5;
  const SurfaceMeasure found = measured(sheet(0.25), {});
  EXPECT_NEAR(found.distances.backward.maximum, 0.75, 1e-12);
  EXPECT_FALSE(keepsPromise(found, 0.7));
}

TEST_F(CertificateOfASurface, IsJsonWithNullForNoLimitAndTextOfAnyBytes) {
  SurfaceCertificate certificate;
  certificate.file = "a\xff.ply";
  certificate.formatName = "PLY";
  certificate.promisedError = std::numeric_limits<double>::infinity();
  certificate.measured = measured(sheet(), {});
  const auto json = nlohmann::json::parse(certificateJson(certificate, model_), nullptr, false);
  ASSERT_FALSE(json.is_discarded());
  EXPECT_TRUE(json["promise"]["maxError"].is_null());
  EXPECT_EQ(json["checksum"], "");
  EXPECT_FALSE(json["format"].contains("heightRounding"));
  EXPECT_FALSE(json.contains("measuredPlaces"));
}

}  // namespace
}  // namespace arete

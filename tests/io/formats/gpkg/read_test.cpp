// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/gpkg/gpkg.h"

#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <memory>
#include <random>

#include "io/geo/crs/names.h"
#include "io/geo/gdal/support.h"
#include "io/mesh_fixture.h"

namespace arete {
namespace {

using namespace test;

const TriangleMesh kTwo = {{{0, 0, 1}, {1, 0, 2}, {0, 1, 3}, {1, 1, 4}}, {{0, 1, 2}, {2, 1, 3}}};

/// A GeoPackage with one layer of the given geometries.
std::string foreignGpkg(const TemporaryFolder& folder, const std::vector<std::string>& wkts,
                        OGRwkbGeometryType type = wkbUnknown) {
  GDALAllRegister();
  const std::string path = folder.file("foreign.gpkg");
  std::filesystem::remove(path);
  GdalDatasetPtr dataset(
      GetGDALDriverManager()->GetDriverByName("GPKG")->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  OGRLayer* layer = dataset->CreateLayer("things", nullptr, type, nullptr);
  for (const std::string& wkt : wkts) {
    OGRGeometry* geometry = nullptr;
    OGRGeometryFactory::createFromWkt(wkt.c_str(), nullptr, &geometry);
    OGRFeature feature(layer->GetLayerDefn());
    feature.SetGeometryDirectly(geometry);
    EXPECT_EQ(layer->CreateFeature(&feature), OGRERR_NONE);
  }
  return path;
}

TEST(GpkgRead, RoundTripsEveryFamilyToTheBitWithItsErrors) {
  const TemporaryFolder folder;
  for (const RasterFamily& family : rasterFamilies()) {
    SCOPED_TRACE(family.name);
    const TriangleMesh mesh = gridMesh(family.make(17, 12, 5));
    std::vector<float> errors(mesh.triangles.size());
    for (std::size_t t = 0; t < errors.size(); ++t) errors[t] = static_cast<float>(t) / 7;
    const std::string path = folder.file("a.gpkg");
    const auto written =
        writeMesh(mesh, path, {.crsWkt = "EPSG:32611", .verticalUnit = "ft", .triangleErrors = errors});
    ASSERT_TRUE(written) << written.error().describe();
    const Result<MeshFile> file = readMesh(path);
    ASSERT_TRUE(file) << file.error().describe();
    expectSameTriangles(mesh, file->mesh, {0, 0, 0});
    EXPECT_EQ(file->mesh.positions.size(), mesh.positions.size());
    EXPECT_EQ(file->triangleErrors, errors);
    EXPECT_EQ(compareCrs(file->crsWkt, "EPSG:32611"), CrsAgreement::same);
    EXPECT_EQ(file->verticalUnit, "ft");
  }
  EXPECT_EQ(folder.count(), 1u);
}

TEST(GpkgRead, KeepsACompoundCrsAndHasNoneWhereThereIsNone) {
  const TemporaryFolder folder;
  ASSERT_TRUE(writeMesh(kTwo, folder.file("a.gpkg"), {.crsWkt = "EPSG:32632+5773"}));
  const Result<MeshFile> compound = readMesh(folder.file("a.gpkg"));
  ASSERT_TRUE(compound) << compound.error().describe();
  EXPECT_NE(compound->crsWkt.find("EGM96 height"), std::string::npos) << compound->crsWkt;
  EXPECT_EQ(compound->verticalUnit, "metre");
  ASSERT_TRUE(writeMesh(kTwo, folder.file("b.gpkg")));
  const Result<MeshFile> bare = readMesh(folder.file("b.gpkg"));
  ASSERT_TRUE(bare) << bare.error().describe();
  EXPECT_EQ(bare->crsWkt, "");
  EXPECT_EQ(bare->verticalUnit, "");
  EXPECT_TRUE(bare->triangleErrors.empty());
  EXPECT_EQ(writeMesh(kTwo, folder.file("c.gpkg"), {.crsWkt = "gibberish"}).error().code,
            ErrorCode::invalidData);
  EXPECT_EQ(folder.count(), 2u);
}

TEST(GpkgRead, IsTheSameBytesEveryTimeAndIndexed) {
  const TemporaryFolder folder;
  for (const char* name : {"a.gpkg", "b.gpkg"})
    ASSERT_TRUE(writeMesh(kTwo, folder.file(name),
                          {.crsWkt = "EPSG:4326", .verticalUnit = "m", .notes = {"about it"}}));
  EXPECT_EQ(bytesOf(folder.file("a.gpkg")), bytesOf(folder.file("b.gpkg")));
  const GdalDatasetPtr dataset = openGdal(folder.file("a.gpkg"), GDAL_OF_VECTOR);
  ASSERT_TRUE(dataset);
  ASSERT_EQ(dataset->GetLayerCount(), 1);
  OGRLayer* layer = dataset->GetLayer(0);
  EXPECT_STREQ(layer->GetName(), "triangles");
  EXPECT_EQ(layer->GetGeomType(), wkbPolygon25D);
  EXPECT_TRUE(layer->TestCapability(OLCFastSpatialFilter));
  const OGRFeatureUniquePtr feature(layer->GetNextFeature());
  EXPECT_EQ(feature->GetFieldAsInteger("triangle"), 0);
  EXPECT_FALSE(feature->GetGeometryRef()->toPolygon()->getExteriorRing()->isClockwise());
}

TEST(GpkgRead, ReadsForeignSurfaces) {
  const TemporaryFolder folder;
  const std::string a = "((0 0 1,1 0 2,0 1 3,0 0 1))", b = "((0 1 3,1 0 2,1 1 4,0 1 3))";
  for (const auto& wkts : {std::vector<std::string>{"TIN Z (" + a + "," + b + ")"},
                           std::vector<std::string>{"POLYGON Z " + a, "POLYGON Z EMPTY", "POLYGON Z " + b},
                           std::vector<std::string>{"TRIANGLE Z " + a, "MULTIPOLYGON Z (" + b + ")"},
                           std::vector<std::string>{"POLYHEDRALSURFACE Z (" + a + ")",
                                                    "GEOMETRYCOLLECTION Z (POLYGON Z " + b + ")"}}) {
    const Result<MeshFile> file = readMesh(foreignGpkg(folder, wkts));
    ASSERT_TRUE(file) << wkts.front() << file.error().describe();
    EXPECT_EQ(file->mesh.positions, kTwo.positions) << wkts.front();
    EXPECT_EQ(file->mesh.triangles, kTwo.triangles);
    EXPECT_EQ(file->crsWkt, "");
  }
  EXPECT_TRUE(readMesh(foreignGpkg(folder, {"TIN Z (" + a + ")"}, wkbTINZ)));
}

TEST(GpkgRead, NamesWhatIsNoTriangle) {
  const TemporaryFolder folder;
  for (const char* wkt : {"POLYGON ((0 0,1 0,0 1,0 0))", "POLYGON Z ((0 0 1,1 0 1,0 0 1))",
                          "POLYGON Z ((0 0 1,9 0 2,0 9 3,0 0 1),(1 1 1,20 1 1,1 2 1,1 1 1))",
                          "POINT Z (1 2 3)", "LINESTRING Z (1 2 3,4 5 6)"}) {
    const Error error = refusal(foreignGpkg(folder, {wkt}));
    EXPECT_EQ(error.code, ErrorCode::unsupported) << wkt;
    EXPECT_NE(error.message.find("feature 1 of layer 'things'"), std::string::npos) << error.message;
  }
  EXPECT_EQ(refusal(foreignGpkg(folder, {"POINT Z (1 2 3)"}, wkbPoint25D)).code, ErrorCode::unsupported);
}

TEST(GpkgRead, RefusesAFileThatIsDamagedOrCut) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = gridMesh(rasterFamilies().front().make(40, 40, 5));
  ASSERT_TRUE(writeMesh(mesh, folder.file("a.gpkg"), {.crsWkt = "EPSG:32611"}));
  const std::string whole = bytesOf(folder.file("a.gpkg"));
  EXPECT_EQ(readMesh(folder.file("no.gpkg")).error().code, ErrorCode::notFound);
  EXPECT_EQ(refusal(folder.write("e.gpkg", "")).code, ErrorCode::unreadable);
  EXPECT_EQ(refusal(folder.write("t.gpkg", "this is a text and nothing else")).code, ErrorCode::corrupt);
  for (const std::size_t part : {1, 2, 5, 8}) {
    const Result<MeshFile> cut =
        readMesh(folder.write("cut.gpkg", whole.substr(0, whole.size() * part / 10)));
    EXPECT_FALSE(cut) << part;
  }
  std::mt19937 random(5);
  for (int i = 0; i < 60; ++i) {
    std::string damaged = whole;
    for (int k = 0; k < 8; ++k) damaged[random() % damaged.size()] = static_cast<char>(random());
    const Result<MeshFile> file = readMesh(folder.write("d.gpkg", damaged));
    EXPECT_TRUE(!file || file->mesh.validate());
  }
}

TEST(GpkgRead, LeavesNothingWhenItIsStopped) {
  const TemporaryFolder folder;
  const std::atomic<bool> stop = true;
  RunContext context;
  context.cancel = &stop;
  EXPECT_EQ(writeMesh(kTwo, folder.file("a.gpkg"), {}, context).error().code, ErrorCode::interrupted);
  const std::vector<float> one = {1};
  EXPECT_EQ(writeMesh(kTwo, folder.file("a.gpkg"), {.triangleErrors = one}).error().code,
            ErrorCode::invalidData);
  EXPECT_EQ(folder.count(), 0u);
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/exchange/mesh_formats.h"

#include <gtest/gtest.h>

#include <atomic>
#include <bit>
#include <cmath>
#include <random>
#include <string>

#include "io/io_fixture.h"
#include "io/mesh_file_fixture.h"

namespace arete {
namespace {

using namespace test;

using MeshFormats = MeshFileTest;

TEST_F(MeshFormats, RoundTripsToTheBit) {
  TriangleMesh random;
  std::mt19937_64 generator(1);
  while (random.positions.size() < 3000) {
    const Vec3 p{std::bit_cast<double>(generator()), double(generator()) / 7,
                 double(generator() % 100000) / 10};
    if (std::isfinite(p.x)) random.positions.push_back(p);
  }
  for (int t = 0; t < 5000; ++t)
    random.triangles.push_back({std::uint32_t(generator() % 3000), std::uint32_t(generator() % 3000),
                                std::uint32_t(generator() % 3000)});
  for (const char* name : {"a.ply", "a.obj", "B.PLY", "b.Obj"}) {
    for (const TriangleMesh& mesh : {awkward(), random, TriangleMesh{}}) {
      SCOPED_TRACE(name);
      const fs::path path = folder_ / name;
      ASSERT_TRUE(
          writeMesh(mesh, path, {.crsWkt = kWkt, .verticalUnit = "metre", .notes = {"max error 10"}}));
      const Result<MeshFile> file = readMesh(path);
      ASSERT_TRUE(file) << file.error().describe();
      expectSameBits(mesh, file->mesh);
      EXPECT_EQ(file->crsWkt, kWkt);
      EXPECT_EQ(file->verticalUnit, "metre");
    }
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 4);
}

TEST_F(MeshFormats, NamesTheFormatsItKnows) {
  for (const Error& error : {readMesh("model.dxf").error(), writeMesh(TriangleMesh{}, "model.dxf").error()}) {
    EXPECT_EQ(error.code, ErrorCode::unsupported);
    EXPECT_NE(error.message.find("PLY (.ply)"), std::string::npos);
    EXPECT_NE(error.message.find("OBJ (.obj)"), std::string::npos);
    EXPECT_NE(error.message.find(".dxf"), std::string::npos);
    EXPECT_EQ(error.culprit, "model.dxf");
  }
  EXPECT_EQ(readMesh("model").error().code, ErrorCode::unsupported);
  EXPECT_NE(readMesh("dem.amt").error().message.find("arete extract"), std::string::npos);
}

TEST_F(MeshFormats, RefusesWhatIsNotThere) {
  EXPECT_EQ(readMesh(folder_ / "no.ply").error().code, ErrorCode::notFound);
  EXPECT_EQ(readMesh(folder_ / "no.obj").error().code, ErrorCode::notFound);
  fs::create_directory(folder_ / "folder.ply");
  EXPECT_EQ(readMesh(folder_ / "folder.ply").error().code, ErrorCode::unreadable);
  EXPECT_EQ(writeMesh(awkward(), folder_ / "no" / "a.ply").error().code, ErrorCode::notFound);
}

TEST_F(MeshFormats, RefusesToWriteNonsenseAndLeavesNothing) {
  TriangleMesh mesh = awkward();
  mesh.triangles.push_back({0, 1, 4});
  for (const char* name : {"a.ply", "a.obj"}) {
    EXPECT_EQ(writeMesh(mesh, folder_ / name).error().code, ErrorCode::invalidData);
    const std::atomic<bool> stop = true;
    RunContext context;
    context.cancel = &stop;
    EXPECT_EQ(writeMesh(awkward(), folder_ / name, {}, context).error().code, ErrorCode::interrupted);
  }
  EXPECT_TRUE(fs::is_empty(folder_));
}

}  // namespace
}  // namespace arete

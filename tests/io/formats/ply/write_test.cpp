// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/ply/ply.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

#include "io/io_fixture.h"
#include "io/mesh_file_fixture.h"

namespace arete {
namespace {

using namespace test;

using PlyWrite = MeshFileTest;

TEST_F(PlyWrite, WritesTheErrorOfEachFace) {
  const std::vector<float> errors = {1.5f, 2.25f};
  const TriangleMesh mesh = awkward();
  ASSERT_TRUE(writeMesh(mesh, folder_ / "a.ply", {.triangleErrors = errors}));
  const std::string bytes = contents(folder_ / "a.ply");
  EXPECT_NE(bytes.find("property float error\n"), std::string::npos);
  EXPECT_NE(bytes.find("comment generator arete\n"), std::string::npos);
  float last = 0;
  std::memcpy(&last, bytes.data() + bytes.size() - 4, 4);
  EXPECT_EQ(last, 2.25f);
  const Result<MeshFile> file = readMesh(folder_ / "a.ply");
  ASSERT_TRUE(file);
  expectSameBits(mesh, file->mesh);
  EXPECT_EQ(file->triangleErrors, errors);
  EXPECT_FALSE(writeMesh(mesh, folder_ / "b.ply", {.triangleErrors = std::span(errors).first(1)}));
  EXPECT_FALSE(fs::exists(folder_ / "b.ply"));
}

TEST_F(PlyWrite, WritesAQualityAndAColorOfEachVertex) {
  const TriangleMesh mesh = awkward();
  const std::vector<float> qualities(mesh.positions.size(), 1.5f);
  const std::vector<std::array<std::uint8_t, 3>> colors(mesh.positions.size(), {1, 2, 3});
  ASSERT_TRUE(writeMesh(mesh, folder_ / "a.ply", {.vertexQualities = qualities, .vertexColors = colors}));
  const std::string bytes = contents(folder_ / "a.ply");
  const std::size_t begin = bytes.find("end_header\n") + 11;
  float quality = 0;
  std::memcpy(&quality, bytes.data() + begin + 24, 4);
  EXPECT_EQ(quality, 1.5f);
  EXPECT_EQ(bytes.substr(begin + 28, 3), "\x01\x02\x03");
  const Result<MeshFile> file = readMesh(folder_ / "a.ply");
  ASSERT_TRUE(file);
  expectSameBits(mesh, file->mesh);
  EXPECT_FALSE(writeMesh(mesh, folder_ / "b.ply", {.vertexQualities = std::span(qualities).first(1)}));
  EXPECT_FALSE(fs::exists(folder_ / "b.ply"));
}

TEST_F(PlyWrite, BreaksLongCommentsThatMeshLabWouldRefuse) {
  std::string wkt = "PROJCRS[\"";
  for (int i = 0; i < 300; ++i) wkt += i % 3 == 0 ? "\xC3\xA9" : i % 3 == 1 ? "  " : "wkt";
  wkt += "\"]";
  ASSERT_TRUE(writeMesh(awkward(), folder_ / "a.ply", {.crsWkt = wkt, .notes = {std::string(5000, 'n')}}));
  const Result<MeshFile> file = readMesh(folder_ / "a.ply");
  ASSERT_TRUE(file) << file.error().describe();
  EXPECT_EQ(file->crsWkt, wkt);
  std::string header = contents(folder_ / "a.ply");
  header.resize(header.find("end_header"));
  for (std::size_t at = 0, end = 0; (end = header.find('\n', at)) != std::string::npos; at = end + 1) {
    EXPECT_LT(end - at, 300u);
    EXPECT_NE(static_cast<unsigned char>(header[at]) & 0xC0, 0x80);
    EXPECT_NE(header[end - 1], '\xC3');
  }
}

TEST_F(PlyWrite, PutsAWktOfSeveralLinesOnOne) {
  ASSERT_TRUE(writeMesh(awkward(), folder_ / "a.ply", {.crsWkt = "PROJCRS[\"a\",\r\n    ID[1],\n\n  X]\n"}));
  EXPECT_EQ(readMesh(folder_ / "a.ply")->crsWkt, "PROJCRS[\"a\", ID[1], X]");
}

}  // namespace
}  // namespace arete

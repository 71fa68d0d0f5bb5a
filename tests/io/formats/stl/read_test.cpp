// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/stl/stl.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <random>

#include "io/mesh_fixture.h"

namespace arete {
namespace {

using namespace test;

/// A binary STL made by hand.
std::string binaryStl(const std::string& header, const std::vector<std::array<float, 9>>& triangles,
                      std::uint32_t claimed) {
  std::string bytes = header;
  bytes.resize(80, '\0');
  bytes.append(reinterpret_cast<const char*>(&claimed), 4);
  for (const auto& t : triangles) {
    bytes.append(12, '\x7F');  // a normal that is nonsense
    bytes.append(reinterpret_cast<const char*>(t.data()), 36);
    bytes.append(2, '\x11');
  }
  return bytes;
}

const std::vector<std::array<float, 9>> kTwo = {{0, 0, 1, 1, 0, 2, 0, 1, 3}, {0, 1, 3, 1, 0, 2, 1, 1, 4}};
const std::vector<std::array<std::uint32_t, 3>> kTwoTriangles = {{0, 1, 2}, {2, 1, 3}};

TEST(StlRead, RoundTripsEveryFamilyWithinItsOwnRounding) {
  const TemporaryFolder folder;
  for (const RasterFamily& family : rasterFamilies()) {
    SCOPED_TRACE(family.name);
    const RasterHeightfield field = family.make(40, 33, 3);
    const TriangleMesh mesh = gridMesh(field);
    const std::string path = folder.file("a.stl");
    ASSERT_TRUE(writeMesh(mesh, path, {.crsWkt = "X", .verticalUnit = "metre"}));
    EXPECT_EQ(std::filesystem::file_size(path), 84 + 50 * mesh.triangles.size());
    const Result<MeshFile> file = readMesh(path);
    ASSERT_TRUE(file) << file.error().describe();
    EXPECT_TRUE(file->mesh.validate());
    // Parts that touch at a vertex alone are not joined there.
    EXPECT_GE(file->mesh.positions.size(), mesh.positions.size());
    EXPECT_LE(file->mesh.positions.size(), mesh.positions.size() + 1);
    expectSameTriangles(mesh, file->mesh, file->frame.rounding);
    ASSERT_TRUE(file->frame.origin);
    EXPECT_EQ(file->up, MeshUp::z);
    EXPECT_EQ(file->crsWkt, "");
    EXPECT_EQ(file->verticalUnit, "");
    const Vec2 step{std::hypot(field.georeference.geoTransform[1], field.georeference.geoTransform[4]),
                    std::hypot(field.georeference.geoTransform[2], field.georeference.geoTransform[5])};
    EXPECT_LT(file->frame.rounding.x, 1e-4 * (step.x + step.y));
    EXPECT_LT(file->frame.rounding.y, 1e-4 * (step.x + step.y));
  }
}

TEST(StlRead, HoldsAGridOfWholePixelsExactly) {
  const TemporaryFolder folder;
  RasterHeightfield field = rasterFamilies().front().make(50, 41, 7);
  field.georeference.geoTransform = {376298.5, 30, 0, 3807932.25, 0, -30};
  for (double& z : field.heights) z = std::round(z * 10);
  const TriangleMesh mesh = gridMesh(field);
  ASSERT_TRUE(writeMesh(mesh, folder.file("a.stl")));
  const Result<MeshFile> file = readMesh(folder.file("a.stl"));
  ASSERT_TRUE(file);
  expectSameTriangles(mesh, file->mesh, {0, 0, 0});
}

TEST(StlRead, IsTheSameBytesAgainOnceItWasRead) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = gridMesh(rasterFamilies().front().make(20, 20, 1));
  ASSERT_TRUE(writeMesh(mesh, folder.file("a.stl")));
  ASSERT_TRUE(writeMesh(readMesh(folder.file("a.stl"))->mesh, folder.file("b.stl")));
  EXPECT_EQ(bytesOf(folder.file("a.stl")), bytesOf(folder.file("b.stl")));
}

TEST(StlRead, SaysItsOriginAndNeverSolid) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = {{{-117.1, 34.2, 5}, {-117.0, 34.2, 6}, {-117.0, 34.3, 7}}, {{0, 1, 2}}};
  ASSERT_TRUE(writeMesh(mesh, folder.file("a.stl")));
  const std::string bytes = bytesOf(folder.file("a.stl"));
  EXPECT_EQ(bytes.substr(0, 28), "arete origin -117.1 34.2 0  ");
  float normal[3];
  std::memcpy(normal, bytes.data() + 84, 12);
  EXPECT_NEAR(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2], 1, 1e-6);
  EXPECT_GT(normal[2], 0);
}

TEST(StlRead, ReadsForeignBinaryFilesAlsoThoseThatBeginWithSolid) {
  const TemporaryFolder folder;
  for (const char* header : {"solid made by a program that knows no better", "COLOR=", "", "arete"}) {
    const Result<MeshFile> file = readMesh(folder.write("a.stl", binaryStl(header, kTwo, 2)));
    ASSERT_TRUE(file) << file.error().describe();
    EXPECT_EQ(file->mesh.triangles, kTwoTriangles);
    EXPECT_EQ(file->mesh.positions, (std::vector<Vec3>{{0, 0, 1}, {1, 0, 2}, {0, 1, 3}, {1, 1, 4}}));
    EXPECT_FALSE(file->frame.origin);
  }
}

TEST(StlRead, ReadsAsciiFiles) {
  const TemporaryFolder folder;
  const std::string facet = "facet normal nan 0 1\n outer loop\n";
  const std::string one = facet + "vertex 0 0 1\nvertex 1 -0 2.0e0\nvertex 0 1 3\nendloop\nendfacet\n";
  const std::string two = facet + "vertex 0 1 3\nvertex +1 0 2\nvertex 1 1 4\nendloop\nendfacet\n";
  std::string shouted = "\n SOLID x\n" + one + two + "ENDSOLID";
  for (char& c : shouted)
    if (c >= 'a' && c <= 'z' && c != 'e') c = static_cast<char>(c - 32);
  std::string crlf;
  for (const char c : "solid\n" + one + two + "endsolid\n")
    crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  for (const std::string& text : {"solid a name of words\n" + one + two + "endsolid a name\n",
                                  "solid\n" + one + two + "end solid", shouted, crlf}) {
    const Result<MeshFile> file = readMesh(folder.write("a.stl", text));
    ASSERT_TRUE(file) << file.error().describe();
    EXPECT_EQ(file->mesh.triangles, kTwoTriangles);
    EXPECT_EQ(file->mesh.positions.size(), 4u);
  }
}

TEST(StlRead, NamesWhatIsWrongInAnAsciiFile) {
  const TemporaryFolder folder;
  const std::string head = "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n";
  const std::string whole = head + "vertex 0 1 0\nendloop\nendfacet\nendsolid\n";
  ASSERT_TRUE(readMesh(folder.write("a.stl", whole)));
  for (std::size_t length = 6; length < whole.size() - 1; ++length)
    EXPECT_EQ(refusal(folder.write("a.stl", whole.substr(0, length))).code, ErrorCode::corrupt) << length;
  for (const char* rest : {"vertex 0 1 nan", "vertex 0 1 inf", "vertex 0 1 1e999", "vertex 0 1 x",
                           "vertex 0 1", "vertex 0 1 0\nvertex 1 1 1", "endloop", "vertices 0 1 0"}) {
    const Error error = refusal(folder.write("a.stl", head + rest + "\nendloop\nendfacet\nendsolid\n"));
    EXPECT_EQ(error.code, ErrorCode::corrupt);
    EXPECT_NE(error.message.find("line "), std::string::npos) << error.message;
  }
  EXPECT_EQ(refusal(folder.write("a.stl", "solid\nendsolid\n")).code, ErrorCode::unsupported);
}

TEST(StlRead, RefusesABinaryFileCutAtAnyByte) {
  const TemporaryFolder folder;
  for (const char* header : {"arete origin 1 2 0 ", "other"}) {
    const std::string whole = binaryStl(header, kTwo, 2);
    for (std::size_t length = 0; length < whole.size(); ++length)
      EXPECT_EQ(refusal(folder.write("a.stl", whole.substr(0, length))).code, ErrorCode::corrupt) << length;
  }
}

TEST(StlRead, LeavesOutBytesBehindTheTrianglesOfABinaryFile) {
  const TemporaryFolder folder;
  // "solid" begins the headers of some binary files; what lies behind may be anything.
  for (const char* header : {"arete origin 1 2 0 ", "other", "solid part", "SOLID part\n facet normal"})
    for (const std::string& spare :
         {std::string("x"), std::string(6, '\0'), std::string(" endsolid"), std::string(133, 'z')}) {
      const std::string whole = binaryStl(header, kTwo, 2);
      const Result<MeshFile> exact = readMesh(folder.write("a.stl", whole));
      const Result<MeshFile> longer = readMesh(folder.write("b.stl", whole + spare));
      ASSERT_TRUE(exact && longer) << header << spare;
      EXPECT_EQ(longer->mesh.positions, exact->mesh.positions);
      EXPECT_EQ(longer->mesh.triangles, exact->mesh.triangles);
      EXPECT_TRUE(exact->warnings.empty());
      ASSERT_EQ(longer->warnings.size(), 1u);
      EXPECT_NE(longer->warnings[0].sentence.find(std::to_string(spare.size()) +
                                                  (spare.size() == 1 ? " byte is" : " bytes are")),
                std::string::npos);
    }
  // Whole records more than the header states: the header is wrong, and which it meant is not known.
  EXPECT_EQ(refusal(folder.write("a.stl", binaryStl("solid x", kTwo, 1))).code, ErrorCode::corrupt);
}

TEST(StlRead, ReadsTextInUtf16AndWithReturns) {
  const TemporaryFolder folder;
  const std::string text =
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1\nvertex 1 0 2\nvertex 0 1 3\n"
      "endloop\nendfacet\nendsolid a\n";
  std::string wide = "\xFF\xFE", returns = text;
  for (const char c : text) wide += std::string{c, '\0'};
  std::ranges::replace(returns, '\n', '\r');
  for (const std::string& bytes : {wide, returns, "\xEF\xBB\xBF" + text}) {
    const Result<MeshFile> file = readMesh(folder.write("a.stl", bytes));
    ASSERT_TRUE(file) << file.error().describe();
    EXPECT_EQ(file->mesh.triangles.size(), 1u);
  }
}

TEST(StlRead, BelievesNoHeader) {
  const TemporaryFolder folder;
  for (const std::uint32_t count : {0U, 1U, 3U, 0x7FFFFFFFU, 0xFFFFFFFFU})
    EXPECT_EQ(refusal(folder.write("a.stl", binaryStl("x", kTwo, count))).code, ErrorCode::corrupt) << count;
  EXPECT_EQ(refusal(folder.write("a.stl", binaryStl("x", {}, 0))).code, ErrorCode::unsupported);
  for (const char* origin : {"arete origin", "arete origin ", "arete origin 1 2", "arete origin 1 2 nan",
                             "arete origin 1 2 inf", "arete origin 1 2 3x", "arete origin 1 2 1e400"}) {
    const auto read = readMesh(folder.write("a.stl", binaryStl(origin, kTwo, 2)));
    EXPECT_EQ(bool(read), std::string_view(origin) == "arete origin") << origin;
  }
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
    auto triangles = kTwo;
    triangles[1][4] = bad;
    const Error error = refusal(folder.write("a.stl", binaryStl("x", triangles, 2)));
    EXPECT_EQ(error.code, ErrorCode::corrupt);
    EXPECT_NE(error.message.find("triangle 1 of 2"), std::string::npos) << error.message;
  }
}

TEST(StlRead, SurvivesAnyDamagedByte) {
  const TemporaryFolder folder;
  const std::string binary = binaryStl("arete origin 10 20 0 ", kTwo, 2);
  const std::string ascii =
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
      "0\nendloop\nendfacet\nendsolid\n";
  std::mt19937 random(4);
  for (const std::string& whole : {binary, ascii})
    for (std::size_t i = 0; i < whole.size(); ++i)
      for (const int flip : {0x01, 0x90}) {
        std::string damaged = whole;
        damaged[i] = static_cast<char>(damaged[i] ^ flip);
        if (random() % 4 == 0) damaged[random() % damaged.size()] = static_cast<char>(random());
        const Result<MeshFile> file = readMesh(folder.write("a.stl", damaged));
        EXPECT_TRUE(!file || file->mesh.validate());
      }
}

TEST(StlRead, ReadsTheMeshOfAnother) {
  const std::string path = realData("meshes/featuretype.STL");
  if (path.empty()) GTEST_SKIP() << "the meshes of others are not here; ARETE_DATA names their folder";
  const Result<MeshFile> file = readMesh(path);
  ASSERT_TRUE(file) << file.error().describe();
  EXPECT_EQ(file->mesh.triangles.size(), 3476u);
  EXPECT_EQ(file->mesh.positions.size(), 2010u);
}

TEST(StlRead, RefusesToWriteWhatFloatsCannotHoldAndLeavesNothing) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = {{{0, 0, 0}, {1e39, 0, 0}, {0, 1e39, 0}}, {{0, 1, 2}}};
  EXPECT_EQ(writeMesh(mesh, folder.file("a.stl")).error().code, ErrorCode::invalidData);
  EXPECT_EQ(writeMesh(TriangleMesh{{{0, 0, 0}}, {{0, 0, 1}}}, folder.file("a.stl")).error().code,
            ErrorCode::invalidData);
  const std::atomic<bool> stop = true;
  RunContext context;
  context.cancel = &stop;
  EXPECT_EQ(writeMesh(TriangleMesh{{{0, 0, 0}}, {{0, 0, 0}}}, folder.file("a.stl"), {}, context).error().code,
            ErrorCode::interrupted);
  EXPECT_EQ(folder.count(), 0u);
  ASSERT_TRUE(writeMesh(TriangleMesh{}, folder.file("a.stl")));
  EXPECT_TRUE(readMesh(folder.file("a.stl"))->mesh.triangles.empty());
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/off/off.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "io/mesh_file_fixture.h"

namespace arete {
namespace {

using namespace test;

using OffRead = MeshFileTest;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

const std::string kVertices = "0 0 1\n1 0 2\n1 1 3\n0 1 4\n5 5 5\n", kFaces = "4 0 1 2 3\n3 0 1 4\n";
const Triangles kRead = {{0, 1, 2}, {0, 2, 3}, {0, 1, 4}};

std::string withEach(const std::string& lines, const std::string& more) {
  std::string result;
  for (const char c : lines) result += c == '\n' ? more + "\n" : std::string(1, c);
  return result;
}

TEST_F(OffRead, ReadsTheHeadersThatProgramsWrite) {
  const std::string body = kVertices + kFaces;
  std::string oneLine = kVertices;
  std::ranges::replace(oneLine, '\n', ' ');
  for (const std::string& text :
       {"OFF\n5 2 0\n" + body, "OFF 5 2 0\n" + body, "OFF5 2 0\n" + body, "off\n5 2\n" + body,
        "5 2 6\n" + body, "OFF\n5\n2\n6\n" + body, "OFF\n5 2\n0\n" + body,
        "# first\n\nOFF # keyword\n\n5 2 0 # counts\n\n" + body + "\n# last",
        "OFF\n5 2 0\n# vertices\n" + kVertices + "\n# faces\n\n" + kFaces,
        // colours, normals, texture coordinates: by the keyword, or without it
        "COFF\n5 2 0\n" + withEach(kVertices, " 255 0 0 255") + withEach(kFaces, " 0.5 0.5 1"),
        "OFF\n5 2 0\n" + withEach(kVertices, " 255 0 0 255") + withEach(kFaces, " 7"),
        "STCNOFF\n5 2 0\n" + withEach(kVertices, " 1 2 3 4 5 6 7 8 9"),  // the faces follow below
        "NOFF 5 2 0\n0 0 1 0 0 1 1 0 2 0 0 1 1 1 3 0 0 1 0 1 4 0 0 1 5 5 5 0 0 1\n" + kFaces,
        "OFF 5 2 0\n" + oneLine + "\n" + kFaces}) {
    const bool isWhole = text.find("4 0 1 2 3") != std::string::npos;
    const std::string whole = isWhole ? text : text + kFaces;
    std::string crlf, returns = whole;
    for (const char c : whole) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
    std::ranges::replace(returns, '\n', '\r');
    for (const std::string& bytes : {whole, crlf, returns}) {
      const Result<MeshFile> file = readMesh(put("a.off", bytes));
      ASSERT_TRUE(file) << whole << file.error().describe();
      ASSERT_EQ(file->mesh.positions.size(), 5u) << whole;
      EXPECT_EQ(file->mesh.positions[3], (Vec3{0, 1, 4})) << whole;
      EXPECT_EQ(file->mesh.triangles, kRead) << whole;
      // Colours that the keyword does not state, and those of a map that the file does not have.
      EXPECT_EQ(file->warnings.size(), whole.find(" 7\n") == std::string::npos ? 0u : 2u) << whole;
    }
  }
}

TEST_F(OffRead, NamesWhatItDoesNotRead) {
  const auto expect = [&](ErrorCode code, const std::string& said, const std::string& text) {
    const Error error = refusal("a.off", text);
    EXPECT_EQ(error.code, code) << text << error.message;
    EXPECT_NE(error.message.find(said), std::string::npos) << text << error.message;
  };
  using enum ErrorCode;
  const std::string start = "OFF\n3 1 0\n0 0 0\n1 0 0\n";
  expect(unsupported, "\"4OFF\"", "4OFF\n3 1 0\n");
  expect(unsupported, "\"nOFF\"", "nOFF 2\n3 1 0\n");
  expect(unsupported, "no face", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n");
  expect(corrupt, "first line", "XOFF\n3 1 0\n");
  expect(corrupt, "first line", "ply\n");
  expect(corrupt, "counts", "");
  expect(corrupt, "counts", "OFF\n");
  expect(corrupt, "counts", "OFF\n3 x\n");
  expect(corrupt, "do not fit", "OFF\n4000000000 1 0\n" + start);
  expect(corrupt, "line 5", start + "0 1 x\n3 0 1 2\n");
  expect(corrupt, "not finite", start + "0 1 nan\n3 0 1 2\n");
  expect(corrupt, "names vertex 3 of 3", start + "0 1 0\n3 0 1 3\n");
  expect(corrupt, "whole number", start + "0 1 0\n3 0 1 -1\n");
  expect(corrupt, "more than the file", start + "0 1 0\n300 0 1 2\n");
  const Result<MeshFile> small =
      readMesh(put("a.off", "OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n3 0 1 2\n1 2\n"));
  ASSERT_TRUE(small);
  EXPECT_EQ(small->mesh.triangles.size(), 1u);
  ASSERT_EQ(small->warnings.size(), 1u);
  EXPECT_NE(small->warnings[0].sentence.find("2 faces"), std::string::npos);
  // Cut short within the vertices or the faces.
  const std::string whole = "OFF\n5 2 0\n" + kVertices + kFaces;
  for (std::size_t length = 0; length + 2 < whole.size(); ++length)
    EXPECT_EQ(refusal("cut.off", whole.substr(0, length)).code, corrupt) << length;
}

TEST_F(OffRead, ReturnsWhatIsWrittenToTheBit) {
  TriangleMesh mesh = awkward();
  for (std::size_t triangles : {2u, 0u}) {
    mesh.triangles.resize(triangles);
    ASSERT_TRUE(
        writeMesh(mesh, folder_ / "a.off", {.crsWkt = kWkt, .verticalUnit = "metre", .notes = {"a note"}}));
    const Result<MeshFile> file = readMesh(folder_ / "a.off");
    ASSERT_TRUE(file) << file.error().describe();
    expectSameBits(file->mesh, mesh);
    EXPECT_EQ(file->crsWkt, kWkt);
    EXPECT_EQ(file->verticalUnit, "metre");
    const std::string whole = contents(folder_ / "a.off");
    for (std::size_t length = 0; length + 1 < whole.size(); ++length)
      EXPECT_EQ(refusal("cut.off", whole.substr(0, length)).code, ErrorCode::corrupt) << length;
  }
}

TEST_F(OffRead, SurvivesAnyDamagedByte) {
  ASSERT_TRUE(writeMesh(awkward(), folder_ / "whole.off", {.crsWkt = "X"}));
  const std::string whole = contents(folder_ / "whole.off");
  for (std::size_t i = 0; i < whole.size(); ++i)
    for (const int flip : {0x01, 0x94}) {
      std::string damaged = whole;
      damaged[i] = static_cast<char>(damaged[i] ^ flip);
      const Result<MeshFile> file = readMesh(put("damaged.off", damaged));
      EXPECT_TRUE(!file || file->mesh.validate());
    }
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/obj/obj.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/io_fixture.h"
#include "io/mesh_file_fixture.h"

namespace arete {
namespace {

using namespace test;

using ObjRead = MeshFileTest;

TEST_F(ObjRead, ReadsAForeignFile) {
  const std::string obj =
      "\xEF\xBB\xBF# a comment \\\nmtllib C:\\a\\\no thing\n  v 0 0 1\nv\t1 0 2 1.0\nv 1 1 3 0.5 0.5 0.5\nv "
      "0 1 +4e0 # top\n"
      "vt 0 0\nvn 0 0 1\n\nusemtl \xC3\xA9t\xC3\xA9\ns off\ng a b\n"
      "f 1/1/1 2/1/1 3/1/1 4/1/1\nf -4//1 -3//1 -1//1\nf 1/1 \\\n 2/1 5/1\nl 1 2\nv 5 5 5\nf 1 3 5";
  const std::vector<std::array<std::uint32_t, 3>> triangles = {
      {0, 1, 2}, {0, 2, 3}, {0, 1, 3}, {0, 1, 4}, {0, 2, 4}};
  std::string crlf;
  for (const char c : obj) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  for (const std::string& text : {obj, obj + "\n", crlf}) {
    const Result<MeshFile> file = readMesh(put("a.obj", text));
    ASSERT_TRUE(file) << file.error().describe();
    ASSERT_EQ(file->mesh.positions.size(), 5u);
    EXPECT_EQ(file->mesh.positions[3], (Vec3{0, 1, 4}));
    EXPECT_EQ(file->mesh.triangles, triangles);
  }
}

TEST_F(ObjRead, ReadsUtf16AndReturns) {
  const std::string text = "# a\nv 0 0 1\nv 1 0 2\nv 0 1 3\nf 1 2 3\n";
  std::vector<std::string> files = {text};
  std::ranges::replace(files[0], '\n', '\r');
  for (const std::string mark : {"\xFF\xFE", "\xFE\xFF", ""}) {
    std::string wide = mark;
    for (const char c : text) wide += mark == "\xFE\xFF" ? std::string{'\0', c} : std::string{c, '\0'};
    files.push_back(wide);
  }
  for (const std::string& bytes : files) {
    const Result<MeshFile> file = readMesh(put("a.obj", bytes));
    ASSERT_TRUE(file) << file.error().describe();
    EXPECT_EQ(file->mesh.positions, (std::vector<Vec3>{{0, 0, 1}, {1, 0, 2}, {0, 1, 3}}));
    EXPECT_EQ(file->mesh.triangles.size(), 1u);
  }
}

TEST_F(ObjRead, RefusesWhatMakesNoSense) {
  const std::string start = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_TRUE(readMesh(put("a.obj", start + "f 1 2 3\n")));
  for (const char* line : {"f 1 2 0",
                           "f 1 2 4",
                           "f 1 2 -4",
                           "f 1 2 x",
                           "f 1 2 3x",
                           "f 1 2 3.5",
                           "f 1 2 99999999999999999999",
                           "f 1 2 -9223372036854775808",
                           "v 1 2",
                           "v 1 2 x",
                           "f 1/x 2 3",
                           "f 1/2/3/4 2 3",
                           "v 1 2 nan\nf 1 2 4",
                           "v 1 2 inf\nf 1 2 4",
                           "v 1 2 3 x",
                           "vt",
                           "vt 0 x",
                           "vn 0 1",
                           "vn 0 0 x",
                           "{\"json\": 1}",
                           "<xml/>"}) {
    const Error error = refusal("a.obj", start + line + "\nf 1 2 3\n");
    EXPECT_EQ(error.code, ErrorCode::corrupt);
    EXPECT_NE(error.message.find("line 4"), std::string::npos) << error.message;
  }
  EXPECT_EQ(refusal("a.obj", "").code, ErrorCode::corrupt);
  EXPECT_EQ(refusal("a.obj", "hello world\n").code, ErrorCode::corrupt);
  EXPECT_EQ(refusal("a.obj", std::string("\0\0\0\0", 4)).code, ErrorCode::corrupt);
  EXPECT_EQ(refusal("a.obj", start).code, ErrorCode::unsupported);
}

TEST_F(ObjRead, NoticesThatAFileOfOursIsCutShort) {
  ASSERT_TRUE(writeMesh(awkward(), folder_ / "whole.obj", {.crsWkt = kWkt}));
  const std::string whole = contents(folder_ / "whole.obj");
  for (std::size_t length = 0; length + 1 < whole.size(); ++length) {
    SCOPED_TRACE(length);
    EXPECT_EQ(refusal("cut.obj", whole.substr(0, length)).code, ErrorCode::corrupt);
  }
}

TEST_F(ObjRead, SurvivesAnyDamagedByte) {
  ASSERT_TRUE(writeMesh(awkward(), folder_ / "whole.obj", {.crsWkt = "X"}));
  const std::string whole = contents(folder_ / "whole.obj");
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (const int flip : {0x01, 0x94}) {
      std::string damaged = whole;
      damaged[i] = static_cast<char>(damaged[i] ^ flip);
      const Result<MeshFile> file = readMesh(put("damaged.obj", damaged));
      EXPECT_TRUE(!file || file->mesh.validate());
    }
  }
}

TEST_F(ObjRead, ReadsTheMeshesOfOthers) {
  const fs::path meshes = test::realDataFolder() / "meshes";
  if (!fs::is_directory(meshes))
    GTEST_SKIP() << "the meshes of others are not here; ARETE_DATA names their folder";
  struct Known {
    const char* name;
    std::size_t vertices, triangles;
    std::size_t wedges;  // distinct corners by value, counted by a script
  };
  for (const Known& known :
       {Known{"fuze.obj", 502, 1000, 664}, Known{"pirate.obj", 2889, 5010, 3156},
        Known{"self_intersectA.obj", 8582, 17160, 0}, Known{"spot.obj", 2930, 5856, 3225}}) {
    const Result<MeshFile> file = readMesh(meshes / known.name);
    ASSERT_TRUE(file) << file.error().describe();
    EXPECT_EQ(file->mesh.positions.size(), known.vertices) << known.name;
    EXPECT_EQ(file->mesh.triangles.size(), known.triangles) << known.name;
    EXPECT_TRUE(file->mesh.validate());
    EXPECT_EQ(file->mesh.wedgeCount, known.wedges) << known.name;
    ASSERT_TRUE(writeMesh(file->mesh, folder_ / "copy.obj"));
    const Result<MeshFile> copy = readMesh(folder_ / "copy.obj");
    ASSERT_TRUE(copy) << copy.error().describe();
    SurfaceMesh expected = file->mesh;
    expected.faceOf.clear();  // triangles are the faces now
    EXPECT_EQ(copy->mesh.wedgeAttributes, expected.wedgeAttributes) << known.name;
    EXPECT_EQ(copy->mesh.materials, expected.materials) << known.name;
    EXPECT_EQ(copy->mesh, expected) << known.name;
    ASSERT_TRUE(writeMesh(file->mesh, folder_ / "copy.ply"));
    expectSameBits(readMesh(folder_ / "copy.ply")->mesh, file->mesh);
  }
}

}  // namespace
}  // namespace arete

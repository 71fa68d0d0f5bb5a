// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/ply/ply.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "io/io_fixture.h"
#include "io/mesh_file_fixture.h"

namespace arete {
namespace {

using namespace test;

using PlyRead = MeshFileTest;

TEST_F(PlyRead, ReadsAForeignAsciiFile) {
  const std::string ply =
      "ply\nformat ascii 1.0\ncomment made by hand\nobj_info something\ncomment crs LOCAL_CS[\"x\"]\n"
      "element material 2\nproperty uchar red\nproperty list uchar float weights\n"
      "element vertex 5\nproperty uchar flag\nproperty float z\nproperty list char int neighbours\n"
      "property double x\nproperty short y\n"
      "element empty 99999999999999\n"
      "element face 2\nproperty float quality\nproperty list uint8 uint32 vertex_index\nproperty uchar red\n"
      "element edge 1\nproperty int a\nproperty int b\nend_header\n"
      "255 2 0.5 1e3\n0 0\n"
      "1 10.5 2 7 8 0.25 -3\n1 11 0 1 0\n1 12 1 4 1 1\n1 13\n0 0 1\n1 14 0 -1 +1\n"
      "0.5 4 0 1 2 3 9\n0.25 3 4 3 0 9\n7 8";
  const Result<MeshFile> file = readMesh(put("a.ply", ply));
  ASSERT_TRUE(file) << file.error().describe();
  EXPECT_EQ(file->crsWkt, "LOCAL_CS[\"x\"]");
  ASSERT_EQ(file->mesh.positions.size(), 5u);
  EXPECT_EQ(file->mesh.positions[0], (Vec3{0.25, -3, 10.5}));
  EXPECT_EQ(file->mesh.positions[4], (Vec3{-1, 1, 14}));
  const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}, {0, 2, 3}, {4, 3, 0}};
  EXPECT_EQ(file->mesh.triangles, triangles);

  std::string crlf;
  for (const char c : ply) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  EXPECT_EQ(readMesh(put("crlf.ply", crlf))->mesh.triangles, triangles);
}

/// Appends numbers in either byte order.
class Bytes {
 public:
  explicit Bytes(bool big) : big_(big) {}
  template <class T>
  Bytes& add(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if (big_ != (std::endian::native == std::endian::big)) std::reverse(bytes, bytes + sizeof(T));
    text.append(bytes, sizeof(T));
    return *this;
  }
  std::string text;

 private:
  bool big_;
};

TEST_F(PlyRead, ReadsForeignBinaryFilesOfBothByteOrders) {
  for (const bool big : {false, true}) {
    for (const char* newline : {"\n", "\r\n"}) {
      std::string header;
      for (const char* line :
           {"ply", big ? "format binary_big_endian 1.0" : "format binary_little_endian 1.0",
            "element vertex 4", "property float x", "property float nx", "property int y",
            "property double z", "element strange 2", "property list ushort double junk", "property char c",
            "element face 2", "property list ushort short vertex_indices", "property uint id", "end_header"})
        header += std::string(line) + newline;
      Bytes body(big);
      for (int v = 0; v < 4; ++v) body.add(float(v) + 0.5f).add(0.f).add(std::int32_t(-v)).add(double(v) / 3);
      body.add(std::uint16_t(2))
          .add(1.0)
          .add(2.0)
          .add(std::int8_t(1))
          .add(std::uint16_t(0))
          .add(std::int8_t(2));
      body.add(std::uint16_t(3));
      for (const int v : {0, 1, 2}) body.add(std::int16_t(v));
      body.add(std::uint32_t(77)).add(std::uint16_t(4));
      for (const int v : {3, 2, 1, 0}) body.add(std::int16_t(v));
      body.add(std::uint32_t(78));
      const Result<MeshFile> file = readMesh(put("a.ply", header + body.text));
      ASSERT_TRUE(file) << file.error().describe();
      EXPECT_EQ(file->mesh.positions[3], (Vec3{3.5, -3, 1}));
      const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}, {3, 2, 1}, {3, 1, 0}};
      EXPECT_EQ(file->mesh.triangles, triangles);
    }
  }
}

TEST_F(PlyRead, RefusesAFileCutAtAnyByte) {
  ASSERT_TRUE(writeMesh(awkward(), folder_ / "whole.ply",
                        {.crsWkt = kWkt, .triangleErrors = std::vector<float>{1, 2}}));
  const std::string whole = contents(folder_ / "whole.ply");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    SCOPED_TRACE(length);
    EXPECT_EQ(refusal("cut.ply", whole.substr(0, length)).code, ErrorCode::corrupt);
  }
}

TEST_F(PlyRead, SurvivesAnyDamagedByte) {
  ASSERT_TRUE(writeMesh(awkward(), folder_ / "whole.ply", {.crsWkt = "X"}));
  const std::string whole = contents(folder_ / "whole.ply");
  const std::string ascii =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 1\n1 0 2\n0 1 3\n3 0 1 2\n";
  std::mt19937 random(4);
  for (const std::string& text : {whole, ascii}) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      for (const int flip : {0x01, 0x90}) {
        std::string damaged = text;
        damaged[i] = static_cast<char>(damaged[i] ^ flip);
        if (random() % 4 == 0) damaged[random() % damaged.size()] = static_cast<char>(random());
        const Result<MeshFile> file = readMesh(put("damaged.ply", damaged));
        EXPECT_TRUE(!file || file->mesh.validate());
      }
    }
  }
  // A text that is cut may still make sense; it must not make trouble.
  for (std::size_t length = 0; length < ascii.size(); ++length) {
    const Result<MeshFile> file = readMesh(put("cut.ply", ascii.substr(0, length)));
    EXPECT_TRUE(!file || file->mesh.validate());
  }
}

TEST_F(PlyRead, BelievesNoHeader) {
  const std::string vertex = "property double x\nproperty double y\nproperty double z\n";
  const std::string face = "property list uchar int vertex_indices\n";
  const auto ply = [&](const std::string& format, const std::string& rest, const std::string& body = "") {
    return "ply\nformat " + format + " 1.0\n" + rest + "end_header\n" + body;
  };
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const char* count :
         {"4294967294", "4294967295", "18446744073709551615", "99999999999999999999999", "-1", "1e3"}) {
      refusal("a.ply", ply(format, std::string("element vertex ") + count + "\n" + vertex +
                                       "element face 0\n" + face));
      refusal("a.ply", ply(format, "element vertex 0\n" + vertex + "element face " + count + "\n" + face));
      refusal("a.ply",
              ply(format, std::string("element x ") + count + "\nproperty char c\nelement vertex 1\n" +
                              vertex + "element face 0\n" + face));
      // The faces before the vertices that they name.
      refusal("a.ply", ply(format,
                           "element face 1\nproperty list uchar double vertex_indices\nelement vertex " +
                               std::string(count) + "\n" + vertex,
                           "3 5e9 5e9 5e9"));
    }
  }
  // A list that claims to be longer than the file.
  EXPECT_NE(refusal("a.ply", ply("binary_little_endian",
                                 "element vertex 0\n" + vertex +
                                     "element face 1\nproperty list uint int vertex_indices\n",
                                 std::string("\xff\xff\xff\xff") + std::string(16, '\0')))
                .message.find("face 0 of 1"),
            std::string::npos);
  refusal("a.ply",
          ply("ascii", "element vertex 1\n" + vertex + "element face 1\n" + face, "0 0 0 1e18 0 0 0 0"));
  refusal("a.ply",
          ply("ascii", "element vertex 1\n" + vertex + "element face 1\n" + face, "0 0 0 -3 0 0 0 0"));
  refusal("a.ply",
          ply("ascii", "element vertex 1\n" + vertex + "element face 1\n" + face, "0 0 0 2.5 0 0 0 0"));
  // No such vertex, no whole number, too few corners, no number, not finite.
  const std::string one = "element vertex 1\n" + vertex + "element face 1\n" + face;
  EXPECT_NE(refusal("a.ply", ply("ascii", one, "0 0 0\n3 0 0 1\n")).message.find("names vertex 1 of 1"),
            std::string::npos);
  EXPECT_NE(refusal("a.ply", ply("ascii", one, "0 0 0\n3 0 0 -1\n")).message.find("line 11"),
            std::string::npos);
  refusal("a.ply", ply("ascii", one, "0 0 0\n3 0 0 0.5\n"));
  refusal("a.ply", ply("ascii", one, "0 0 0\n2 0 0 0\n"));
  EXPECT_NE(refusal("a.ply", ply("ascii", one, "0 zero 0\n3 0 0 0\n")).message.find("vertex 0 of 1"),
            std::string::npos);
  refusal("a.ply", ply("ascii", one, "0 nan 0\n3 0 0 0\n"));
  refusal("a.ply", ply("ascii", one, "0 1e999 0\n3 0 0 0\n"));
}

TEST_F(PlyRead, FindsNamesInCapitals) {
  const std::string body = "end_header\n0 0 1\n1 0 2\n0 1 3\n3 0 1 2\n";
  for (const char* names : {"property double X\nproperty double Y\nproperty double Z\n",
                            "property float x\nproperty float Y\nproperty float Z\n"})
    for (const char* elements :
         {"vertex face vertex_indices", "VERTEX Face Vertex_Indices", "Vertex FACE vertex_Index"}) {
      std::istringstream words(elements);
      std::string vertex, face, list;
      words >> vertex >> face >> list;
      const Result<MeshFile> file =
          readMesh(put("a.ply", "ply\nformat ascii 1.0\nelement " + vertex + " 3\n" + names + "element " +
                                    face + " 1\nproperty list uchar uint " + list + "\n" + body));
      ASSERT_TRUE(file) << file.error().describe();
      EXPECT_EQ(file->mesh.positions, (std::vector<Vec3>{{0, 0, 1}, {1, 0, 2}, {0, 1, 3}}));
      EXPECT_EQ(file->mesh.triangles.size(), 1u);
    }
  // Where both are there, the small letters are meant; two of one name are none.
  const std::string both =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float X\nproperty float x\nproperty float "
      "y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n9 0 0 1\n9 1 0 2\n9 0 1 3\n3 0 1 "
      "2\n";
  EXPECT_EQ(readMesh(put("a.ply", both))->mesh.positions[1], (Vec3{1, 0, 2}));
}

TEST_F(PlyRead, LeavesOutWhatLinesHaveBeyondTheirProperties) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 2\n"
      "property list uchar int vertex_indices\nend_header\n";
  const std::vector<Vec3> positions = {{0, 0, 1}, {1, 0, 2}, {1, 1, 3}, {0, 1, 4}};
  struct Case {
    const char* body;
    const char* warning;
  };
  for (const Case& one :
       {Case{"0 0 1\n1 0 2\n1 1 3\n0 1 4\n3 0 1 2\n3 0 2 3\n", ""},
        // colours that the header does not state, in all lines or in some
        Case{"0 0 1 255 0 0\n1 0 2 255 0 0\n1 1 3 255 0 0\n0 1 4 255 0 0\n3 0 1 2\n3 0 2 3\n", "4 lines"},
        Case{"0 0 1\n1 0 2 7\n1 1 3\n0 1 4\n3 0 1 2 255 255 255\n3 0 2 3\n", "2 lines"},
        Case{"0 0 1 x\n\n1 0 2\n1 1 3\n0 1 4\n3 0 1 2\n3 0 2 3\n", "1 line has"},
        // fewer lines than records: some share one, and every value counts
        Case{"0 0 1 1 0 2\n1 1 3 0 1 4\n3 0 1 2 3 0 2 3\n", ""},
        Case{"0 0 1 1 0 2 1 1 3 0 1 4 3 0 1 2 3 0 2 3", ""},
        // records over several lines
        Case{"0\n0 1\n1 0 2\n1 1\n3\n0 1 4\n3\n0 1 2\n3 0 2 3\n", ""}}) {
    for (const bool returns : {false, true}) {
      std::string text = head + one.body;
      if (returns) std::ranges::replace(text, '\n', '\r');
      const Result<MeshFile> file = readMesh(put("a.ply", text));
      ASSERT_TRUE(file) << one.body << file.error().describe();
      EXPECT_EQ(file->mesh.positions, positions) << one.body;
      EXPECT_EQ(file->mesh.triangles.size(), 2u);
      EXPECT_EQ(file->mesh.triangles.back(), (std::array<std::uint32_t, 3>{0, 2, 3})) << one.body;
      const std::string warning = file->warnings.empty() ? "" : file->warnings[0].sentence;
      EXPECT_TRUE(*one.warning == 0 ? warning.empty() : warning.starts_with(one.warning))
          << one.body << warning;
    }
  }
  // Too few values in a line are taken from the next, so the file ends early.
  EXPECT_EQ(refusal("a.ply", head + "0 0 1\n1 0\n1 1 3\n0 1 4\n3 0 1 2\n3 0 2 3\n").code, ErrorCode::corrupt);
}

TEST_F(PlyRead, ReadsUtf16) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 1\n1 0 2\n0 1 3\n3 0 1 2\n";
  std::string wide;
  for (const char c : "\xEF\xBB\xBF" + text) wide += c;
  EXPECT_TRUE(readMesh(put("mark.ply", wide)));
  for (const std::string mark : {"\xFF\xFE", ""}) {
    wide = mark;
    for (const char c : text) wide += std::string{c, '\0'};
    const Result<MeshFile> file = readMesh(put("wide.ply", wide));
    ASSERT_TRUE(file) << file.error().describe();
    EXPECT_EQ(file->mesh.positions[2], (Vec3{0, 1, 3}));
  }
}

}  // namespace
}  // namespace arete

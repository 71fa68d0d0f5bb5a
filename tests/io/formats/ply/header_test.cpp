// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/ply/header.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/io_fixture.h"
#include "io/mesh_file_fixture.h"

namespace arete {
namespace {

using namespace test;

using PlyHeaders = MeshFileTest;

TEST(PlyHeader, IsReadWithItsElementsPropertiesAndComments) {
  const std::string text =
      "ply\nformat binary_big_endian 1.0\ncomment  two blanks\nobj_info x\ncomment\nelement vertex 12\n"
      "property double x\nproperty list uchar int16 near\nelement face 0\nend_header\nDATA";
  const Result<PlyHeader> header = parsePlyHeader(text, "a.ply");
  ASSERT_TRUE(header) << header.error().describe();
  EXPECT_EQ(header->format, PlyFormat::bigEndian);
  EXPECT_EQ(header->comments, (std::vector<std::string>{" two blanks", ""}));
  EXPECT_EQ(text.substr(header->dataBegin), "DATA");
  ASSERT_EQ(header->elements.size(), 2u);
  const PlyElement& vertex = header->elements[0];
  EXPECT_EQ(vertex.name, "vertex");
  EXPECT_EQ(vertex.count, 12u);
  ASSERT_EQ(vertex.properties.size(), 2u);
  EXPECT_EQ(vertex.properties[0].type, PlyType::float64);
  EXPECT_FALSE(vertex.properties[0].isList);
  EXPECT_EQ(vertex.properties[1].name, "near");
  EXPECT_TRUE(vertex.properties[1].isList);
  EXPECT_EQ(vertex.properties[1].countType, PlyType::uint8);
  EXPECT_EQ(vertex.properties[1].type, PlyType::int16);
}

TEST(PlyHeader, EndsLinesAsTheFirstOneDoes) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string text;
    for (const char* line : {"ply", "format ascii 1.0", "element vertex 3", "end_header"}) text += line + end;
    const Result<PlyHeader> header = parsePlyHeader(text + "\n1 2 3", "a.ply");
    ASSERT_TRUE(header) << header.error().describe();
    EXPECT_EQ(header->dataBegin, text.size());
    EXPECT_EQ(header->elements[0].count, 3u);
  }
}

TEST(PlyHeader, NamesTheFileAndTheLineThatIsWrong) {
  const Result<PlyHeader> header =
      parsePlyHeader("ply\nformat ascii 1.0\nproperty half x\nend_header\n", "a.ply");
  ASSERT_FALSE(header);
  EXPECT_EQ(header.error().culprit, "a.ply");
  EXPECT_NE(header.error().message.find("line 3"), std::string::npos) << header.error().message;
  EXPECT_EQ(
      sizeOf(PlyType::int8) + sizeOf(PlyType::uint16) + sizeOf(PlyType::float32) + sizeOf(PlyType::float64),
      15u);
}

TEST_F(PlyHeaders, ThatMakeNoSenseAreRefused) {
  const std::string vertex = "element vertex 0\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string face = "element face 0\nproperty list uchar int vertex_indices\n";
  const std::string format = "ply\nformat ascii 1.0\n";
  EXPECT_TRUE(readMesh(put("a.ply", format + vertex + face + "end_header\n")));
  for (const std::string& text :
       {std::string(), std::string("ply"), std::string("ply\n"), std::string("plywood\n"),
        "ply\n" + vertex + face, "ply\n" + vertex + face + "end_header\n",
        format + vertex + face + "end_header", format + "property float x\n" + vertex + face + "end_header\n",
        format + face + "end_header\n", format + vertex + vertex + face + "end_header\n",
        format + vertex + face + face + "end_header\n",
        "ply\nformat utf8 1.0\n" + vertex + face + "end_header\n",
        format + "format ascii 1.0\n" + vertex + face,
        format + "element vertex 1\nproperty float x\nproperty float y\nelement face 0\nend_header\n0 0\n",
        format + "element vertex 1\nproperty half x\n" + face + "end_header\n",
        format + vertex + "element face 1\nproperty list float int vertex_indices\nend_header\n",
        format + vertex + "element face 1\nproperty int vertex_indices\nend_header\n0",
        format + "nonsense\n" + vertex + face + "end_header\n",
        std::string("\x7f"
                    "ELF\0\0\0",
                    7)})
    EXPECT_EQ(refusal("a.ply", text).code, ErrorCode::corrupt) << text;
  EXPECT_EQ(refusal("a.ply", "ply\nformat ascii 2.0\n").code, ErrorCode::unsupported);
  EXPECT_EQ(refusal("a.ply", format + vertex + "end_header\n").code, ErrorCode::unsupported);
  EXPECT_EQ(refusal("a.ply", format + vertex + "element tristrips 1\nproperty int a\nend_header\n0\n").code,
            ErrorCode::corrupt);
}

}  // namespace
}  // namespace arete

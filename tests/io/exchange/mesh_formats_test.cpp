// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/exchange/mesh_formats.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>

#include "io/io_fixture.h"

namespace arete {
namespace {

namespace fs = std::filesystem;

const std::string kWkt =
    R"(PROJCRS["WGS 84 / UTM zone 11N",BASEGEOGCRS["WGS 84",ID["EPSG",4326]],ID["EPSG",32611]])";

class MeshFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("arete-mesh-" + std::to_string(::getpid()) + "-" +
                                           ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path put(const std::string& name, std::string_view text) const {
    const fs::path path = folder_ / name;
    // Cutting an old file to zero length makes some file systems wait for the disk.
    fs::remove(path);
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  static std::string contents(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
  }

  /// What reading `text` says is wrong. A culprit other than the file fails the test.
  Error refusal(const std::string& name, std::string_view text) const {
    const fs::path path = put(name, text);
    const Result<MeshFile> file = readMesh(path);
    if (file) {
      ADD_FAILURE() << "was read: " << text.substr(0, 200);
      return {};
    }
    EXPECT_EQ(file.error().culprit, path.string());
    EXPECT_FALSE(file.error().message.empty());
    return file.error();
  }

  /// A small mesh of awkward numbers.
  static TriangleMesh awkward() {
    TriangleMesh mesh;
    mesh.positions = {{376313.65545, 3807917.82763, 315.1},
                      {1.0 / 3, -0.0, 5e-324},
                      {1.7976931348623157e308, -2.2250738585072014e-308, 0.1},
                      {123456789.123456789, 1e22, -17.5}};
    mesh.triangles = {{0, 1, 2}, {2, 1, 3}};
    return mesh;
  }

  static void expectSameBits(const TriangleMesh& a, const TriangleMesh& b) {
    ASSERT_EQ(a.positions.size(), b.positions.size());
    EXPECT_TRUE(std::ranges::equal(a.positions, b.positions, [](const Vec3& p, const Vec3& q) {
      return std::memcmp(&p, &q, sizeof p) == 0;
    }));
    EXPECT_EQ(a.triangles, b.triangles);
  }

  fs::path folder_;
};

TEST_F(MeshFileTest, RoundTripsToTheBit) {
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

TEST_F(MeshFileTest, WritesTheErrorOfEachFace) {
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

TEST_F(MeshFileTest, WritesAQualityAndAColorOfEachVertex) {
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

TEST_F(MeshFileTest, BreaksLongCommentsOfAPlyThatMeshLabWouldRefuse) {
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

TEST_F(MeshFileTest, PutsAWktOfSeveralLinesOnOne) {
  ASSERT_TRUE(writeMesh(awkward(), folder_ / "a.ply", {.crsWkt = "PROJCRS[\"a\",\r\n    ID[1],\n\n  X]\n"}));
  EXPECT_EQ(readMesh(folder_ / "a.ply")->crsWkt, "PROJCRS[\"a\", ID[1], X]");
}

TEST_F(MeshFileTest, NamesTheFormatsItKnows) {
  for (const Error& error : {readMesh("model.dxf").error(), writeMesh({}, "model.dxf").error()}) {
    EXPECT_EQ(error.code, ErrorCode::unsupported);
    EXPECT_NE(error.message.find("PLY (.ply)"), std::string::npos);
    EXPECT_NE(error.message.find("OBJ (.obj)"), std::string::npos);
    EXPECT_NE(error.message.find(".dxf"), std::string::npos);
    EXPECT_EQ(error.culprit, "model.dxf");
  }
  EXPECT_EQ(readMesh("model").error().code, ErrorCode::unsupported);
  EXPECT_NE(readMesh("dem.amt").error().message.find("arete extract"), std::string::npos);
}

TEST_F(MeshFileTest, RefusesWhatIsNotThere) {
  EXPECT_EQ(readMesh(folder_ / "no.ply").error().code, ErrorCode::notFound);
  EXPECT_EQ(readMesh(folder_ / "no.obj").error().code, ErrorCode::notFound);
  fs::create_directory(folder_ / "folder.ply");
  EXPECT_EQ(readMesh(folder_ / "folder.ply").error().code, ErrorCode::unreadable);
  EXPECT_EQ(writeMesh(awkward(), folder_ / "no" / "a.ply").error().code, ErrorCode::notFound);
}

TEST_F(MeshFileTest, RefusesToWriteNonsenseAndLeavesNothing) {
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

// --- PLY
// -----------------------------------------------------------------------------------------------------------

TEST_F(MeshFileTest, ReadsAForeignAsciiPly) {
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

TEST_F(MeshFileTest, ReadsForeignBinaryPlyOfBothByteOrders) {
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

TEST_F(MeshFileTest, RefusesAPlyCutAtAnyByte) {
  ASSERT_TRUE(writeMesh(awkward(), folder_ / "whole.ply",
                        {.crsWkt = kWkt, .triangleErrors = std::vector<float>{1, 2}}));
  const std::string whole = contents(folder_ / "whole.ply");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    SCOPED_TRACE(length);
    EXPECT_EQ(refusal("cut.ply", whole.substr(0, length)).code, ErrorCode::corrupt);
  }
}

TEST_F(MeshFileTest, SurvivesAnyDamagedByteOfAPly) {
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

TEST_F(MeshFileTest, BelievesNoHeader) {
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

TEST_F(MeshFileTest, RefusesPlyHeadersThatMakeNoSense) {
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
  EXPECT_NE(refusal("a.ply", format + vertex + "element tristrips 0\nend_header\n").message.find("strips"),
            std::string::npos);
}

// --- OBJ
// -----------------------------------------------------------------------------------------------------------

TEST_F(MeshFileTest, ReadsAForeignObj) {
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

TEST_F(MeshFileTest, RefusesAnObjThatMakesNoSense) {
  const std::string start = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  EXPECT_TRUE(readMesh(put("a.obj", start + "f 1 2 3\n")));
  for (const char* line : {"f 1 2", "f", "f 1 2 0", "f 1 2 4", "f 1 2 -4", "f 1 2 x", "f 1 2 3x", "f 1 2 3.5",
                           "f 1 2 99999999999999999999", "f 1 2 -9223372036854775808", "v 1 2", "v 1 2 x",
                           "v 1 2 nan", "v 1 2 inf", "v 1 2 3 x", "{\"json\": 1}", "<xml/>"}) {
    const Error error = refusal("a.obj", start + line + "\nf 1 2 3\n");
    EXPECT_EQ(error.code, ErrorCode::corrupt);
    EXPECT_NE(error.message.find("line 4"), std::string::npos) << error.message;
  }
  EXPECT_EQ(refusal("a.obj", "").code, ErrorCode::corrupt);
  EXPECT_EQ(refusal("a.obj", "hello world\n").code, ErrorCode::corrupt);
  EXPECT_EQ(refusal("a.obj", std::string("\0\0\0\0", 4)).code, ErrorCode::corrupt);
  EXPECT_EQ(refusal("a.obj", start).code, ErrorCode::unsupported);
}

TEST_F(MeshFileTest, NoticesThatAnObjOfOursIsCutShort) {
  ASSERT_TRUE(writeMesh(awkward(), folder_ / "whole.obj", {.crsWkt = kWkt}));
  const std::string whole = contents(folder_ / "whole.obj");
  for (std::size_t length = 0; length + 1 < whole.size(); ++length) {
    SCOPED_TRACE(length);
    EXPECT_EQ(refusal("cut.obj", whole.substr(0, length)).code, ErrorCode::corrupt);
  }
}

TEST_F(MeshFileTest, SurvivesAnyDamagedByteOfAnObj) {
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

TEST_F(MeshFileTest, ReadsTheMeshesOfOthers) {
  const fs::path meshes = test::realDataFolder() / "meshes";
  if (!fs::is_directory(meshes))
    GTEST_SKIP() << "the meshes of others are not here; ARETE_DATA names their folder";
  struct Known {
    const char* name;
    std::size_t vertices, triangles;
  };
  for (const Known& known : {Known{"fuze.obj", 502, 1000}, Known{"pirate.obj", 2889, 5010},
                             Known{"self_intersectA.obj", 8582, 17160}, Known{"spot.obj", 2930, 5856}}) {
    const Result<MeshFile> file = readMesh(meshes / known.name);
    ASSERT_TRUE(file) << file.error().describe();
    EXPECT_EQ(file->mesh.positions.size(), known.vertices) << known.name;
    EXPECT_EQ(file->mesh.triangles.size(), known.triangles) << known.name;
    EXPECT_TRUE(file->mesh.validate());
    ASSERT_TRUE(writeMesh(file->mesh, folder_ / "copy.ply"));
    expectSameBits(readMesh(folder_ / "copy.ply")->mesh, file->mesh);
  }
}

}  // namespace
}  // namespace arete

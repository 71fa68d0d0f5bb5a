// SPDX-License-Identifier: GPL-3.0-or-later
//
// glTF as text: buffers in base 64 and in files beside it.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>

#include "io/formats/glb/base64.h"
#include "io/formats/glb/glb.h"
#include "io/glb_fixture.h"
#include "io/mesh_fixture.h"

namespace arete {
namespace {

using namespace test;

std::string inBase64(const std::string& bytes) {
  Base64Writer writer;
  std::string text = "data:application/octet-stream;base64,";
  writer.add(bytes, text);
  writer.finish(text);
  return text;
}

TEST(Gltf, ReadsBuffersInBase64AndInFilesBesideIt) {
  const TemporaryFolder folder;
  Foreign foreign;
  folder.write("data.bin", foreign.bytes);
  folder.write("data 10%.bin", foreign.bytes + "more");
  std::filesystem::create_directories(folder.file("below"));
  folder.write("below/data.bin", foreign.bytes);
  for (const std::string& uri : {inBase64(foreign.bytes), std::string("data.bin"), std::string("data%2Ebin"),
                                 std::string("./data.bin"), std::string("data%2010%25.bin"),
                                 // as some exporters write the name
                                 std::string("data 10%.bin"), std::string("below/data.bin")}) {
    foreign.json["buffers"][0]["uri"] = uri;
    for (const auto& [name, text] : {std::pair<std::string, std::string>{"a.gltf", foreign.json.dump(2)},
                                     {"b.glb", foreign.glb()},
                                     {"c.glb", foreign.json.dump()}}) {
      const Result<MeshFile> file = readMesh(folder.write(name, text));
      ASSERT_TRUE(file) << uri << ' ' << file.error().describe();
      EXPECT_EQ(file->mesh.positions, kTwoYUp.positions);
      EXPECT_EQ(file->mesh.triangles, kTwo.triangles);
    }
  }
  // A GLB under the other name, and two buffers.
  foreign.json["buffers"][0].erase("uri");
  EXPECT_TRUE(readMesh(folder.write("d.gltf", foreign.glb())));
  foreign.json["buffers"] = {{{"byteLength", 48}, {"uri", inBase64(foreign.bytes.substr(0, 48))}},
                             {{"byteLength", 12}, {"uri", "data.bin"}}};
  foreign.json["bufferViews"][1] = {{"buffer", 1}, {"byteLength", 12}};
  folder.write("data.bin", foreign.bytes.substr(48));
  const Result<MeshFile> file = readMesh(folder.write("e.gltf", foreign.json.dump()));
  ASSERT_TRUE(file) << file.error().describe();
  EXPECT_EQ(file->mesh.triangles, kTwo.triangles);
}

TEST(Gltf, ReachesNoFileOutsideItsFolder) {
  const TemporaryFolder folder;
  Foreign foreign;
  std::filesystem::create_directories(folder.file("inside"));
  folder.write("secret.bin", foreign.bytes);
  const std::string absolute = folder.file("secret.bin");
  for (const std::string& uri :
       {std::string("../secret.bin"), std::string("%2e%2e/secret.bin"), std::string("x/../../secret.bin"),
        std::string("..%2Fsecret.bin"), std::string("..\\secret.bin"), absolute, "file://" + absolute,
        std::string("http://localhost/secret.bin"), std::string("/vsicurl/http://localhost/x"),
        std::string("")}) {
    foreign.json["buffers"][0]["uri"] = uri;
    const Error error = refusal(folder.write("inside/a.gltf", foreign.json.dump()));
    EXPECT_EQ(error.code, ErrorCode::unsupported) << uri << error.message;
  }
}

TEST(Gltf, NamesABufferThatIsNotWhole) {
  const TemporaryFolder folder;
  const auto expect = [&](ErrorCode code, const char* said, const Json& buffer) {
    Foreign foreign;
    foreign.json["buffers"][0] = buffer;
    const Error error = refusal(folder.write("a.gltf", foreign.json.dump()));
    EXPECT_EQ(error.code, code) << error.message;
    EXPECT_NE(error.message.find(said), std::string::npos) << error.message;
  };
  using enum ErrorCode;
  const std::string bytes = Foreign{}.bytes;
  folder.write("short.bin", bytes.substr(1));
  expect(notFound, "none.bin", {{"byteLength", 60}, {"uri", "none.bin"}});
  expect(unreadable, "regular file", {{"byteLength", 60}, {"uri", "."}});
  expect(corrupt, "needs 60 bytes, \"short.bin\" has 59", {{"byteLength", 60}, {"uri", "short.bin"}});
  expect(corrupt, "needs 60 bytes", {{"byteLength", 60}, {"uri", inBase64(bytes.substr(1))}});
  expect(corrupt, "byteLength", {{"uri", inBase64(bytes)}});
  expect(corrupt, "valid base 64", {{"byteLength", 60}, {"uri", inBase64(bytes) + "!"}});
  expect(unsupported, "not of base 64", {{"byteLength", 60}, {"uri", "data:text/plain,abc"}});
  expect(corrupt, "no bytes", {{"byteLength", 60}});
  Foreign old;
  old.json["asset"]["version"] = "1.0";
  EXPECT_EQ(refusal(folder.write("a.gltf", old.json.dump())).code, unsupported);
  old = {};  // states nothing, as version 1 may
  old.json["meshes"] = {{"box", Json::object()}};
  EXPECT_EQ(refusal(folder.write("a.gltf", old.json.dump())).code, unsupported);
  const std::string whole = Foreign{}.json.dump();
  for (std::size_t length = 0; length < whole.size(); length += 7)
    EXPECT_EQ(refusal(folder.write("a.gltf", whole.substr(0, length))).code, corrupt) << length;
}

TEST(Gltf, HoldsWhatAGlbHolds) {
  const TemporaryFolder folder;
  for (std::size_t count = 0; count < 3; ++count) {
    TriangleMesh mesh = kTwo;
    mesh.triangles.resize(count);
    const std::vector<float> errors(count, 0.25F);
    const MeshWriteOptions options{.crsWkt = "EPSG:32611", .verticalUnit = "metre", .triangleErrors = errors};
    ASSERT_TRUE(writeMesh(mesh, folder.file("a.glb"), options));
    ASSERT_TRUE(writeMesh(mesh, folder.file("a.gltf"), options));
    const Result<MeshFile> binary = readMesh(folder.file("a.glb")), text = readMesh(folder.file("a.gltf"));
    ASSERT_TRUE(binary && text) << text.error().describe();
    EXPECT_EQ(text->mesh.positions, binary->mesh.positions);
    EXPECT_EQ(text->mesh.triangles, binary->mesh.triangles);
    EXPECT_EQ(text->mesh.triangles.size(), count);
    EXPECT_EQ(text->crsWkt, binary->crsWkt);
    EXPECT_EQ(text->verticalUnit, "metre");
    EXPECT_EQ(text->frame.rounding, binary->frame.rounding);
    // The same bytes in both, and JSON that any program parses.
    const Json json = Json::parse(bytesOf(folder.file("a.gltf")));
    if (count == 0) continue;
    const std::string glb = bytesOf(folder.file("a.glb"));
    const std::size_t size = json["buffers"][0]["byteLength"].get<std::size_t>();
    EXPECT_EQ(json["buffers"][0]["uri"].get<std::string>(), inBase64(glb.substr(glb.size() - size)));
  }
}

}  // namespace
}  // namespace arete

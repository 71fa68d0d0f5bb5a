// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/glb/document.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "io/glb_fixture.h"

namespace arete {
namespace {

using namespace test;

/// The error of opening, or of the accessor of that number.
Error errorOf(const std::string& glb, std::uint64_t accessor = 0, std::string_view type = "VEC3") {
  const Result<GltfDocument> document = GltfDocument::open(glb);
  if (!document) return document.error();
  const auto elements = document->accessor(accessor, type);
  if (!elements) return elements.error();
  ADD_FAILURE() << "was accepted: " << glb.substr(0, 200);
  return {};
}

TEST(GltfDocument, HandsOutTheElementsOfItsAccessors) {
  const Foreign foreign;
  const std::string glb = foreign.glb();
  const Result<GltfDocument> document = GltfDocument::open(glb);
  ASSERT_TRUE(document) << document.error().describe();
  const auto positions = document->accessor(0, "VEC3");
  ASSERT_TRUE(positions) << positions.error().describe();
  EXPECT_EQ(positions->count, 4u);
  EXPECT_EQ(positions->stride, 12u);
  EXPECT_EQ(positions->type, ScalarType::float32);
  EXPECT_EQ(positions->components, 3);
  EXPECT_EQ(std::string_view(positions->first, 48), std::string_view(foreign.bytes).substr(0, 48));
  const auto indices = document->accessor(1, "SCALAR");
  ASSERT_TRUE(indices);
  EXPECT_EQ(indices->first - positions->first, 48);
  EXPECT_TRUE(document->element("nodes", 0));
  EXPECT_FALSE(document->element("nodes", 1));
  EXPECT_FALSE(document->element("cameras", 0));
  EXPECT_FALSE(document->element("asset", 0));
}

TEST(GltfDocument, TakesEachAccessorToTheLastByteAndNoFurther) {
  Foreign foreign;
  Json& view = foreign.json["bufferViews"][0];
  Json& accessor = foreign.json["accessors"][0];
  // Three elements from byte 12 on end with the view; a fourth would not.
  accessor["byteOffset"] = 12;
  accessor["count"] = 3;
  EXPECT_TRUE(GltfDocument::open(foreign.glb())->accessor(0, "VEC3"));
  accessor["count"] = 4;
  EXPECT_EQ(errorOf(foreign.glb()).code, ErrorCode::corrupt);
  // With a stride the last element needs its own bytes only.
  accessor = {{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}};
  view["byteStride"] = 18;
  EXPECT_TRUE(GltfDocument::open(foreign.glb())->accessor(0, "VEC3"));
  view["byteStride"] = 0;  // as if it were not there
  EXPECT_TRUE(GltfDocument::open(foreign.glb())->accessor(0, "VEC3"));
  view["byteStride"] = 19;
  EXPECT_EQ(errorOf(foreign.glb()).code, ErrorCode::corrupt);
  view["byteStride"] = 11;
  EXPECT_EQ(errorOf(foreign.glb()).code, ErrorCode::corrupt);
}

TEST(GltfDocument, RefusesNumbersThatWouldOverflow) {
  for (const Json& number : {Json(std::numeric_limits<std::uint64_t>::max()), Json(4294967296), Json(-1),
                             Json(0.5), Json("4"), Json()})
    for (const auto& [list, key] : {std::pair{"accessors", "count"},
                                    {"accessors", "byteOffset"},
                                    {"accessors", "componentType"},
                                    {"accessors", "bufferView"},
                                    {"bufferViews", "byteOffset"},
                                    {"bufferViews", "byteLength"},
                                    {"bufferViews", "byteStride"},
                                    {"bufferViews", "buffer"}}) {
      Foreign foreign;
      foreign.json[list][0][key] = number;
      EXPECT_EQ(errorOf(foreign.glb()).code, ErrorCode::corrupt) << key << number;
    }
  const Json object = Json::parse(R"({"n": 4294967295, "m": 4294967296})");
  EXPECT_EQ(GltfDocument::wholeNumber(object, "n").value(), 4294967295u);
  EXPECT_FALSE(GltfDocument::wholeNumber(object, "m"));
  EXPECT_FALSE(GltfDocument::wholeNumber(object, "missing"));
  EXPECT_EQ(GltfDocument::wholeNumber(object, "missing", 7).value(), 7u);
}

TEST(GltfDocument, NamesWhatAreteDoesNotRead) {
  const auto unsupported = [](const Foreign& foreign) {
    const Error error = errorOf(foreign.glb());
    EXPECT_EQ(error.code, ErrorCode::unsupported) << error.describe();
    return error.message;
  };
  Foreign foreign;
  foreign.json["extensionsRequired"] = {"KHR_mesh_quantization", "EXT_texture_video", "KHR_\x1b[31m"};
  const std::string message = unsupported(foreign);
  EXPECT_NE(message.find("\"EXT_texture_video\", \"KHR_?[31m\""), std::string::npos) << message;
  EXPECT_EQ(message.find("KHR_mesh_quantization"), std::string::npos) << message;
  foreign = {};
  foreign.json["buffers"][0]["uri"] = "other.bin";
  unsupported(foreign);
  std::string version = Foreign{}.glb();
  version[4] = 1;
  EXPECT_EQ(errorOf(version).code, ErrorCode::unsupported);
}

TEST(GltfDocument, RefusesWhatIsNotAGlb) {
  const std::string glb = Foreign{}.glb();
  for (const std::string& text : {std::string(), std::string("glTF"), "x" + glb, glb + "x",
                                  glb.substr(0, glb.size() - 1), glbOf("[]", ""), glbOf("{", "")})
    EXPECT_EQ(errorOf(text).code, ErrorCode::corrupt);
  EXPECT_EQ(errorOf(glb, 2).code, ErrorCode::corrupt) << "no such accessor";
  EXPECT_EQ(errorOf(glb, 0, "VEC2").code, ErrorCode::corrupt) << "another type";
}

}  // namespace
}  // namespace arete

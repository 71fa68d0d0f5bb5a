// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every encoding of numbers that sections 3.6.2 and 3.11 of the standard allow. Expected values are the
// standard's formulas; the kinds are those in which other programs have had bugs.
#include "io/formats/glb/accessors.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "io/glb_fixture.h"

namespace arete {
namespace {

using namespace test;

/// All values of an accessor, element by element; or the error.
Result<std::vector<double>> valuesOf(const Assembled& made, std::uint64_t accessor,
                                     std::string_view type = {}) {
  const std::string glb = made.glb();
  const Result<GltfDocument> document = GltfDocument::open(glb);
  if (!document) return tl::unexpected(document.error());
  const auto elements = document->accessor(accessor, type);
  if (!elements) return tl::unexpected(elements.error());
  std::vector<double> values;
  for (std::uint64_t i = 0; i < elements->count; ++i)
    for (std::size_t c = 0; c < elements->components; ++c) values.push_back(elements->value(i, c));
  return values;
}

TEST(GltfAccessors, TakeFractionsAsTheStandardSays) {
  Assembled made;
  const std::vector<std::pair<std::size_t, std::vector<double>>> cases = {
      {made.add<std::uint8_t>({0, 1, 254, 255}, "SCALAR", true), {0, 1.0 / 255, 254.0 / 255, 1}},
      {made.add<std::int8_t>({0, 127, -127, -128}, "SCALAR", true), {0, 1, -1, -1}},
      {made.add<std::uint16_t>({0, 1, 65535}, "SCALAR", true), {0, 1.0 / 65535, 1}},
      {made.add<std::int16_t>({1, 32767, -32767, -32768}, "SCALAR", true), {1.0 / 32767, 1, -1, -1}},
      {made.add<std::int8_t>({-128, 5}, "SCALAR"), {-128, 5}},
      {made.add<std::uint32_t>({4294967295U}, "SCALAR"), {4294967295.0}},
      // A float is not a fraction of anything.
      {made.add<float>({7, -2.5F}, "SCALAR", true), {7, -2.5}},
  };
  for (const auto& [accessor, values] : cases)
    EXPECT_EQ(valuesOf(made, accessor).value(), values) << accessor;
}

TEST(GltfAccessors, AddTheOffsetsOfViewAndAccessorAndFollowTheStride) {
  Assembled made;
  // Interleaved: a position of 16-bit numbers, two bytes of padding, a color of four bytes.
  made.view(packed<std::uint8_t>({9, 9, 9, 9}));
  std::string interleaved;
  for (std::uint16_t v = 0; v < 3; ++v)
    interleaved += packed<std::uint16_t>(
                       {std::uint16_t(10 * v + 1), std::uint16_t(10 * v + 2), std::uint16_t(10 * v + 3)}) +
                   packed<std::uint8_t>({std::uint8_t(v), 255, 0, 7});
  const std::size_t view = made.view(interleaved, 12);
  made.json["accessors"] = {
      {{"bufferView", view}, {"componentType", 5123}, {"count", 3}, {"type", "VEC3"}},
      {{"bufferView", view}, {"byteOffset", 8}, {"componentType", 5121}, {"count", 3}, {"type", "VEC4"}}};
  EXPECT_EQ(valuesOf(made, 0).value(), (std::vector<double>{1, 2, 3, 11, 12, 13, 21, 22, 23}));
  EXPECT_EQ(valuesOf(made, 1).value(), (std::vector<double>{0, 255, 0, 7, 1, 255, 0, 7, 2, 255, 0, 7}));
}

TEST(GltfAccessors, BeginTheColumnsOfMatricesAtFourBytes) {
  Assembled made;
  // Two columns of two bytes and three of three: each has padding.
  const std::size_t two = made.view(packed<std::uint8_t>({1, 2, 0, 0, 3, 4, 0, 0, 5, 6, 0, 0, 7, 8, 0, 0})),
                    three = made.view(packed<std::uint16_t>({1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0})),
                    floats = made.view(packed<float>({1, 2, 3, 4}));
  made.json["accessors"] = {{{"bufferView", two}, {"componentType", 5121}, {"count", 2}, {"type", "MAT2"}},
                            {{"bufferView", three}, {"componentType", 5123}, {"count", 1}, {"type", "MAT3"}},
                            {{"bufferView", floats}, {"componentType", 5126}, {"count", 1}, {"type", "MAT2"}},
                            {{"bufferView", three}, {"componentType", 5123}, {"count", 2}, {"type", "MAT3"}}};
  EXPECT_EQ(valuesOf(made, 0).value(), (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(valuesOf(made, 1).value(), (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(valuesOf(made, 2).value(), (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(valuesOf(made, 3).error().code, ErrorCode::corrupt);
}

TEST(GltfAccessors, PutSparseOnesTogether) {
  Assembled made;
  const std::size_t base = made.add<float>({1, 1, 2, 2, 3, 3, 4, 4}, "VEC2");
  // Offsets of their own: that of the accessor is not added to those of the parts.
  const std::size_t indices = made.view(packed<std::uint8_t>({9, 9, 1, 3})),
                    values = made.view(packed<float>({0, 20, 21, 40, 41}));
  Json& accessor = made.json["accessors"][base];
  accessor["byteOffset"] = 8;
  accessor["count"] = 3;
  accessor["sparse"] = {{"count", 1},
                        {"indices", {{"bufferView", indices}, {"byteOffset", 2}, {"componentType", 5121}}},
                        {"values", {{"bufferView", values}, {"byteOffset", 4}}}};
  EXPECT_EQ(valuesOf(made, base).value(), (std::vector<double>{2, 2, 20, 21, 4, 4}));
  accessor["byteOffset"] = 0;
  accessor["count"] = 4;
  accessor["sparse"]["count"] = 2;
  EXPECT_EQ(valuesOf(made, base).value(), (std::vector<double>{1, 1, 20, 21, 3, 3, 40, 41}));
  // Without a bufferView the rest are zeros, as morph targets are written; without both all are.
  accessor.erase("bufferView");
  EXPECT_EQ(valuesOf(made, base).value(), (std::vector<double>{0, 0, 20, 21, 0, 0, 40, 41}));
  Json plain = accessor;
  plain.erase("sparse");
  made.json["accessors"].push_back(plain);
  EXPECT_EQ(valuesOf(made, base + 1).value(), (std::vector<double>{0, 0, 0, 0, 0, 0, 0, 0}));
  // Over a view with a stride.
  const std::size_t strided = made.view(packed<float>({5, 6, 0, 7, 8, 0, 9, 10, 0, 11, 12, 0}), 12);
  made.json["accessors"][base]["bufferView"] = strided;
  EXPECT_EQ(valuesOf(made, base).value(), (std::vector<double>{5, 6, 20, 21, 9, 10, 40, 41}));

  const auto expect = [&](const char* said, const std::function<void(Json&)>& change) {
    Assembled damaged = made;
    change(damaged.json["accessors"][base]["sparse"]);
    const auto read = valuesOf(damaged, base);
    ASSERT_FALSE(read) << said;
    EXPECT_EQ(read.error().code, ErrorCode::corrupt);
    EXPECT_NE(read.error().message.find(said), std::string::npos) << read.error().message;
  };
  expect("5 sparse values of 4", [](Json& sparse) { sparse["count"] = 5; });
  expect("0 sparse values", [](Json& sparse) { sparse["count"] = 0; });
  expect("out of order or range", [](Json& sparse) { sparse["indices"]["byteOffset"] = 0; });
  expect("out of order or range", [](Json& sparse) { sparse["indices"]["byteOffset"] = 1; });
  expect("unsigned", [](Json& sparse) { sparse["indices"]["componentType"] = 5120; });
  expect("without \"values\"", [](Json& sparse) { sparse.erase("values"); });
  expect("longer than its bufferView", [](Json& sparse) { sparse["values"]["byteOffset"] = 8; });
  expect("which does not exist", [](Json& sparse) { sparse["values"]["bufferView"] = 99; });
}

TEST(GltfAccessors, AreOfAKnownTypeAndTheOneThatIsNeeded) {
  Assembled made;
  made.add<float>({1, 2, 3}, "VEC3");
  EXPECT_TRUE(valuesOf(made, 0, "VEC3"));
  EXPECT_EQ(valuesOf(made, 0, "VEC2").error().code, ErrorCode::corrupt);
  for (const Json& type :
       {Json("VEC5"), Json("VEC1"), Json("MAT5"), Json("vec3"), Json(""), Json(3), Json()}) {
    made.json["accessors"][0]["type"] = type;
    EXPECT_EQ(valuesOf(made, 0).error().code, ErrorCode::corrupt) << type;
  }
}

TEST(GltfViews, TakeTheUncompressedBytesWhereTheCompressedAreDamaged) {
  Assembled made;
  const std::size_t accessor = made.add<float>({1, 2, 3, 4, 5, 6}, "VEC3");
  Json& extension = made.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"];
  extension = {{"buffer", 0}, {"byteLength", 24}, {"byteStride", 12}, {"count", 2}, {"mode", "ATTRIBUTES"}};
  EXPECT_EQ(valuesOf(made, accessor).value(), (std::vector<double>{1, 2, 3, 4, 5, 6}));
  // The other buffer has no bytes, as where the extension is required: then the decoder's error is said.
  made.json["bufferViews"][0]["buffer"] = 1;
  made.json["buffers"] = Json::array();
  Json whole = made.json;
  whole["buffers"] = {{{"byteLength", made.bytes.size()}}, {{"byteLength", 24}}};
  const std::string glb = glbOf(whole.dump(), made.bytes);
  const auto read = GltfDocument::open(glb)->accessor(accessor, "VEC3");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("bufferView 0"), std::string::npos) << read.error().message;
  // A count that would take far more memory than the file.
  whole["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["count"] = 4294967295U;
  const std::string huge = glbOf(whole.dump(), made.bytes);
  EXPECT_EQ(GltfDocument::open(huge)->accessor(accessor, "VEC3").error().code, ErrorCode::unsupported);
}

}  // namespace
}  // namespace arete

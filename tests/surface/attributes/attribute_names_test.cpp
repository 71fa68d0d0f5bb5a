// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/attributes/attribute_names.h"

#include <gtest/gtest.h>

namespace arete {
namespace {

Attribute named(std::string name) {
  return {.name = std::move(name)};
}

TEST(AttributeNames, CountSetsFromOneAndPartsOneByOne) {
  EXPECT_EQ(optionNameOf("texcoord"), "uv");
  EXPECT_EQ(optionNameOf("texcoord1"), "uv2");
  EXPECT_EQ(optionNameOf("texcoord11"), "uv12");
  EXPECT_EQ(optionNameOf("texcoord_u"), "texcoord_u");
  EXPECT_EQ(optionNameOf("color"), "color");
  EXPECT_EQ(optionNameOf("color1"), "color2");
  EXPECT_EQ(optionNameOf("colorful"), "colorful");
  EXPECT_EQ(optionNameOf("normal"), "normal");
  EXPECT_EQ(optionNameOf("materials"), "material");
  EXPECT_EQ(optionNameOf("_BATCHID"), "_BATCHID");
}

TEST(AttributeNames, FindAllOfANameByEitherNameAndListWhatThereIs) {
  MeshAttributes mesh;
  mesh.vertexAttributes = {named("color"), named("quality")};
  mesh.wedgeAttributes = {named("texcoord"), named("texcoord1"), named("color")};
  mesh.materials.resize(1);
  const auto colors = findAttributes(mesh, "color");
  ASSERT_TRUE(colors);
  ASSERT_EQ(colors->size(), 2u);
  EXPECT_EQ((*colors)[1].of, NamedAttribute::Of::wedges);
  EXPECT_EQ((*colors)[1].index, 2u);
  ASSERT_TRUE(findAttributes(mesh, "uv2"));
  EXPECT_EQ(findAttributes(mesh, "uv2")->front().inFile, "texcoord1");
  EXPECT_TRUE(findAttributes(mesh, "texcoord1"));
  EXPECT_EQ(findAttributes(mesh, "material")->front().of, NamedAttribute::Of::materials);
  const auto missing = findAttributes(mesh, "uv3");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().culprit, "uv3");
  EXPECT_NE(missing.error().message.find("color, quality, uv, uv2, material"), std::string::npos)
      << missing.error().message;
  EXPECT_NE(findAttributes({}, "uv").error().message.find("has none"), std::string::npos);
}

TEST(AttributeNumbers, AreBehindTheLastColon) {
  const auto read = parseAttributeNumbers("uv:2px,normal:10,a:b:.5");
  ASSERT_TRUE(read) << read.error().describe();
  EXPECT_EQ(*read, (std::vector<AttributeNumber>{{"uv", 2, "px"}, {"normal", 10, ""}, {"a:b", 0.5, ""}}));
  for (const auto* const wrong : {"", "uv", "uv:", ":3", "uv:-1", "uv:nan", "uv:inf", "uv:2cm", "uv:1,uv:2",
                                  "uv:1,", "uv:1,,color:2"}) {
    const auto refused = parseAttributeNumbers(wrong);
    ASSERT_FALSE(refused) << wrong;
    EXPECT_EQ(refused.error().code, ErrorCode::usage);
  }
  EXPECT_EQ(parseAttributeNumbers("uv:1,color:x").error().culprit, "color:x");
}

}  // namespace
}  // namespace arete

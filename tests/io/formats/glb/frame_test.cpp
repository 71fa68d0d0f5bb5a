// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/formats/glb/frame.h"

#include <gtest/gtest.h>

#include <string>

#include "io/glb_fixture.h"
#include "io/mesh_fixture.h"

namespace arete {
namespace {

using namespace test;

TEST(GlbFrames, ThatMakeNoSenseAreRefusedInAFile) {
  const TemporaryFolder folder;
  ASSERT_TRUE(writeMesh(kTwo, folder.file("a.glb"), {.crsWkt = "EPSG:4326"}));
  const std::string glb = bytesOf(folder.file("a.glb"));
  const Json json = jsonOf(glb);
  const std::string bytes = glb.substr(glb.size() - json["buffers"][0]["byteLength"].get<std::size_t>());
  ASSERT_TRUE(readMesh(folder.write("b.glb", glbOf(json.dump(), bytes))));
  for (const auto& [key, value] : json["asset"]["extras"]["arete"].items()) {
    if (key == "axes") continue;
    Json changed = json;
    for (const Json& bad : {Json(nullptr), Json::object(), Json({1, 2}), Json(-1e308)}) {
      if (key == "middleLongitude" && bad.is_number()) continue;
      changed["asset"]["extras"]["arete"][key] = bad;
      EXPECT_EQ(refusal(folder.write("b.glb", glbOf(changed.dump(), bytes))).code, ErrorCode::corrupt)
          << key << bad;
    }
  }
  EXPECT_EQ(writeMesh(TriangleMesh{{{0, 91, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}, folder.file("c.glb"),
                      {.crsWkt = "EPSG:4326"})
                .error()
                .code,
            ErrorCode::invalidData);
  EXPECT_EQ(writeMesh(kTwo, folder.file("c.glb"), {.crsWkt = "gibberish"}).error().code,
            ErrorCode::invalidData);
  EXPECT_EQ(folder.count(), 2u);
}

TEST(GlbFrames, OfEitherKindComeBackFromJson) {
  for (const bool isGeographic : {false, true}) {
    GlbFrame frame;
    frame.local = {
        .origin = {1.0 / 3, -2e7, 0.1}, .isGeographic = isGeographic, .verticalUnitMetres = 0.3048};
    if (isGeographic)
      frame.local.middleLongitude = 179.5;
    else
      frame.local.linearUnitMetres = 1200.0 / 3937, frame.local.mapScale = {2, 1.0 / 3};
    frame.crsWkt = "PROJCRS[\"a\"]";
    frame.verticalUnit = "ft";
    frame.notes = {"not read"};
    const Result<GlbFrame> back = glbFrameFromJson(Json::parse(toJson(frame).dump()));
    ASSERT_TRUE(back) << back.error().describe();
    EXPECT_EQ(back->local, frame.local);
    EXPECT_EQ(back->crsWkt, frame.crsWkt);
    EXPECT_EQ(back->verticalUnit, frame.verticalUnit);
    EXPECT_TRUE(back->notes.empty());
  }
}

TEST(GlbFrames, NameTheFieldThatIsWrong) {
  const Json whole = Json::parse(toJson(GlbFrame{}).dump());
  for (const char* key :
       {"frame", "origin", "crsWkt", "verticalUnit", "verticalUnitMetres", "linearUnitMetres"}) {
    Json json = whole;
    json.erase(key);
    const Result<GlbFrame> frame = glbFrameFromJson(json);
    ASSERT_FALSE(frame) << key;
    EXPECT_EQ(frame.error().code, ErrorCode::corrupt);
    EXPECT_NE(frame.error().message.find(std::string("asset.extras.arete.") + key), std::string::npos)
        << frame.error().message;
  }
  for (const Json& json : {Json(), Json("text"), Json::array({1, 2, 3})})
    EXPECT_FALSE(glbFrameFromJson(json));
}

TEST(GlbFrames, OfGltfPutHeightIntoYAndSouthIntoZ) {
  EXPECT_EQ(localToGltf({1, 2, 3}), (Vec3{1, 3, -2}));
  EXPECT_EQ(gltfToLocal(localToGltf({1, 2, 3})), (Vec3{1, 2, 3}));
}

}  // namespace
}  // namespace arete

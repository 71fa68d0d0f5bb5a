// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/format/surface_metadata.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace arete {
namespace {

using nlohmann::json;

/// Every field has a value that no other has, and none its default.
SurfaceMetadata full() {
  SurfaceMetadata m;
  m.writer = "the writer \xff";
  m.counts = {.rootVertices = 5, .rootTriangles = 6, .nodes = 7, .slots = 43};
  m.finestTriangles = 20;
  m.wedges = 47;
  m.hasDoubles = m.hasAllFaces = true;
  m.positionStep = 1.0 / 1024;
  m.scale = OutwardScale::fromBase(260000);
  m.metric = {{0.1 + 0.2, -2e300, 5e-324}, {1.0 / 3, 2.0 / 3, 1.0 / 7}};
  SurfaceModel& model = m.model;
  model.sourceVertices = 0xFFFFFFFE;
  model.sourceFaces = 23;
  model.fileFaces = 11;
  model.diagonal = 1.0 / 9;
  model.positionError = 1e-3 / 3;
  model.boundsLines = true;
  model.mending = {.duplicateFaces = 2,
                   .degenerateFaces = 3,
                   .splitFaces = 4,
                   .joinedVertices = 8,
                   .turnedFaces = 9,
                   .addedVertices = 10,
                   .unusedVertices = 12,
                   .dropsFlatNormals = true};
  model.options = {.keepsBorders = true, .maxDegree = 13, .thresholdRatio = 1.0 + 1.0 / 11};
  model.options.creaseAngleDegrees = 100.0 / 3;
  model.creaseEdges = 15;
  model.levels = 14;
  model.source = "a \"quoted\" name\xfe.ply";
  model.sourceChecksum = "xxh3-128:0123";
  model.crsWkt = "ENGCRS[\"x\n\"]";
  model.verticalUnit = "ft";
  model.up = "y";
  return m;
}

void expectSame(const SurfaceMetadata& a, const SurfaceMetadata& b) {
  EXPECT_EQ(a.writer, b.writer);
  EXPECT_EQ(a.counts.rootVertices, b.counts.rootVertices);
  EXPECT_EQ(a.counts.rootTriangles, b.counts.rootTriangles);
  EXPECT_EQ(a.counts.nodes, b.counts.nodes);
  EXPECT_EQ(a.counts.slots, b.counts.slots);
  EXPECT_EQ(a.finestTriangles, b.finestTriangles);
  EXPECT_EQ(a.wedges, b.wedges);
  EXPECT_EQ(a.hasDoubles, b.hasDoubles);
  EXPECT_EQ(a.hasAllFaces, b.hasAllFaces);
  EXPECT_EQ(a.positionStep, b.positionStep);
  EXPECT_EQ(a.scale.base(), b.scale.base());
  EXPECT_EQ(a.metric.origin, b.metric.origin);
  EXPECT_EQ(a.metric.scale, b.metric.scale);
  const SurfaceModel &x = a.model, &y = b.model;
  EXPECT_EQ(x.sourceVertices, y.sourceVertices);
  EXPECT_EQ(x.sourceFaces, y.sourceFaces);
  EXPECT_EQ(x.fileFaces, y.fileFaces);
  EXPECT_EQ(x.diagonal, y.diagonal);
  EXPECT_EQ(x.positionError, y.positionError);
  EXPECT_EQ(x.boundsLines, y.boundsLines);
  EXPECT_EQ(x.mending, y.mending);
  EXPECT_EQ(x.options, y.options);
  EXPECT_EQ(x.levels, y.levels);
  EXPECT_EQ(x.creaseEdges, y.creaseEdges);
  EXPECT_EQ(x.source, y.source);
  EXPECT_EQ(x.sourceChecksum, y.sourceChecksum);
  EXPECT_EQ(x.crsWkt, y.crsWkt);
  EXPECT_EQ(x.verticalUnit, y.verticalUnit);
  EXPECT_EQ(x.up, y.up);
}

TEST(SurfaceMetadataText, ReadsEveryFieldBackToTheBit) {
  const SurfaceMetadata m = full();
  EXPECT_FALSE(findAmtProblem(m)) << *findAmtProblem(m);
  const std::string text = toAmtJson(m);
  const Result<SurfaceMetadata> back = fromSurfaceJson(text);
  ASSERT_TRUE(back) << back.error().message;
  expectSame(m, *back);
  EXPECT_EQ(toAmtJson(*back), text);
}

TEST(SurfaceMetadataText, LeavesOutWhatIsNotThere) {
  SurfaceMetadata m = full();
  m.hasDoubles = m.hasAllFaces = false;
  m.positionStep = 0;
  m.model.positionError = 0;
  m.model.boundsLines = m.model.mending.dropsFlatNormals = m.model.options.keepsBorders = false;
  m.model.crsWkt = m.model.verticalUnit = m.model.up = "";
  const json object = json::parse(toAmtJson(m));
  for (const char* key : {"hasDoubles", "hasAllFaces", "positionStep", "positionError", "boundsLines",
                          "crsWkt", "verticalUnit", "up"})
    EXPECT_FALSE(object.contains(key)) << key;
  const Result<SurfaceMetadata> back = fromSurfaceJson(object.dump());
  ASSERT_TRUE(back) << back.error().message;
  expectSame(m, *back);
}

TEST(SurfaceMetadataText, OfEarlierWritersCountsFacesAndSplitsFromTheRest) {
  json object = json::parse(toAmtJson(full()));
  object.erase("fileFaces");
  object["mending"].erase("splitFaces");
  object["anything"] = "is ignored";
  const Result<SurfaceMetadata> back = fromSurfaceJson(object.dump());
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->model.fileFaces, back->model.sourceFaces);
  EXPECT_EQ(back->model.mending.splitFaces, 20u - (23 - 5));  // the finest front's more than the faces left
}

TEST(SurfaceMetadataText, IsRefusedWhereAFieldIsMissingOrOfAnotherType) {
  const json object = json::parse(toAmtJson(full())), flat = object.flatten();
  const std::vector<std::string> mayBeAbsent = {"/hasDoubles",
                                                "/hasAllFaces",
                                                "/positionStep",
                                                "/positionError",
                                                "/fileFaces",
                                                "/boundsLines",
                                                "/crsWkt",
                                                "/verticalUnit",
                                                "/up",
                                                "/build/keepsBorders",
                                                "/build/creaseAngleDegrees",
                                                "/build/creaseEdges",
                                                "/mending/splitFaces",
                                                "/mending/dropsFlatNormals"};
  int fields = 0;
  for (const auto& [pointer, value] : flat.items()) {
    SCOPED_TRACE(pointer);
    ++fields;
    json without = object, other = object;
    const json::json_pointer at(pointer);
    other[at] = json::array({json::object()});
    EXPECT_FALSE(fromSurfaceJson(other.dump()));
    if (without[at.parent_pointer()].is_array() || at.back() == "hex") continue;
    without[at.parent_pointer()].erase(at.back());
    const bool isOptional = std::ranges::find(mayBeAbsent, pointer) != mayBeAbsent.end();
    EXPECT_EQ(fromSurfaceJson(without.dump()).has_value(), isOptional);
  }
  EXPECT_GT(fields, 35);
}

TEST(SurfaceMetadataText, IsRefusedWhereNumbersAreOutOfRangeOrWouldWrapAround) {
  constexpr std::uint64_t kHuge = std::numeric_limits<std::uint64_t>::max();
  using Change = std::function<void(SurfaceMetadata&)>;
  const std::pair<const char*, Change> changes[] = {
      {"more than 32-bit ids", [](SurfaceMetadata& m) { m.counts.nodes = kHuge; }},
      {"do not make the stars", [](SurfaceMetadata& m) { m.counts.slots = 20; }},
      {"32-bit numbers", [](SurfaceMetadata& m) { m.model.sourceFaces = 0xFFFFFFFF; }},
      {"32-bit numbers", [](SurfaceMetadata& m) { m.model.sourceVertices = kHuge; }},
      {"148 wedges are more than the 147 corners", [](SurfaceMetadata& m) { m.wedges = 148; }},
      {"finest front", [](SurfaceMetadata& m) { m.finestTriangles = 50; }},
      {"fileFaces is", [](SurfaceMetadata& m) { m.model.fileFaces = kHuge; }},
      // 2^64 - 5 duplicates would let five faces more pass the law of faces.
      {"duplicateFaces is", [](SurfaceMetadata& m) { m.model.mending.duplicateFaces = kHuge - 4; }},
      {"degenerateFaces is", [](SurfaceMetadata& m) { m.model.mending.degenerateFaces = kHuge; }},
      {"splitFaces is", [](SurfaceMetadata& m) { m.model.mending.splitFaces = kHuge; }},
      {"joinedVertices is", [](SurfaceMetadata& m) { m.model.mending.joinedVertices = kHuge; }},
      {"turnedFaces is", [](SurfaceMetadata& m) { m.model.mending.turnedFaces = kHuge; }},
      {"addedVertices is", [](SurfaceMetadata& m) { m.model.mending.addedVertices = kHuge; }},
      {"unusedVertices is", [](SurfaceMetadata& m) { m.model.mending.unusedVertices = kHuge; }},
      {"metric frame", [](SurfaceMetadata& m) { m.metric.scale.y = -1; }},
      {"diagonal", [](SurfaceMetadata& m) { m.model.diagonal = 0; }},
      {"power of two", [](SurfaceMetadata& m) { m.positionStep = 0.3; }},
      {"error of the positions", [](SurfaceMetadata& m) { m.model.positionError = -1; }},
      {"error scale's base", [](SurfaceMetadata& m) { m.scale = OutwardScale::fromBase(1u << 30); }},
      {"build options", [](SurfaceMetadata& m) { m.model.options.maxDegree = 2; }},
      {"build options", [](SurfaceMetadata& m) { m.model.options.thresholdRatio = 1; }},
      {"angle of creases", [](SurfaceMetadata& m) { m.model.options.creaseAngleDegrees = 181; }},
  };
  for (const auto& [sentence, change] : changes) {
    SurfaceMetadata m = full();
    change(m);
    const auto problem = findAmtProblem(m);
    ASSERT_TRUE(problem) << sentence;
    EXPECT_NE(problem->find(sentence), std::string::npos) << *problem;
  }
}

TEST(SurfaceLooks, TakeNoMemoryForFacesWhoseValuesAreNotThere) {
  SurfaceModel model;
  model.sourceFaces = 0xFFFFFFFE;  // 17 gigabytes of numbers
  std::vector<std::uint64_t> pictureBytes;
  for (const char* key : {"hasObjects", "hasGroups", "hasMaterials", "hasFaces"}) {
    const Status read = fromLooksJson(json{{key, true}}.dump(), model.sourceFaces, 4000, model, pictureBytes);
    ASSERT_FALSE(read) << key;
    EXPECT_EQ(read.error().code, ErrorCode::corrupt);
    EXPECT_NE(read.error().message.find("too few"), std::string::npos) << read.error().message;
  }
  EXPECT_TRUE(fromLooksJson("{}", model.sourceFaces, 0, model, pictureBytes));
}

TEST(SurfaceLooks, AreRefusedWhereTheDistancesOfErrorsAreNoRisingNumbers) {
  std::vector<std::uint64_t> pictureBytes;
  const auto read = [&](const json& distances) {
    SurfaceModel model;
    return fromLooksJson(json{{"attributeDistances", distances}}.dump(), 0, 0, model, pictureBytes);
  };
  EXPECT_TRUE(read({0.5, 1, 2.25}));
  for (const json& bad : {json(1.0), json({"a"}), json({0.0}), json({-1.0, 2.0}), json({2.0, 2.0}),
                          json({3.0, 2.0}), json(std::vector<double>(65, 1.0))}) {
    const Status refused = read(bad);
    ASSERT_FALSE(refused) << bad;
    EXPECT_EQ(refused.error().code, ErrorCode::corrupt);
    EXPECT_NE(refused.error().message.find("attributeDistances"), std::string::npos)
        << refused.error().message;
  }
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/store/format/metadata.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <numeric>
#include <set>
#include <string>

#include "io/amt_fixture.h"

namespace arete {
namespace {

using test::tinyModel;

AmtMetadata tiny() {
  return amtMetadataOf(tinyModel(), "the writer");
}

TEST(Metadata, ReadsBackToTheSameText) {
  AmtMetadata m = tiny();
  m.model.reading = {.band = 2,
                     .layer = "a\xff",
                     .zField = "z",
                     .samePlace = "mean",
                     .crs = "EPSG:32611",
                     .nodata = -9999,
                     .verticalUnit = "ft",
                     .isDepth = true,
                     .otherFiles = {"b.tif", "c\xff.tif"}};
  m.model.options.shape = HoleShape::dataDependent;
  m.model.options.rimTolerance = 0.1 + 0.2;
  const std::string text = toAmtJson(m);
  const auto back = fromAmtJson(text);
  ASSERT_TRUE(back) << back.error().describe();
  EXPECT_EQ(toAmtJson(*back), text);
  EXPECT_EQ(back->writer, "the writer");
  EXPECT_EQ(back->model.reading.layer, "a\xff");
  EXPECT_EQ(back->model.options.rimTolerance, 0.1 + 0.2);
  EXPECT_EQ(back->scale.base(), m.scale.base());
  EXPECT_TRUE(std::signbit(back->encoding.offset));
}

TEST(Metadata, OfFilesOfEarlierWritersSaysNothingOfTheReading) {
  const std::string text = toAmtJson(tiny());
  EXPECT_EQ(text.find("reading"), std::string::npos);
  const auto back = fromAmtJson(text);
  ASSERT_TRUE(back);
  EXPECT_FALSE(back->model.reading.band);
  EXPECT_TRUE(back->model.reading.crs.empty());
}

TEST(Metadata, IsRefusedWhereItIsNoJsonObject) {
  for (const char* text : {"", "{", "[]", "7", "{\"writer\": 7}"})
    EXPECT_EQ(fromAmtJson(text).error().code, ErrorCode::corrupt) << text;
  EXPECT_NE(fromAmtJson("{}").error().message.find("writer is missing"), std::string::npos);
}

TEST(Metadata, IsRefusedWhereCountsOrNumbersContradictEachOther) {
  const std::pair<const char*, std::function<void(AmtMetadata&)>> changes[] = {
      {"more than 32-bit ids", [](AmtMetadata& m) { m.counts.rootVertices = 0xFFFFFFFF; }},
      {"vertices are more than 32-bit ids", [](AmtMetadata& m) { m.counts.rootVertices = 0xFFFFFFFE; }},
      {"no root triangle", [](AmtMetadata& m) { m.counts.rootTriangles = 0; }},
      {"do not make the stars", [](AmtMetadata& m) { m.counts.slots = 5; }},
      {"do not make the stars", [](AmtMetadata& m) { m.counts.slots = 34 * m.counts.nodes; }},
      {"more than the grid has", [](AmtMetadata& m) { m.counts.isolated = 10; }},
      {"no samples or too many", [](AmtMetadata& m) { m.model.columns = 0; }},
      {"not invertible", [](AmtMetadata& m) { m.model.georeference.geoTransform = {}; }},
      {"not finite", [](AmtMetadata& m) { m.encoding.scale = HUGE_VAL; }},
      {"negative scale", [](AmtMetadata& m) { m.metric.scale.x = -1; }},
      {"vertical unit", [](AmtMetadata& m) { m.model.georeference.verticalUnitMetres = 0; }},
      {"inverse flattening", [](AmtMetadata& m) { m.model.georeference.inverseFlattening = 0.5; }},
      {"error scale's base", [](AmtMetadata& m) { m.scale = OutwardScale::fromBase(1u << 30); }},
      {"Delaunay metric", [](AmtMetadata& m) { m.model.metricQ = 0; }},
      {"build options", [](AmtMetadata& m) { m.model.options.thresholdRatio = 0.5; }},
      {"scattered points", [](AmtMetadata& m) { m.model.isRaster = false; }},
  };
  EXPECT_FALSE(findAmtProblem(tiny()));
  for (const auto& [sentence, change] : changes) {
    AmtMetadata m = tiny();
    change(m);
    const auto problem = findAmtProblem(m);
    ASSERT_TRUE(problem) << sentence;
    EXPECT_NE(problem->find(sentence), std::string::npos) << *problem;
  }
}

}  // namespace
}  // namespace arete

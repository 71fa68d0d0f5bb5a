// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/query/certificate/report_json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace arete {
namespace {

MeasureReport someReport() {
  MeasureReport report;
  report.triangles = 7;
  report.samples = 20;
  report.valid = 18;
  report.covered = 17;
  report.isolated = 1;
  report.maxAbsError = 2.5;
  report.meanError = -0.25;
  report.domainAreaPixels = 12;
  report.tinAreaPixels = 11.5;
  report.worst = MeasuredSample{.sample = 11,
                                .column = 3,
                                .row = 2,
                                .x = 0.5,
                                .y = -1,
                                .demHeight = 10,
                                .tinHeight = 7.5,
                                .triangle = 4};
  return report;
}

TEST(ReportJson, SaysWhereTheWorstSampleOfARasterIs) {
  const auto json = toJson(someReport(), true);
  EXPECT_EQ(json["triangles"], 7);
  EXPECT_EQ(json["error"]["maximum"], 2.5);
  EXPECT_EQ(json["error"]["mean"], -0.25);
  const auto& worst = json["error"]["worst"];
  EXPECT_EQ(worst["column"], 3);
  EXPECT_EQ(worst["row"], 2);
  EXPECT_FALSE(worst.contains("point"));
  EXPECT_EQ(worst["tinHeight"], 7.5);
  EXPECT_EQ(json["samples"]["all"], 20);
  EXPECT_EQ(json["samples"]["covered"], 17);
  EXPECT_EQ(json["areaPixels"]["domain"], 12);
}

TEST(ReportJson, NumbersAScatteredPointAndHasNoDomain) {
  const auto json = toJson(someReport(), false);
  const auto& worst = json["error"]["worst"];
  EXPECT_EQ(worst["point"], 11);
  EXPECT_FALSE(worst.contains("column"));
  EXPECT_FALSE(json["areaPixels"].contains("domain"));
  EXPECT_EQ(json["areaPixels"]["tin"], 11.5);
}

TEST(ReportJson, HasNullWhereNoSampleIsCovered) {
  MeasureReport report = someReport();
  report.worst.reset();
  EXPECT_TRUE(toJson(report, true)["error"]["worst"].is_null());
}

TEST(ReportJson, StatesDistancesBothWaysAndOfTheDiagonal) {
  MeshDistanceReport report;
  report.first.triangles = 3;
  report.second.triangles = 5;
  report.second.diagonal = 8;
  report.forward.maximum = 1;
  report.backward.maximum = 2;
  report.seed = 99;
  const auto json = toJson(report);
  EXPECT_EQ(json["first"]["triangles"], 3);
  EXPECT_EQ(json["second"]["triangles"], 5);
  EXPECT_EQ(json["fromFirst"]["maximum"], 1);
  EXPECT_EQ(json["fromSecond"]["maximum"], 2);
  EXPECT_EQ(json["bothWays"]["maximum"], 2);
  EXPECT_EQ(json["ofDiagonal"]["maximum"], 0.25);
  EXPECT_EQ(json["ofDiagonal"]["diagonal"], 8);
  EXPECT_EQ(json["seed"], 99);
}

}  // namespace
}  // namespace arete

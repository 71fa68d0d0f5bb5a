// SPDX-License-Identifier: GPL-3.0-or-later
//
// --metric and --to-crs as a user meets them.
#include <gtest/gtest.h>

#include <string>

#include "cli/cli_fixture.h"

namespace arete::cli_test {
namespace {

class Place : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    makeRaster("dem.tif", "geographic", 40, 30);
    ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt", "-q"}).code, 0);
  }
  Outcome extract(const std::string& output, const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"extract", "dem.amt", "-o", output, "--max-error", "5", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  /// `measure --expect` of what extract promises.
  Outcome measurePromise(const std::string& output, const Outcome& extracted,
                         const std::vector<std::string>& more = {}) const {
    const Json made = extracted.json()["exports"][0];
    std::vector<std::string> words = {"measure", output,     "dem.tif",
                                      "--json",  "--expect", made["promisedError"].dump()};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
};

TEST_F(Place, DegreesForViewersAreWarnedOfWithBothRemedies) {
  for (const char* output : {"t.obj", "t.stl", "t.ply", "t.off"}) {
    const Outcome outcome = extract(output, {});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("degrees"), std::string::npos) << output << outcome.err;
    EXPECT_NE(outcome.err.find("--metric"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("--to-crs"), std::string::npos) << outcome.err;
  }
  for (const char* output : {"t.glb", "t.2dm", "t.gpkg", "t.tif"})
    EXPECT_EQ(extract(output, {}).err.find("degrees"), std::string::npos) << output;
  for (const std::vector<std::string>& place : {std::vector<std::string>{"--metric"}, {"--to-crs", "utm"}}) {
    const Outcome outcome = extract("t.obj", place);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err.find("needle"), std::string::npos) << outcome.err;
  }
  const Outcome converted = run({"convert", "t.gpkg", "-o", "u.stl"});
  EXPECT_NE(converted.err.find("--metric"), std::string::npos) << converted.err;
}

TEST_F(Place, MeasureFindsThePromiseKeptWhereTheFileSaysItIs) {
  for (const char* output : {"t.ply", "t.obj", "t.off", "t.stl"}) {
    SCOPED_TRACE(output);
    const Outcome metric = extract(output, {"--metric"});
    ASSERT_EQ(metric.code, 0) << metric.err;
    EXPECT_EQ(metric.json()["exports"][0]["placed"]["target"], "metres");
    const Outcome measured = measurePromise(output, metric);
    EXPECT_EQ(measured.code, 0) << measured.out << measured.err;
    EXPECT_EQ(measured.json()["samples"]["uncovered"], 0);
  }
  for (const char* output : {"t.ply", "t.obj", "t.gpkg", "t.2dm"}) {
    SCOPED_TRACE(output);
    const Outcome utm = extract(output, {"--to-crs", "utm"});
    ASSERT_EQ(utm.code, 0) << utm.err;
    EXPECT_NE(utm.json()["exports"][0]["placed"]["target"].get<std::string>().find("UTM zone"),
              std::string::npos);
    const Outcome measured = measurePromise(output, utm);
    EXPECT_EQ(measured.code, 0) << measured.out << measured.err;
  }
  // An STL states no CRS: the certificate's command does.
  const Outcome stl = extract("t.stl", {"--to-crs", "utm", "--certificate"});
  ASSERT_EQ(stl.code, 0) << stl.err;
  const std::string check = readJson("t.certificate.json")["check"];
  EXPECT_NE(check.find("--tin-crs EPSG:"), std::string::npos) << check;
  const std::string target = check.substr(check.find("EPSG:"));
  EXPECT_EQ(measurePromise("t.stl", stl, {"--tin-crs", target.substr(0, target.find(' '))}).code, 0);
}

TEST_F(Place, ConvertLeadsAMeshThereAndRestatesItsErrors) {
  ASSERT_EQ(extract("t.ply", {}).code, 0);
  for (const std::vector<std::string>& place : {std::vector<std::string>{"--metric"}, {"--to-crs", "utm"}}) {
    std::vector<std::string> words = {"convert", "t.ply", "-o", "u.ply", "--json"};
    words.insert(words.end(), place.begin(), place.end());
    const Outcome converted = run(words);
    ASSERT_EQ(converted.code, 0) << converted.err;
    EXPECT_TRUE(converted.json().contains("placed"));
    EXPECT_EQ(run({"measure", "u.ply", "dem.tif", "--expect", "5.5"}).code, 0);
  }
}

TEST_F(Place, WhatCannotBeLedIsRefusedByName) {
  const auto refused = [](const Outcome& outcome, const std::string& name) {
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
  };
  refused(extract("t.tif", {"--to-crs", "utm"}), "gdalwarp");
  refused(extract("t.gpkg", {"--metric"}), "--to-crs");
  refused(extract("t.ply", {"--to-crs", "EPSG:999999"}), "--to-crs EPSG:999999");
  refused(extract("t.ply", {"--to-crs", "utm", "--metric"}), "--metric");
  write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  refused(run({"convert", "a.obj", "-o", "b.obj", "--metric"}), "--metric");
  refused(run({"convert", "a.obj", "-o", "b.obj", "--to-crs", "utm"}), "--to-crs utm");
  refused(run({"convert", "dem.amt", "-o", "b.amt", "--metric"}), "--metric");
  ASSERT_EQ(run({"build", "a.obj", "-o", "a.amt"}).code, 0);
  refused(run({"extract", "a.amt", "-o", "b.obj", "--max-error", "1", "--metric"}), "--metric");
}

}  // namespace
}  // namespace arete::cli_test

// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/geo/gdal/support.h"

#include <cpl_error.h>
#include <gtest/gtest.h>

#include <thread>

#include "io/io_fixture.h"

namespace arete {
namespace {

using test::TemporaryFolder;

void report(CPLErr severity, const char* message) {
  CPLError(severity, CPLE_AppDefined, "%s", message);
}

TEST(GdalErrors, CollectInTheInnermostScope) {
  GdalErrors outer;
  report(CE_Warning, "outside");
  {
    GdalErrors inner;
    EXPECT_FALSE(inner.anyFailure());
    report(CE_Failure, "the cause\nof it.");
    report(CE_Failure, "a consequence");
    EXPECT_TRUE(inner.anyFailure());
    EXPECT_EQ(inner.firstFailure(), "the cause of it");
    EXPECT_FALSE(outer.anyFailure());
    inner.clear();
    EXPECT_EQ(inner.firstFailure(), "");
  }
  report(CE_Failure, "outside again");
  EXPECT_EQ(outer.firstFailure(), "outside again");
}

TEST(GdalErrors, BecomeAFewDistinctWarnings) {
  GdalErrors errors;
  report(CE_Debug, "not for people");
  for (int i = 0; i < 20; ++i) report(CE_Warning, ("message " + std::to_string(i % 7)).c_str());
  Warnings warnings = {{WarningCode::choice, "before"}};
  errors.moveTo(warnings);
  ASSERT_EQ(warnings.size(), 7u) << "one before, five kept and a count";
  EXPECT_EQ(warnings[1].sentence, "GDAL: message 0");
  EXPECT_EQ(warnings.back().sentence, "GDAL: and 2 more messages");
  warnings.clear();
  errors.moveTo(warnings);
  EXPECT_TRUE(warnings.empty());
}

TEST(GdalErrors, AreOfTheirThread) {
  GdalErrors mine;
  std::thread([] {
    GdalErrors others;
    report(CE_Failure, "elsewhere");
    EXPECT_TRUE(others.anyFailure());
  }).join();
  EXPECT_FALSE(mine.anyFailure());
}

TEST(FindInputProblem, NamesWhatKeepsAPathFromBeingAFile) {
  const TemporaryFolder folder;
  EXPECT_EQ(findInputProblem("")->code, ErrorCode::usage);
  EXPECT_EQ(findInputProblem(folder.file("."))->code, ErrorCode::unreadable);
  EXPECT_EQ(findInputProblem(folder.write("empty.tif", ""))->message, "is empty");
  EXPECT_FALSE(findInputProblem(folder.write("a.tif", "x")));
  EXPECT_FALSE(findInputProblem(folder.file("missing.tif"))) << "it may be a connection string";
}

TEST(ExplainOpenFailure, GoesFromTheFileToItsContent) {
  const TemporaryFolder folder;
  const auto explain = [&](const std::string& path) {
    GdalErrors errors;
    EXPECT_EQ(openGdal(path, GDAL_OF_RASTER), nullptr) << path;
    return explainOpenFailure(path, "raster", errors);
  };
  EXPECT_EQ(explain(folder.file("missing.tif")).code, ErrorCode::notFound);
  EXPECT_EQ(explain("/vsizip/" + folder.file("missing.zip") + "/a.tif").code, ErrorCode::notFound);
  const Error text = explain(folder.write("a.txt", "hello"));
  EXPECT_EQ(text.code, ErrorCode::unsupported);
  EXPECT_EQ(text.message, "is not a raster in any format GDAL knows");
  const Error cut = explain(folder.write("cut.tif", std::string("II*\0\xff\xff\0\0", 8)));
  EXPECT_EQ(cut.code, ErrorCode::corrupt) << cut.describe();
  const Error zip = explain(folder.write("a.zip", "PK"));
  EXPECT_EQ(zip.code, ErrorCode::unsupported);
  EXPECT_NE(zip.message.find("/vsizip/"), std::string::npos) << zip.describe();
}

TEST(GdalNames, AreToldApart) {
  EXPECT_TRUE(isVirtualPath("/vsizip/a.zip/b.tif"));
  EXPECT_FALSE(isVirtualPath("/tmp/vsizip"));
  EXPECT_FALSE(isVirtualPath(""));
  registerGdal();
  EXPECT_TRUE(isTextDriver(GDALGetDriverByName("XYZ")));
  EXPECT_FALSE(isTextDriver(GDALGetDriverByName("GTiff")));
  EXPECT_FALSE(isTextDriver(nullptr));
}

}  // namespace
}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
// The library's fields as the command line's options.
#include "cli/session/option_names.h"

#include <array>

#include "cli/cli_fixture.h"

namespace arete::cli_test {
namespace {

TEST(OptionNames, NameTheOptionOfAField) {
  EXPECT_EQ(optionOfField("maxTriangles"), "--max-triangles");
  EXPECT_EQ(optionOfField("thresholdRatio"), "--ratio");
  EXPECT_EQ(optionOfField("minimumAspect"), "--min-aspect");
  EXPECT_EQ(optionOfField("zField"), "--z-field");
  EXPECT_EQ(optionOfField("allowCoveredNodata"), "--allow-covered-nodata");
}

TEST(OptionNames, AreNothingForWhatIsNoField) {
  for (const char* text : {"", "tiles", "max", "maxTrianglesX", "zzz", "a", "--band"})
    EXPECT_FALSE(optionOfField(text)) << text;
}

TEST(OptionNames, ReplaceTheFieldOfACulpritAndKeepItsValue) {
  const Error alone = withOptionNames(Error{ErrorCode::usage, "is too small", "maxDegree"});
  EXPECT_EQ(alone.describe(), "--max-degree: is too small");
  const Error valued = withOptionNames(Error{ErrorCode::invalidData, "is empty", "region 1,2,3 4"});
  EXPECT_EQ(valued.culprit, "--region 1,2,3 4");
  EXPECT_EQ(valued.code, ErrorCode::invalidData);
}

TEST(OptionNames, LeaveOtherCulpritsAlone) {
  for (const char* culprit : {"", "dem.tif", "--camera 1,2,3", "bands.tif", "band.tif 3", "fixed vertices"})
    EXPECT_EQ(withOptionNames(Error{ErrorCode::usage, "x", culprit}).culprit, culprit);
}

TEST(OptionNames, LeaveAFileAloneThatIsCalledLikeAField) {
  for (const ErrorCode code : {ErrorCode::notFound, ErrorCode::unreadable, ErrorCode::corrupt})
    EXPECT_EQ(withOptionNames(Error{code, "x", "band"}).culprit, "band");
}

TEST(OptionNames, ReplaceFieldsInBackquotesOfASentence) {
  EXPECT_EQ(withOptionNames("state it with `crs`"), "state it with --crs");
  EXPECT_EQ(withOptionNames("`band`, `zField` or `nodata`."), "--band, --z-field or --nodata.");
  EXPECT_EQ(withOptionNames(Error{ErrorCode::usage, "needs `camera`", "order"}).describe(),
            "--order: needs --camera");
}

TEST(OptionNames, KeepBackquotesAroundAnythingElse) {
  for (const char* text : {"", "`", "a `name` of b", "``", "`crs", "crs", "run `arete info`"})
    EXPECT_EQ(withOptionNames(std::string_view(text)), text);
  EXPECT_EQ(withOptionNames("a `x`crs`"), "a `x--crs") << "the second backquote opens a pair too";
}

class OptionNamesOfTheProgram : public Cli {};

TEST_F(OptionNamesOfTheProgram, AreThoseOfOptionsThatExist) {
  std::string help;
  for (const char* command : {"build", "convert", "demo", "extract", "height", "info", "los", "measure",
                              "profile", "validate", "view", "viewshed"})
    help += run({command, "--help-all"}).out;
  help += run({"mesh", "crop", "--help-all"}).out;
  for (const char* field : {"allowCoveredNodata",
                            "band",
                            "bands",
                            "box",
                            "camera",
                            "clutter",
                            "creaseAngleDegrees",
                            "crs",
                            "deadlineMilliseconds",
                            "distance",
                            "drape",
                            "earth",
                            "featureCount",
                            "featurePersistence",
                            "fieldOfView",
                            "figures",
                            "film",
                            "fit",
                            "fixedVertices",
                            "focus",
                            "frames",
                            "framesPerSecond",
                            "frequency",
                            "growth",
                            "headless",
                            "isLonLat",
                            "layer",
                            "like",
                            "lonLat",
                            "maxDegree",
                            "maxError",
                            "maxTriangles",
                            "method",
                            "minimumAspect",
                            "nodata",
                            "order",
                            "outsideError",
                            "pixelError",
                            "refraction",
                            "region",
                            "rimTolerance",
                            "samples",
                            "seed",
                            "shape",
                            "targetHeight",
                            "thresholdRatio",
                            "unit",
                            "up",
                            "viewport",
                            "zField"}) {
    const auto option = optionOfField(field);
    ASSERT_TRUE(option) << field;
    EXPECT_NE(help.find(std::string(*option) + " "), std::string::npos) << *option;
  }
}

TEST_F(OptionNamesOfTheProgram, StandInItsErrors) {
  makeRaster("dem.tif", "fractal", 30, 30);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt", "-q"}).code, 0);
  const Outcome budget = run({"extract", "dem.amt", "-o", "tin.ply", "--max-triangles", "1", "--json"});
  EXPECT_EQ(budget.code, 2);
  EXPECT_EQ(budget.json()["error"]["culprit"], "--max-triangles");
  EXPECT_NE(budget.err.find("arete: --max-triangles: "), std::string::npos) << budget.err;
  const Outcome aspect = run({"build", "dem.tif", "-o", "x.amt", "--min-aspect", "0.6", "-q"});
  EXPECT_EQ(aspect.code, 2);
  EXPECT_EQ(aspect.err.rfind("arete: --min-aspect: ", 0), 0u) << aspect.err;
}

}  // namespace
}  // namespace arete::cli_test

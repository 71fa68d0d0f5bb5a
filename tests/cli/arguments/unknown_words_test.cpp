// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/arguments/unknown_words.h"

#include "cli/arguments_fixture.h"

namespace arete::cli_test {
namespace {

using UnknownWords = Arguments;

TEST_F(UnknownWords, AreNamedWithTheOptionsOfSimilarNames) {
  const auto extract = [&](const std::vector<std::string>& words, const std::string& sentence) {
    std::vector<std::string> arguments{"extract", "dem.amt", "-o", "x.ply", "--max-error", "1"};
    arguments.insert(arguments.end(), words.begin(), words.end());
    expectRefusal(arguments, 2, sentence + "\nSee arete extract --help.\n");
  };
  extract({"--triangles", "500"}, "there is no option --triangles; similar: --max-triangles");
  extract({"--triangles=500"}, "there is no option --triangles; similar: --max-triangles");
  extract({"--regoin", "1,2,3,4"}, "there is no option --regoin; similar: --region");
  extract({"--frobnicate"}, "there is no option --frobnicate");
  extract({"-z", "3"}, "there is no option -z");
  // Other programs' words.
  extract({"--tolerance", "2"}, "there is no option --tolerance; similar: --max-error");
  for (const char* option : {"--tolerance", "--max-error", "--max-triangles"})
    expectRefusal({"build", "dem.tif", "-o", "b.amt", option, "5"}, 2, "belongs to arete extract");
  extract({"--ratio", "0.1"}, "there is no option --ratio; similar: --max-triangles");
  extract({"--t_srs", "EPSG:3857"}, "there is no option --t_srs");
  extract({"--bbox", "1,2,3,4"}, "there is no option --bbox; similar: --region");
  extract({"--verbose"}, "there is no option --verbose; similar: --progress");
  extract({"other.amt"}, "The following argument was not expected: other.amt");
}

TEST_F(UnknownWords, AreNamedBeforeWhatIsMissingForThem) {
  expectRefusal({"extract", "dem.amt", "--tolerance", "2"}, 2,
                "there is no option --tolerance; similar: --max-error\nSee arete extract --help.\n");
}

TEST_F(UnknownWords, OfACommandOfACommandAreThose) {
  expectRefusal({"mesh", "info", "tin.ply", "--jsn"}, 2,
                "there is no option --jsn; similar: --json\nSee arete mesh info --help.");
  expectRefusal({"mesh", "inform", "tin.ply"}, 2,
                "there is no command 'inform'; the commands of mesh are info");
  expectRefusal({"extrakt"}, 2, "there is no command 'extrakt'; the commands are build, info, extract");
}

TEST(UnknownOption, IsNoNumberAndNothingBehindTwoDashes) {
  CLI::App app;
  double number = 0;
  app.add_option("--max-error,-e", number);
  EXPECT_EQ(unknownOption(app, {"-5", "-.5", "-", "--max-error=1", "-e1", "-e", "--", "--other"}), "");
  EXPECT_EQ(unknownOption(app, {"--max-eror"}), "there is no option --max-eror; similar: --max-error");
  EXPECT_EQ(unknownOption(app, {"--ma"}), "there is no option --ma");
}

}  // namespace
}  // namespace arete::cli_test

// SPDX-License-Identifier: GPL-3.0-or-later
// Places with spaces in the place of commas.
#include "cli/arguments/spaced_numbers.h"

#include <CLI/CLI.hpp>

#include "cli/commands/program.h"
#include "cli/session/session.h"
#include "cli/sight_fixture.h"

namespace arete::cli_test {
namespace {

std::string problemOf(const std::vector<std::string>& words) {
  Session session;
  CLI::App app;
  declareProgram(app, session);
  return spacedNumbers(app, words);
}

TEST(SpacedNumbers, AreJoinedInTheOrderOfTheWords) {
  EXPECT_EQ(
      problemOf({"los", "x.amt", "--from", "390000", "3800000", "30", "--to", "1,2,3"}),
      "--from 390000 3800000 30: numbers of one option are joined with commas: --from 390000,3800000,30");
  EXPECT_EQ(problemOf({"extract", "x.amt", "--region", "1", "-2", "3.5", "4e3"}),
            "--region 1 -2 3.5 4e3: numbers of one option are joined with commas: --region 1,-2,3.5,4e3");
  EXPECT_EQ(problemOf({"los", "x.amt", "--from", "1,", "2,", "30msl"}),
            "--from 1, 2, 30msl: numbers of one option are joined with commas: --from 1,2,30msl");
  EXPECT_NE(problemOf({"mesh", "crop", "a.obj", "--box", "0", "0", "0", "1", "1", "1"}), "");
}

TEST(SpacedNumbers, OfAnOptionThatIsRepeatedHaveNoComma) {
  EXPECT_NE(problemOf({"height", "x.amt", "--at", "390000", "3800000"}), "");
  EXPECT_EQ(problemOf({"height", "x.amt", "--at", "390000,3800000", "390010,3800000"}), "");
}

TEST(SpacedNumbers, AreNotFoundWhereAnOptionTakesOneNumber) {
  EXPECT_EQ(problemOf({"los", "x.amt", "--from", "1,2,3", "--to", "4,5,6"}), "");
  EXPECT_EQ(problemOf({"extract", "x.amt", "--threads", "4", "5"}), "");
  EXPECT_EQ(problemOf({"los", "x.amt", "--from=1", "2", "3"}), "");
  EXPECT_EQ(problemOf({"nothing", "--from", "1", "2", "3"}), "");
  EXPECT_EQ(problemOf({}), "");
}

using SpacedPlaces = SightCommands;

TEST_F(SpacedPlaces, AreRefusedBeforeAnythingIsRead) {
  refused({"los", "none.amt", "--from", "1105", "1895", "30", "--to", "1205,1895,2"}, 2,
          "--from 1105,1895,30");
  // "2" is a file here, and may be meant.
  write("2", "");
  refused({"los", "none.amt", "--from", "1105", "2", "--to", "1205,1895,2"}, 2, "not expected: 2");
}

}  // namespace
}  // namespace arete::cli_test

// SPDX-License-Identifier: GPL-3.0-or-later
//
// `extract --importance`, as the command line has it: the mesh is held against the source by `measure`.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

#include "cli/cli_fixture.h"

namespace arete::cli_test {
namespace {

class ImportanceCommands : public Cli {
 protected:
  /// A sheet of waves whose right half has the quality `right`, the left one 1.
  static std::string waves(const std::string& right) {
    constexpr int kSide = 24;
    std::ostringstream text;
    text
        << "ply\nformat ascii 1.0\nelement vertex " << (kSide + 1) * (kSide + 1)
        << "\nproperty double x\nproperty double y\nproperty double z\nproperty double quality\nelement face "
        << kSide * kSide << "\nproperty list uchar int vertex_indices\nend_header\n";
    for (int r = 0; r <= kSide; ++r)
      for (int c = 0; c <= kSide; ++c)
        text << c << ' ' << r << ' ' << std::sin(c) * std::cos(r) << ' ' << (2 * c > kSide ? right : "1")
             << '\n';
    for (int r = 0; r < kSide; ++r)
      for (int c = 0; c < kSide; ++c) {
        const int v = r * (kSide + 1) + c;
        text << "4 " << v << ' ' << v + 1 << ' ' << v + kSide + 2 << ' ' << v + kSide + 1 << '\n';
      }
    return text.str();
  }
};

TEST_F(ImportanceCommands, TheToleranceIsDividedAndSaid) {
  write("scan.ply", waves("5"));
  ASSERT_EQ(run({"build", "scan.ply", "-o", "scan.amt"}).code, 0);
  const auto extracted = [&](std::vector<std::string> more) {
    std::vector<std::string> words = {"extract", "scan.amt", "-o", "cut.ply", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.json()["exports"][0];
  };
  const Json plain = extracted({"--max-error", "0.8"}),
             cut = extracted({"--max-error", "0.8", "--importance", "quality", "--certificate", "cut.json"});
  EXPECT_GT(cut["triangles"], plain["triangles"]);
  EXPECT_EQ(cut["importance"]["name"], "quality");
  EXPECT_EQ(cut["importance"]["largest"], 5);
  EXPECT_LE(cut["importance"]["weightedError"].get<double>(), 0.8);
  EXPECT_EQ(run({"measure", "cut.ply", "scan.ply", "--samples", "2000", "--expect", "0.8"}).code, 0);
  EXPECT_EQ(Json::parse(read("cut.json"))["criterion"]["importance"], "quality");
  const Json budget = extracted({"--max-triangles", "200", "--importance", "quality"});
  EXPECT_LE(budget["triangles"], 200);
  EXPECT_GT(budget["importance"]["weightedError"], 0);
  const Outcome text =
      run({"extract", "scan.amt", "-o", "cut.ply", "--max-error", "0.8", "--importance", "quality"});
  EXPECT_NE(text.out.find("importance quality from 1 to 5; no point farther than "), std::string::npos)
      << text.out;
}

// Then no point of the whole is promised to be within the tolerance, and the certificate does not say so.
TEST_F(ImportanceCommands, LittleImportanceStatesTheErrorThatIsLeft) {
  write("scan.ply", waves("0.1"));
  ASSERT_EQ(run({"build", "scan.ply", "-o", "scan.amt"}).code, 0);
  for (const bool isNear : {false, true}) {
    std::vector<std::string> words = {"extract",     "scan.amt",     "-o",     "cut.ply",
                                      "--max-error", "0.2",          "--json", "--certificate",
                                      "cut.json",    "--importance", "quality"};
    if (isNear) words.insert(words.end(), {"--focus", "24,12,0", "--error-growth", "0.001"});
    const Outcome outcome = run(words);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_GT(outcome.json()["exports"][0]["error"].get<double>(), 0.2);
  }
}

TEST_F(ImportanceCommands, WhatCannotDivideIsRefusedByItsNameAndVertex) {
  for (const auto& [right, name, code, sentence] : {std::tuple{"0", "quality", 4, "is 0 at vertex 13 "},
                                                    {"-2", "quality", 4, "is -2 at vertex 13 "},
                                                    {"nan", "quality", 4, "is nan at vertex 13 "},
                                                    {"2", "heat", 2, "is not an attribute"}}) {
    write("scan.ply", waves(right));
    ASSERT_EQ(run({"build", "scan.ply", "-o", "scan.amt"}).code, 0);
    const Outcome outcome =
        run({"extract", "scan.amt", "-o", "cut.ply", "--max-error", "0.2", "--importance", name});
    EXPECT_EQ(outcome.code, code) << right << outcome.err;
    EXPECT_NE(outcome.err.find(std::string("--importance ") + name), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(sentence), std::string::npos) << outcome.err;
  }
  write("scan.ply", waves("2"));
  ASSERT_EQ(run({"build", "scan.ply", "-o", "scan.amt"}).code, 0);
  for (const char* const other : {"--packed", "--fit rms", "--method saturated"}) {
    std::istringstream rest(other);
    std::vector<std::string> words = {"extract",     "scan.amt", "-o",           "cut.glb",
                                      "--max-error", "0.2",      "--importance", "quality"};
    for (std::string word; rest >> word;) words.push_back(word);
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 2) << other << outcome.err;
    EXPECT_NE(outcome.err.find("--importance"), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace arete::cli_test

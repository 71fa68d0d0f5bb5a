// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <map>

#include "cli/ball_fixture.h"

namespace arete::cli_test {
namespace {

class MeshDecimate : public Balls {};

TEST_F(MeshDecimate, TakesEveryOperatorAndSaysWhatItDid) {
  std::map<std::string, double> rms;
  for (const std::string method :
       {"measured", "qem", "lindstrom-turk", "half-edge", "vertex-pair", "face", "cluster"}) {
    SCOPED_TRACE(method);
    const Outcome small = run({"mesh", "decimate", "ball.obj", "-o", "small.ply", "--max-triangles", "30%",
                               "--operator", method, "--map", "map.csv", "--json"});
    ASSERT_EQ(small.code, 0) << small.err;
    EXPECT_LE(small.json()["triangles"].get<std::size_t>(), 24u * 14 * 2 * 3 / 10);
    EXPECT_EQ(small.json()["operator"], method);
    EXPECT_EQ(read("map.csv").substr(0, 18), "what,output,input\n");
    rms[method] =
        run({"measure", "small.ply", "ball.obj", "--samples", "20000", "--json"}).json()["fromSecond"]["rms"];
  }
  EXPECT_LT(rms["measured"], rms["half-edge"]);
  EXPECT_LT(rms["qem"], rms["half-edge"]);
  EXPECT_LT(rms["half-edge"], 0.1);
}

TEST_F(MeshDecimate, KeepsADistanceAndNamesTheLeastCount) {
  const Outcome kept = run({"mesh", "decimate", "ball.obj", "-o", "kept.ply", "--max-error", "1%", "--json"});
  ASSERT_EQ(kept.code, 0) << kept.err;
  const double error = kept.json()["error"];
  EXPECT_LE(error, 0.01 * 2 * std::sqrt(3.0));
  EXPECT_LE(run({"measure", "kept.ply", "ball.obj", "--samples", "20000", "--json"})
                .json()["fromSecond"]["maximum"]
                .get<double>(),
            error);
  for (const std::string method : {"measured", "qem", "half-edge", "face"}) {
    const Outcome refused =
        run({"mesh", "decimate", "ball.obj", "-o", "no.ply", "--max-triangles", "2", "--operator", method});
    EXPECT_EQ(refused.code, 2) << method;
    EXPECT_NE(refused.err.find("the least that " + method + " reaches"), std::string::npos) << refused.err;
    EXPECT_FALSE(exists("no.ply"));
  }
  const auto refused = [&](std::vector<std::string> words, const std::string& because) {
    words.insert(words.begin(), {"mesh", "decimate", "ball.obj", "-o", "no.ply"});
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 2) << because;
    EXPECT_NE(outcome.err.find(because), std::string::npos) << outcome.err;
  };
  refused({}, "one of --max-triangles and --max-error");
  refused({"--max-error", "1", "--operator", "qem"}, "--max-error");
  refused({"--max-triangles", "9", "--queue", "greedy"}, "--queue");
  refused({"--max-triangles", "9", "--no-crossings"}, "--no-crossings");
  refused({"--max-triangles", "9.5"}, "--max-triangles");
  refused({"--max-triangles", "0%"}, "--max-triangles");
  refused({"--max-triangles", "9", "--drop-parts", "99"}, "leaves nothing");
}

TEST_F(MeshDecimate, ChecksItsNumbersBeforeItReads) {
  for (const std::vector<std::string>& numbers :
       std::vector<std::vector<std::string>>{{"--max-error", "1yd"},
                                             {"--max-triangles", "many"},
                                             {"--max-triangles", "1.5"},
                                             {"--max-error", "1", "--drop-parts", "big"}}) {
    std::vector<std::string> words = {"mesh", "decimate", "none.ply", "-o", "x.ply"};
    words.insert(words.end(), numbers.begin(), numbers.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_EQ(outcome.err.find("none.ply"), std::string::npos) << outcome.err;
  }
}

}  // namespace
}  // namespace arete::cli_test

// SPDX-License-Identifier: GPL-3.0-or-later
//
// What extract answers for a surface and for terrain alike: a deadline, an order, a focus, a certificate,
// lists. Each family of tests stands for what went wrong in other programs: a limit of time that returns
// nothing, outputs of one run that overwrite each other, a share of triangles that is ignored, a certificate
// without a check.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include "cli/ball_fixture.h"

namespace arete::cli_test {
namespace {

class SurfaceQueries : public Balls {
 protected:
  void SetUp() override {
    Balls::SetUp();
    ASSERT_EQ(run({"build", "ball.obj", "-o", "ball.amt"}).code, 0);
  }

  /// The exports of an extract that succeeds.
  Json extracted(const std::vector<std::string>& more) {
    std::vector<std::string> words = {"extract", "ball.amt", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.json()["exports"];
  }

  void expectRefused(const std::vector<std::string>& more, const std::string& because) {
    std::vector<std::string> words = {"extract", "ball.amt", "-o", "no.ply"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find(because), std::string::npos) << outcome.err;
    EXPECT_FALSE(exists("no.ply"));
  }

  /// Positions of the vertices of an OBJ.
  std::vector<std::array<double, 3>> verticesOf(const std::string& name) const {
    std::istringstream lines(read(name));
    std::vector<std::array<double, 3>> places;
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string word;
      std::array<double, 3> p{};
      if (words >> word >> p[0] >> p[1] >> p[2] && word == "v") places.push_back(p);
    }
    return places;
  }
};

TEST_F(SurfaceQueries, ADeadlineLeavesAClosedMeshHoweverEarlyItIs) {
  for (const std::string milliseconds : {"0.000001", "100000"}) {
    const Json found = extracted({"-o", "{}.obj", "--deadline", milliseconds})[0];
    EXPECT_EQ(found["deadline"], std::stod(milliseconds));
    EXPECT_GE(found["triangles"], 4);
    const std::string file = found["file"].get<std::string>();
    ASSERT_TRUE(exists(file)) << file;
    const Json mesh = run({"mesh", "info", file, "--json"}).json();
    EXPECT_EQ(mesh["components"].size(), 1u);
    EXPECT_EQ(run({"measure", file, "ball.amt", "--samples", "2000", "--expect",
                   std::to_string(found["error"].get<double>() * 1.000001 + 1e-9)})
                  .code,
              0);
  }
  EXPECT_TRUE(exists("1e-06ms.obj"));
  const Json early = extracted({"-o", "e.ply", "--deadline", "0.000001", "--max-error", "0"})[0];
  EXPECT_EQ(early["endedBy"], "deadline");
  EXPECT_EQ(early["complete"], false);
  EXPECT_GT(early["error"], 0);
  const Json late = extracted({"-o", "l.ply", "--deadline", "1000000", "--max-error", "2%"})[0];
  EXPECT_FALSE(late.contains("endedBy"));
  EXPECT_EQ(late["complete"], true);
  EXPECT_EQ(late["triangles"], extracted({"-o", "w.ply", "--max-error", "2%"})[0]["triangles"]);
  EXPECT_NE(run({"extract", "ball.amt", "-o", "t.ply", "--deadline", "0.000001", "--max-error", "0"})
                .out.find("ended by the deadline"),
            std::string::npos);
  expectRefused({"--deadline", "5", "--method", "saturated"}, "--deadline");
  expectRefused({"--deadline", "5", "--fit", "rms"}, "--fit rms");
}

TEST_F(SurfaceQueries, AnOrderDecidesWhatABudgetIsSpentOn) {
  std::map<std::string, Json> by;
  for (const std::string order : {"worst", "breadth", "depth"})
    by[order] =
        extracted({"-o", order + ".ply", "--max-triangles", "120", "--order", order, "--both-ways"})[0];
  const Json usual = extracted({"-o", "usual.ply", "--max-triangles", "120"})[0];
  for (const auto& [order, found] : by) {
    EXPECT_LE(found["triangles"], 120) << order;
    EXPECT_GE(found["error"], by["worst"]["error"]) << "worst first leaves the least error";
  }
  EXPECT_GE(usual["error"], by["worst"]["error"]);
  EXPECT_NE(read("depth.ply"), read("breadth.ply"));
  const std::vector<std::string> camera = {"--camera", "3,0,0,0,0,0", "--max-triangles", "120"};
  std::vector<std::string> queues = {"-o", "queues.ply", "--order", "two-queues"};
  queues.insert(queues.end(), camera.begin(), camera.end());
  EXPECT_LE(extracted(queues)[0]["triangles"], 120);
  expectRefused({"--max-triangles", "120", "--order", "two-queues"}, "two-queues requires --camera");
  expectRefused({"--max-error", "1%", "--order", "depth"}, "--order");
}

TEST_F(SurfaceQueries, AroundAFocusTheErrorGrowsWithTheDistance) {
  const Json found = extracted({"-o", "focus.obj", "--max-error", "0.002", "--focus", "1,0,0",
                                "--error-growth", "0.2", "--outside-error", "0.3"})[0];
  EXPECT_EQ(found["complete"], true);
  EXPECT_LE(found["error"], 0.3);
  EXPECT_LT(found["triangles"], extracted({"-o", "fine.obj", "--max-error", "0.002"})[0]["triangles"]);
  const auto places = verticesOf("focus.obj");
  const auto near = std::ranges::count_if(places, [](const auto& p) { return p[0] > 0.5; });
  EXPECT_GT(near, 2 * std::ranges::count_if(places, [](const auto& p) { return p[0] < -0.5; }));
  // A growth of 0 is a tolerance that is the same everywhere.
  const Json even =
      extracted({"-o", "even.ply", "--max-error", "2%", "--focus", "1,0,0", "--error-growth", "0"})[0];
  EXPECT_EQ(even["triangles"], extracted({"-o", "all.ply", "--max-error", "2%"})[0]["triangles"]);
  expectRefused({"--max-error", "1%", "--focus", "1,0", "--error-growth", "1"}, "is x,y,z");
  expectRefused({"--max-error", "1%", "--focus", "1,0,inf", "--error-growth", "1"}, "is x,y,z");
  expectRefused({"--max-error", "5%", "--focus", "1,0,0", "--error-growth", "1", "--outside-error", "1%"},
                "--outside-error");
  expectRefused({"--max-error", "1%", "--focus", "1,0,0"}, "--error-growth");
  expectRefused({"--max-error", "1%", "--focus", "1,0,0", "--error-growth", "1", "--region", "0,0,0,1"},
                "--region");
}

TEST_F(SurfaceQueries, ACertificateStatesWhatWasMeasuredAndItsCheckHolds) {
  const Json found = extracted({"-o", "small.glb", "--max-error", "3%", "--certificate"})[0];
  EXPECT_EQ(found["certificate"], "small.certificate.json");
  EXPECT_EQ(found["kept"], true);
  const Json certificate = readJson("small.certificate.json");
  ASSERT_FALSE(certificate.is_discarded());
  EXPECT_EQ(certificate["areteCertificate"], 1);
  EXPECT_EQ(certificate["file"], "small.glb");
  EXPECT_EQ(certificate["source"]["kind"], "surface");
  EXPECT_EQ(certificate["source"]["path"], "ball.obj");
  EXPECT_EQ(certificate["model"]["path"], "ball.amt");
  for (const Json* checksum : {&certificate["checksum"], &certificate["model"]["checksum"]})
    EXPECT_EQ(checksum->get<std::string>().size(), 16u);
  EXPECT_NE(certificate["checksum"], certificate["model"]["checksum"]);
  EXPECT_EQ(certificate["triangles"], found["triangles"]);
  EXPECT_EQ(certificate["complete"], true);
  EXPECT_EQ(certificate["promise"]["maxError"], certificate["criterion"]["maxError"]);
  EXPECT_EQ(certificate["promise"]["kept"], true);
  EXPECT_EQ(certificate["promise"]["proven"], true);
  EXPECT_LE(certificate["measured"]["fromSecond"]["maximum"], certificate["promise"]["maxError"]);
  EXPECT_GT(certificate["measured"]["fromFirst"]["maximum"], 0) << "both ways are measured";
  EXPECT_GT(certificate["format"]["rounding"][0], 0) << "it is the file that is measured, of floats";
  // The check is a command that a shell takes.
  std::istringstream check(certificate["check"].get<std::string>());
  std::vector<std::string> words;
  for (std::string word; check >> word;) words.push_back(word);
  ASSERT_EQ(words[0], "arete");
  words.erase(words.begin());
  words.emplace_back("--json");
  const Outcome checked = run(words);
  EXPECT_EQ(checked.code, 0) << certificate["check"] << checked.err;
  for (const char* way : {"fromFirst", "fromSecond", "bothWays"})
    EXPECT_EQ(checked.json()[way], certificate["measured"][way]) << "it has the same numbers";
  // A smaller promise is not kept.
  *(std::ranges::find(words, "--expect") + 1) = "1e-6";
  EXPECT_EQ(run(words).code, 5);
}

TEST_F(SurfaceQueries, ACertificateHoldsEachPlaceAgainstItsError) {
  for (const auto& [name, words] : std::map<std::string, std::vector<std::string>>{
           {"focus", {"--focus", "1,0,0", "--error-growth", "0.1"}}, {"region", {"--region", "1,0,0,0.8"}}}) {
    std::vector<std::string> all = {"-o", name + ".ply", "--max-error", "0.01", "--certificate"};
    all.insert(all.end(), words.begin(), words.end());
    EXPECT_EQ(extracted(all)[0]["kept"], true);
    const Json certificate = readJson(name + ".certificate.json");
    EXPECT_GT(certificate["measuredPlaces"]["vertices"], 20) << name;
    EXPECT_EQ(certificate["measuredPlaces"]["beyond"], 0) << name;
    EXPECT_LE(certificate["measuredPlaces"]["largestShare"], 1) << name;
    EXPECT_GT(certificate["promise"]["maxError"], 0.01) << "elsewhere it is coarser";
    EXPECT_TRUE(certificate["criterion"].contains(name)) << name;
  }
}

TEST_F(SurfaceQueries, OfAListEveryOutputHasItsOwnNames) {
  const Json exports =
      extracted({"-o", "out.ply", "--max-error", "8%,4%", "--certificate", "--map", "map.csv"});
  ASSERT_EQ(exports.size(), 2u);
  std::set<std::string> names;
  for (const Json& each : exports)
    for (const char* what : {"file", "certificate", "map"}) names.insert(each[what].get<std::string>());
  EXPECT_EQ(names, (std::set<std::string>{"out_8%.ply", "out_8%.certificate.json", "map_8%.csv", "out_4%.ply",
                                          "out_4%.certificate.json", "map_4%.csv"}));
  for (const std::string& name : names) EXPECT_TRUE(exists(name)) << name;
  const Json shares = extracted({"-o", "n{}.ply", "--max-triangles", "50%,20%"});
  for (const auto& [i, share] : {std::pair{0u, 50.0}, {1u, 20.0}}) {
    EXPECT_LE(shares[i]["trianglesPercent"], share) << "a share is not a hint";
    EXPECT_GE(shares[i]["trianglesPercent"], share - 2);
  }
  EXPECT_TRUE(exists("n50%.ply") && exists("n20%.ply"));
  expectRefused({"--max-error", "1%,1.0%"}, "twice");
  expectRefused({"--max-error", "1%", "--map", "no.ply"}, "--map");
  expectRefused({"--max-error", "1%", "--certificate", "no.ply"}, "--certificate");
  EXPECT_EQ(run({"extract", "ball.amt", "-o", "-", "--format", "ply", "--max-error", "1%,2%"}).code, 2);
  EXPECT_EQ(
      run({"extract", "ball.amt", "-o", "-", "--format", "ply", "--max-error", "1%", "--certificate"}).code,
      2);
}

TEST_F(SurfaceQueries, ACertificateOfARestNamesWhatItWasHeldAgainst) {
  std::string two = ball(24, 14);
  two += "v 5 0 0\nv 5.01 0 0\nv 5 0.01 0\nv 5 0 0.01\n";
  const int n = 2 + 24 * 14;
  const auto face = [&](int a, int b, int c) {
    two += "f " + std::to_string(n + a) + " " + std::to_string(n + b) + " " + std::to_string(n + c) + "\n";
  };
  face(1, 3, 2), face(1, 2, 4), face(2, 3, 4), face(1, 4, 3);
  write("two.obj", two);
  ASSERT_EQ(run({"build", "two.obj", "-o", "two.amt"}).code, 0);
  const Outcome rest = run(
      {"extract", "two.amt", "-o", "rest.ply", "--max-error", "1%", "--drop-parts", "10%", "--certificate"});
  ASSERT_EQ(rest.code, 0) << rest.err;
  const Json certificate = readJson("rest.certificate.json");
  EXPECT_EQ(certificate["dropped"]["components"], 1);
  EXPECT_EQ(certificate["promise"]["kept"], true);
  EXPECT_NE(certificate["check"].get<std::string>().find("--drop-parts"), std::string::npos);
}

}  // namespace
}  // namespace arete::cli_test

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Errors in percent of the relief or of the diagonal, and triangles in percent of the finest: every command
// that takes them gives the same answer as to the length or number meant, and says both.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "cli/mesh_fixture.h"
#include "io/geo/dem/raster_reader.h"
#include "terrain/model/relief.h"

namespace arete::cli_test {
namespace {

class Percent : public Meshes {
 protected:
  void SetUp() override {
    Meshes::SetUp();
    makeRaster("dem.tif", "fractal", 40, 30);
    ASSERT_EQ(run({"build", "dem.tif", "-o", "dem.amt", "-q"}).code, 0);
    relief_ = reliefOf(readRaster(path("dem.tif"))->heightfield.heights);
    const Json grid = run({"info", "dem.amt", "--json"}).json()["grid"]["geoTransform"];
    place_ = [=](double column, double row) {
      return fmt::format("{},{}", grid[0].get<double>() + grid[1].get<double>() * column,
                         grid[3].get<double>() + grid[5].get<double>() * row);
    };
  }

  /// The answer with a share, which is that with the length but for the fields that state the share.
  Json sameAsLength(std::vector<std::string> words, const std::string& share, double length) const {
    words.insert(words.end(), {"--json", "--max-error", share});
    const Outcome stated = run(words);
    EXPECT_EQ(stated.code, 0) << words[0] << stated.err;
    words.back() = fmt::format("{}", length);
    const Json inPercent = stated.json();
    Json inUnit = run(words).json();
    EXPECT_TRUE(inPercent.is_object() && inUnit.is_object()) << words[0];
    EXPECT_EQ(inPercent["maxError"].get<double>(), length) << words[0];
    EXPECT_NEAR(inPercent["maxErrorPercent"].get<double>(), std::stod(share), 1e-9) << words[0];
    EXPECT_EQ(inPercent["relief"], relief_) << words[0];
    Json same = inPercent;
    same.erase("maxErrorPercent");
    same.erase("relief");
    // The second run writes over the files of the first.
    for (Json* answer : {&same, &inUnit}) answer->erase("replaced");
    EXPECT_EQ(same, inUnit) << words[0];
    return inPercent;
  }

  double relief_ = 0;
  std::function<std::string(double, double)> place_;
};

TEST_F(Percent, OfTheReliefIsTakenByEveryQueryOfTerrain) {
  const std::string from = place_(3.5, 4.5), to = place_(30.5, 20.5);
  for (const char* share : {"5%", "0%", "0.25%", "30%"}) {
    const double length = std::stod(share) / 100 * relief_;
    sameAsLength({"height", "dem.amt", "--at", from}, share, length);
    sameAsLength({"profile", "dem.amt", "--along", from + ":" + to}, share, length);
    sameAsLength({"los", "dem.amt", "--from", from + ",10", "--to", to + ",10"}, share, length);
    sameAsLength({"viewshed", "dem.amt", "--observer", from + ",10", "-o", "seen.tif", "--method", "rays"},
                 share, length);
  }
}

TEST_F(Percent, OfTheReliefIsSaidBesideItsLength) {
  const std::string from = place_(3.5, 4.5), to = place_(30.5, 20.5), both = "(5 % of the relief)";
  const std::vector<std::vector<std::string>> queries = {
      {"height", "dem.amt", "--at", from},
      {"height", "dem.amt", "--at", from, "-o", "heights.csv"},
      {"profile", "dem.amt", "--along", from + ":" + to},
      {"profile", "dem.amt", "--along", from + ":" + to, "-o", "profile.csv"},
      {"los", "dem.amt", "--from", from + ",10", "--to", to + ",10"},
      {"viewshed", "dem.amt", "--observer", from + ",10", "-o", "seen.tif"},
  };
  for (std::vector<std::string> words : queries) {
    words.insert(words.end(), {"--max-error", "5%"});
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_TRUE(says(outcome, both)) << words[0] << ": " << outcome.out << outcome.err;
    EXPECT_TRUE(says(outcome, fmt::format("{:.4g}", relief_ / 20).substr(0, 3)))
        << outcome.out << outcome.err;
    EXPECT_FALSE(says(outcome, "warning")) << outcome.err;
    words.back() = fmt::format("{}", relief_ / 20);
    EXPECT_FALSE(says(run(words), "%")) << words[0];
  }
  // A table on stdout is one of numbers alone.
  const Outcome table = run({"height", "dem.amt", "--at", from, "--max-error", "5%"});
  EXPECT_EQ(std::count(table.out.begin(), table.out.end(), '\n'), 1) << table.out;
  EXPECT_EQ(table.out.find('%'), std::string::npos);
}

TEST_F(Percent, ThatIsNoneIsRefusedByTheNameOfTheOption) {
  const std::string from = place_(3.5, 4.5), to = place_(30.5, 20.5);
  for (const char* wrong : {"-5%", "%", "x%", "inf%", "nan%", "5%%", "-1"})
    for (std::vector<std::string> words :
         {std::vector<std::string>{"height", "dem.amt", "--at", from},
          {"profile", "dem.amt", "--along", from + ":" + to},
          {"los", "dem.amt", "--from", from + ",1", "--to", to + ",1"},
          {"viewshed", "dem.amt", "--observer", from + ",1", "-o", "v.tif"}}) {
      words.push_back(fmt::format("--max-error={}", wrong));
      const Outcome outcome = run(words);
      EXPECT_EQ(outcome.code, 2) << words[0] << wrong << outcome.out;
      EXPECT_TRUE(says(outcome, "--max-error")) << outcome.err;
    }
  EXPECT_FALSE(exists("v.tif"));
  EXPECT_EQ(run({"los", "dem.amt", "--from", from + ",1", "--to", to + ",1", "--max-error", "inf"}).code, 2);
}

TEST_F(Percent, OfTheReliefAndOfTheFinestIsAnsweredByExtractInfoAndMeasure) {
  const Json answer =
      run({"extract", "dem.amt", "-o", "t.ply", "--json", "--max-error", "5%", "--max-triangles", "50%"})
          .json();
  const double finest = answer["finestTriangles"].get<double>();
  const Json& tin = answer["exports"][0];
  EXPECT_NEAR(tin["maxErrorPercent"].get<double>(), 5, 1e-9);
  EXPECT_NEAR(tin["trianglesPercent"].get<double>(), 100 * tin["triangles"].get<double>() / finest, 1e-9);
  const Outcome text = run({"extract", "dem.amt", "-o", "t.ply", "--max-triangles", "50%"});
  EXPECT_TRUE(says(text, "% of the finest)")) << text.out;
  EXPECT_TRUE(says(text, "% of the relief)")) << text.out;
  const Json info = run({"info", "dem.amt", "--json", "--at", "5%"}).json();
  EXPECT_NEAR(info["curve"][0]["maxErrorPercent"].get<double>(), 5, 1e-9);
  EXPECT_TRUE(says(run({"info", "dem.amt", "--at", "5%"}), " 5 %"));
  for (const std::string& expect : {std::string("50%"), fmt::format("{}", relief_ / 2)}) {
    const Json measured = run({"measure", "t.ply", "dem.tif", "--expect", expect, "--json"}).json();
    EXPECT_NEAR(measured["expectPercent"].get<double>(), 50, 1e-9);
    EXPECT_NEAR(measured["expect"].get<double>(), relief_ / 2, 1e-9 * relief_);
    EXPECT_TRUE(says(run({"measure", "t.ply", "dem.tif", "--expect", expect}), "(50 % of the relief)"));
  }
}

TEST_F(Percent, OfTheDiagonalAndOfTheFinestIsAnsweredForSurfaces) {
  ASSERT_EQ(run({"extract", "dem.amt", "-o", "s.ply", "--max-error", "0", "-q"}).code, 0);
  ASSERT_EQ(run({"build", "s.ply", "-o", "s.amt", "-q"}).code, 0);
  const Json answer =
      run({"extract", "s.amt", "-o", "t.ply", "--json", "--max-error", "2%", "--max-triangles", "60%"})
          .json();
  const double diagonal = answer["diagonal"].get<double>(), finest = answer["finestTriangles"].get<double>();
  const Json& cut = answer["exports"][0];
  EXPECT_NEAR(cut["maxError"].get<double>(), diagonal / 50, 1e-12 * diagonal);
  EXPECT_NEAR(cut["maxErrorPercent"].get<double>(), 2, 1e-9);
  EXPECT_NEAR(cut["trianglesPercent"].get<double>(), 100 * cut["triangles"].get<double>() / finest, 1e-9);
  const Outcome text = run({"extract", "s.amt", "-o", "t.ply", "--max-triangles", "60%"});
  EXPECT_TRUE(says(text, "% of the finest)") && says(text, "% of the diagonal)")) << text.out;
  EXPECT_NEAR(
      run({"info", "s.amt", "--json", "--at", "2%"}).json()["curve"][0]["maxErrorPercent"].get<double>(), 2,
      1e-9);
  for (const char* method : {"measured", "qem"}) {
    const Json small = run({"mesh", "decimate", "s.ply", "-o", "d.ply", "--json", "--operator", method,
                            "--max-triangles", "60%"})
                           .json();
    EXPECT_EQ(small["maxTriangles"], std::uint64_t(0.6 * small["trianglesBefore"].get<double>())) << method;
    EXPECT_NEAR(small["trianglesPercent"].get<double>(),
                100 * small["triangles"].get<double>() / small["trianglesBefore"].get<double>(), 1e-9);
    EXPECT_LE(small["trianglesPercent"].get<double>(), 60);
    const Outcome said =
        run({"mesh", "decimate", "s.ply", "-o", "d.ply", "--operator", method, "--max-triangles", "60%"});
    EXPECT_TRUE(says(said, fmt::format("{:.4g} % of them", small["trianglesPercent"].get<double>())))
        << said.out;
  }
  const Json near = run({"mesh", "decimate", "s.ply", "-o", "d.ply", "--json", "--max-error", "2%"}).json();
  EXPECT_NEAR(near["maxErrorPercent"].get<double>(), 2, 1e-9);
  EXPECT_NEAR(near["maxError"].get<double>(), near["diagonal"].get<double>() / 50, 1e-9 * diagonal);
  EXPECT_NEAR(near["errorPercent"].get<double>(), 100 * near["error"].get<double>() / diagonal, 1e-6);
}

TEST_F(Percent, AreNotReachedWhereEveryFaceHasALabelOfItsOwnAndTheAttributeIsNamed) {
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 100\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face 162\nproperty list uchar int vertex_indices\nproperty int id\nend_header\n";
  for (int i = 0; i < 100; ++i) text += fmt::format("{} {} {}\n", i / 10, i % 10, i * 7 % 5);
  int id = 0;
  for (int i = 0; i < 90; ++i)
    if (i % 10 < 9) {
      text += fmt::format("3 {} {} {} {}\n", i, i + 10, i + 11, id++);
      text += fmt::format("3 {} {} {} {}\n", i, i + 11, i + 1, id++);
    }
  write("ids.ply", text);
  const std::string named = "\"id\" differs from face to face: ",
                    option = "--drop-attributes id leaves it out";
  for (const char* method : {"measured", "qem", "lindstrom-turk", "half-edge", "face"}) {
    const Outcome outcome =
        run({"mesh", "decimate", "ids.ply", "-o", "d.ply", "--max-triangles", "50", "--operator", method});
    EXPECT_EQ(outcome.code, 2) << method;
    EXPECT_TRUE(says(outcome, named + option)) << method << ": " << outcome.err;
  }
  EXPECT_TRUE(says(run({"mesh", "decimate", "ids.ply", "-o", "d.ply", "--max-error", "5%"}), named + option));
  EXPECT_TRUE(says(run({"build", "ids.ply", "-o", "ids.amt"}), named + option));
  for (const auto& [limit, value] : {std::pair{"--max-error", "5%"}, {"--max-triangles", "50"}})
    EXPECT_TRUE(
        says(run({"extract", "ids.amt", "-o", "e.ply", limit, value}), named + "arete build with " + option))
        << limit;
  const Outcome without = run({"build", "ids.ply", "-o", "none.amt", "--drop-attributes", "id"});
  EXPECT_FALSE(says(without, "differs from face to face")) << without.out;
  EXPECT_EQ(run({"extract", "none.amt", "-o", "e.ply", "--max-triangles", "50", "-q"}).code, 0);
  EXPECT_EQ(run({"mesh", "decimate", "ids.ply", "-o", "d.ply", "--max-triangles", "50", "--drop-attributes",
                 "id", "-q"})
                .code,
            0);
}

TEST_F(Percent, BesideThemAPlyOfDoublesSaysWhatItsFloatsWouldMove) {
  // A ball of floats, whose fitted vertices are doubles; one whose vertices stay is of floats.
  std::string text =
      "ply\nformat binary_little_endian 1.0\nelement vertex 114\nproperty float x\nproperty float y\n"
      "property float z\nelement face 224\nproperty list uchar int vertex_indices\nend_header\n";
  const auto put = [&](auto value) { text.append(reinterpret_cast<const char*>(&value), sizeof value); };
  const auto putVertex = [&](double x, double y, double z) {
    for (const double number : {x, y, z}) put(float(number));
  };
  const auto putFace = [&](int i, int j, int k) {
    put(std::uint8_t{3});
    for (const int corner : {i, j, k}) put(std::int32_t(corner));
  };
  constexpr double kStep = 0.3926990817;
  putVertex(0, 0, 1);
  for (int i = 1; i < 8; ++i)
    for (int k = 0; k < 16; ++k)
      putVertex(std::sin(kStep * i) * std::cos(kStep * k), std::sin(kStep * i) * std::sin(kStep * k),
                std::cos(kStep * i));
  putVertex(0, 0, -1);
  for (int k = 0; k < 16; ++k) {
    const int next = (k + 1) % 16;
    putFace(0, 1 + k, 1 + next);
    putFace(113, 97 + next, 97 + k);
    for (int i = 0; i < 6; ++i) {
      const int at = 1 + 16 * i;
      putFace(at + k, at + 16 + k, at + 16 + next);
      putFace(at + k, at + 16 + next, at + next);
    }
  }
  write("ball.ply", text);
  for (const char* method : {"measured", "qem", "half-edge"}) {
    const std::vector<std::string> words = {"mesh",       "decimate", "ball.ply",        "-o", "small.ply",
                                            "--operator", method,     "--max-triangles", "100"};
    const Outcome said = run(words);
    ASSERT_EQ(said.code, 0) << said.err;
    const bool hasDoubles = read("small.ply").find("property double x") != std::string::npos;
    EXPECT_EQ(hasDoubles, std::string_view(method) != "half-edge") << method;
    EXPECT_EQ(says(said, "coordinates take twice the bytes"), hasDoubles) << said.out;
    std::vector<std::string> more = words;
    more.push_back("--json");
    const Json json = run(more).json();
    EXPECT_EQ(json["movedByFloats"].get<double>() > 0, hasDoubles) << method;
    EXPECT_LT(json["movedByFloats"].get<double>(), 1e-7);
  }
  ASSERT_EQ(run({"build", "ball.ply", "-o", "ball.amt", "-q"}).code, 0);
  EXPECT_FALSE(
      says(run({"extract", "ball.amt", "-o", "a.ply", "--max-triangles", "100"}), "twice the bytes"));
  EXPECT_TRUE(says(run({"extract", "ball.amt", "-o", "b.ply", "--max-triangles", "100", "--fit", "rms"}),
                   "twice the bytes"));
  EXPECT_FALSE(says(run({"extract", "ball.amt", "-o", "b.stl", "--max-triangles", "100", "--fit", "rms"}),
                    "twice the bytes"));
  EXPECT_FALSE(says(run({"convert", "ball.ply", "-o", "c.ply"}), "twice the bytes"));
}

TEST_F(Percent, OfTheReliefAreThePersistenceOfFeatures) {
  for (const auto& [share, length] : {std::pair{"10%", relief_ / 10}, {"1%", relief_ / 100}}) {
    const Json inPercent =
        run({"build", "dem.tif", "-o", "a.amt", "--json", "--feature-persistence", share}).json();
    const Json inUnit =
        run({"build", "dem.tif", "-o", "b.amt", "--json", "--feature-persistence", fmt::format("{}", length)})
            .json();
    EXPECT_EQ(inPercent["features"], inUnit["features"]) << share;
    EXPECT_EQ(read("a.amt"), read("b.amt")) << share;
  }
  const Outcome text = run({"build", "dem.tif", "-o", "a.amt", "--feature-persistence", "10%"});
  EXPECT_TRUE(says(text, "(10 % of the relief)")) << text.err;
}

}  // namespace
}  // namespace arete::cli_test

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Packed files, of which questions read no more than they need: their answers are those of plain files.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cli/cli_fixture.h"
#include "full_run.h"
#include "io/geo/dem/raster_reader.h"

namespace arete::cli_test {
namespace {

class PackedFiles : public Cli {
 protected:
  /// Both models give the same answers and the same files.
  void expectAlike(const std::vector<std::vector<std::string>>& questions) const {
    for (const auto& question : questions) {
      SCOPED_TRACE(fmt::format("{}", fmt::join(question, " ")));
      std::map<std::string, std::string> answers;
      for (const std::string model : {"plain", "packed"}) {
        std::vector<std::string> words = question;
        const std::string name = model + ".amt";
        words.insert(words.begin() + 1, name);
        const Outcome outcome = run(words);
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        std::string& answer = answers[model] = outcome.out;
        for (std::size_t at = 0; (at = answer.find(name)) != std::string::npos;)
          answer.replace(at, name.size(), "MODEL");
        for (const std::string& file : files())
          if (file.rfind("tin", 0) == 0) {
            answer += read(file);
            fs::remove(path(file));
          }
      }
      EXPECT_FALSE(answers["plain"].empty());
      EXPECT_TRUE(answers["plain"] == answers["packed"]) << answers["packed"].substr(0, 2000);
    }
  }
};

TEST_F(PackedFiles, GiveTheSameTinsThoughTheirBeginningsAreRead) {
  const std::uint32_t part = test::isBrief() ? 2 : 1;
  makeRaster("dem.tif", "fractal", 160 / part, 130 / part);
  for (const std::string shape : {"delaunay", "fidelity"}) {
    ASSERT_EQ(run({"build", "dem.tif", "-o", "packed.amt", "--packed", "--shape", shape, "-q"}).code, 0);
    ASSERT_EQ(run({"convert", "packed.amt", "-o", "plain.amt", "-q"}).code, 0);
    const std::vector<std::vector<std::string>> criteria = {
        {"--max-error", "0"},
        {"--max-error", "0.5"},
        {"--max-error", "7"},
        {"--max-error", "3", "--method", "saturated"},
        {"--max-error", "3", "--focus", "500300,4500400", "--error-growth", "0.01"},
        {"--max-error", "3", "--focus", "500300,4500400", "--error-growth", "0.01", "--method", "saturated"},
        {"--max-error", "6", "--fit", "triangles"},
        {"--max-triangles", "500"}};
    for (const auto& criterion : criteria)
      for (const std::string extension : {".ply", ".2dm", ".stl"}) {
        SCOPED_TRACE(criterion[0] + " " + criterion[1] + " " + criterion.back() + extension);
        for (const std::string model : {"packed", "plain"}) {
          std::vector<std::string> words = {"extract", model + ".amt", "-o", model + extension};
          words.insert(words.end(), criterion.begin(), criterion.end());
          const Outcome extracted = run(words);
          ASSERT_EQ(extracted.code, 0) << extracted.err;
        }
        EXPECT_TRUE(read("packed" + extension) == read("plain" + extension));
      }
  }
}

TEST_F(PackedFiles, AnswerByPlaceAsPlainOnes) {
  // Four by three tiles, so that most chunks are far from a place.
  makeRaster("dem.tif", "fractal", 420, 300);
  ASSERT_EQ(run({"build", "dem.tif", "-o", "packed.amt", "--packed", "-q"}).code, 0);
  ASSERT_EQ(run({"convert", "packed.amt", "-o", "plain.amt", "-q"}).code, 0);
  const auto dem = readRaster(path("dem.tif"));
  ASSERT_TRUE(dem);
  const auto place = [&](double column, double row) {
    const Vec2 xy = dem->heightfield.georeference.toSource(column, row);
    return fmt::format("{},{}", xy.x, xy.y);
  };
  const Vec2 low = dem->heightfield.georeference.toSource(40.5, 90.25),
             high = dem->heightfield.georeference.toSource(110.25, 30.5);
  const std::string corner = fmt::format("{},{},{},{}", std::min(low.x, high.x), std::min(low.y, high.y),
                                         std::max(low.x, high.x), std::max(low.y, high.y));
  write("places.csv", fmt::format("x,y\n{}\n{}\n", place(5, 7), place(400.5, 200.25)));
  write("pairs.csv", fmt::format("x1,y1,h1,x2,y2,h2\n{},30,{},20\n", place(5, 7), place(60, 80)));
  const std::string mast = fmt::format("{},30", place(300, 20)), hut = fmt::format("{},20", place(380.5, 90)),
                    walk = fmt::format("{}:{}:{}", place(300, 20), place(380.5, 90), place(300, 100)),
                    link = fmt::format("{}:{}", mast, hut),
                    brook = fmt::format("{}:{}", place(10, 200), place(12, 290));
  const std::vector<std::vector<std::string>> questions = {
      {"height", "--at", place(33.25, 44.5)},
      {"height", "--points", "places.csv"},
      {"height", "--at", place(33.25, 44.5), "--max-error", "3", "--json"},
      {"los", "--from", mast, "--to", hut},
      {"los", "--pairs", "pairs.csv"},
      {"los", "--pairs", "pairs.csv", "--frequency", "2400"},
      {"los", "--pairs", "pairs.csv", "--clutter", "5"},
      {"los", "--pairs", "pairs.csv", "--method", "pyramid"},
      {"los", "--pairs", "pairs.csv", "--max-error", "4"},
      {"profile", "--along", walk},
      {"profile", "--along", link, "--frequency", "900"},
      {"profile", "--along", brook, "--max-error", "2"},
      {"extract", "-o", "tin.ply", "--max-error", "1", "--region", corner},
      {"extract", "-o", "tin.ply", "--max-error", "1", "--region", corner, "--outside-error", "20"},
      {"extract", "-o", "tin.obj", "--max-error", "0.5,2", "--region", corner, "--outside-error", "20"},
      {"extract", "-o", "tin.ply", "--max-error", "1", "--region", corner, "--method", "saturated"},
      {"extract", "-o", "tin.ply", "--max-error", "1", "--focus", place(100, 50), "--error-growth", "0.01"}};
  expectAlike(questions);
}

TEST_F(PackedFiles, AnswerByPlaceAsPlainOnesOverPoints) {
  std::string points = "x,y,z\n";
  for (int i = 0; i < 900; ++i) {
    const double x = 500000 + 1000 * std::fmod(i * 0.618034, 1),
                 y = 5200000 + 1000 * std::fmod(i * 0.41421, 1);
    points += fmt::format("{:.3f},{:.3f},{:.2f}\n", x, y, 100 + 80 * std::sin(x / 90) * std::cos(y / 70));
  }
  write("points.csv", points);
  ASSERT_EQ(run({"build", "points.csv", "--crs", "EPSG:32632", "-o", "packed.amt", "--packed", "-q"}).code,
            0);
  ASSERT_EQ(run({"convert", "packed.amt", "-o", "plain.amt", "-q"}).code, 0);
  expectAlike(
      {{"height", "--at", "500333,5200444"},
       {"los", "--from", "500100,5200100,5", "--to", "500900,5200800,5"},
       {"profile", "--along", "500100,5200100:500900,5200800"},
       {"extract", "-o", "tin.ply", "--max-error", "2", "--region", "500100,5200100,500300,5200300"}});
}

}  // namespace
}  // namespace arete::cli_test

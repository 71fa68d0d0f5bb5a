// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every engine against the oracle: pairs of places over generated terrain, most of them made to be hard.
// ARETE_FULL=1 takes a million of them.
#include "terrain/sight/engine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <thread>

#include "datasets/families.h"
#include "engine/cut/cut.h"
#include "full_run.h"
#include "terrain/builder/build.h"
#include "terrain/sight_pairs.h"

namespace arete::test {
namespace {

/// An engine under test, and what it may be asked.
struct Engine {
  std::string name;
  std::unique_ptr<SightEngine> engine;
  bool takesTolerance = false;
};

struct Tally {
  std::uint64_t pairs = 0, visible = 0, blocked = 0, unknown = 0, close = 0, touching = 0, hangs = 0,
                between = 0;
  std::uint64_t undecided = 0, tolerant = 0;
  std::map<std::string, std::uint64_t> hangsOf;

  void add(const SightAnswer& answer, const OracleAnswer& truth, double unit) {
    ++pairs;
    visible += answer.verdict == SightVerdict::visible;
    blocked += answer.verdict == SightVerdict::blocked;
    unknown += answer.verdict == SightVerdict::unknown;
    touching += answer.isTouching;
    close += truth.clearance && std::fabs(*truth.clearance) * unit <= 0.1L;
  }
  void print(const std::string& name) const {
    const auto percent = [&](std::uint64_t n) {
      return 100.0 * double(n) / double(std::max<std::uint64_t>(1, pairs));
    };
    std::printf(
        "%s: %llu pairs, %.1f %% visible, %.1f %% blocked, %.1f %% unknown, %.1f %% within 0.1 m, "
        "%.1f %% touching, %llu hang on rounding, %.1f %% of %llu undecided\n",
        name.c_str(), (unsigned long long)pairs, percent(visible), percent(blocked), percent(unknown),
        percent(close), percent(touching), (unsigned long long)hangs,
        100.0 * double(undecided) / double(std::max<std::uint64_t>(1, tolerant)),
        (unsigned long long)tolerant);
    for (const auto& [kind, count] : hangsOf)
      std::printf("    %s: %llu\n", kind.c_str(), (unsigned long long)count);
  }
};

/// What is wrong, of one pair and all engines; empty where nothing is.
std::string judged(const SightOracle& oracle, const SightPair& pair, const OracleAnswer& truth,
                   const std::vector<Engine>& engines, Random& random, Tally& tally) {
  SightOptions options;
  const std::uint32_t policy = random.below(10);
  options.nodata = policy == 0  ? NodataSight::blocked
                   : policy < 4 ? NodataSight::unknown
                                : NodataSight::clear;
  const SightLine line = lineOf(pair);
  Rounding rounding = Rounding::none;
  bool hangsSomewhere = false, isBetween = false;
  const auto wrongHere = [&](const SightPair& asked, const SightAnswer& answer, const OracleAnswer& true_) {
    std::string what = wrongBeyondRounding(oracle, asked, options, answer, true_, rounding);
    hangsSomewhere |= rounding != Rounding::none;
    isBetween |= rounding == Rounding::between;
    return what;
  };
  std::optional<SightAnswer> first;
  for (const Engine& engine : engines) {
    options.wantsClearance = true;
    options.maxError = 0;
    const SightAnswer answer = engine.engine->answer(line, options);
    if (auto what = wrongHere(pair, answer, truth); !what.empty()) return engine.name + ": " + what;
    // Without the clearance: the same verdict, the same obstruction.
    options.wantsClearance = false;
    const SightAnswer quick = engine.engine->answer(line, options);
    if (auto what = wrongHere(pair, quick, truth); !what.empty())
      return engine.name + " without clearance: " + what;
    if (quick.verdict != answer.verdict) return engine.name + ": another verdict without the clearance";
    options.wantsObstruction = false;
    const SightAnswer shortest = engine.engine->answer(line, options);
    if (auto what = wrongHere(pair, shortest, truth); !what.empty())
      return engine.name + " without obstruction: " + what;
    options.wantsObstruction = true;
    if (!first) {
      first = answer;
      tally.add(answer, truth, pair.unit);
    }
    const double c = answer.clearance.value_or(0);
    if (answer.verdict != first->verdict && !hangsSomewhere &&
        std::fabs(std::fabs(c) - line.tolerance()) > 0.5 * line.tolerance())
      return engine.name + ": another verdict than " + engines.front().name;
    // From the other end, every third time.
    if (random.below(3) == 0) {
      const SightPair back = reversed(pair);
      options.wantsClearance = true;
      const SightAnswer again = engine.engine->answer(lineOf(back), options);
      const OracleAnswer truthAgain = oracle.ask(back.track, back.from, back.to, back.unit);
      if (auto what = wrongHere(back, again, truthAgain); !what.empty())
        return engine.name + " from the other end: " + what;
    }
    if (engine.takesTolerance && random.below(2)) {
      options.wantsClearance = random.below(2) == 0;
      options.maxError = std::pow(10.0, random.between(-3, 2)) / pair.unit;
      const SightAnswer coarse = engine.engine->answer(line, options);
      if (auto what = wrongHere(pair, coarse, truth); !what.empty())
        return engine.name + " within " + std::to_string(options.maxError) + ": " + what;
      ++tally.tolerant;
      tally.undecided += coarse.verdict == SightVerdict::undecided;
    }
  }
  tally.hangs += hangsSomewhere;
  tally.between += isBetween;
  if (hangsSomewhere) ++tally.hangsOf[pair.kind];
  return {};
}

/// The grounds that a raster's pairs are tried on: a plane, the Earth, worlds so small that metres matter.
std::vector<SightGround> grounds(double highest) {
  std::vector<SightGround> all = {
      {30, 0, 1}, {30, 6.0 / 7 / 6371000, 1}, {900, 1 / 6371000.0, 0.3048}, {10, 1e-7, 0.3048}};
  if (highest < 1e5) {
    all.push_back({25, 1e-5, 1});
    all.push_back({4, 1e-4, 0.01, 0.1});
    all.push_back({0.6, 1e-3, 0.001, 0.01});
    all.push_back({25, -1e-5, 1});
  }
  return all;
}

void tryPairs(const SightTerrain& terrain, const std::vector<Engine>& engines, std::uint64_t seed, int count,
              Tally& tally, int& failures) {
  const std::vector<SightGround> worlds = grounds(terrain.highest);
  Random random(seed * 77 + 5);
  const std::size_t first = random.below(static_cast<std::uint32_t>(worlds.size()));
  for (std::size_t w = 0; w < worlds.size(); ++w) {
    SightGround ground = worlds[(first + w) % worlds.size()];
    if (!terrain.isRaster) {
      const Box2& b = terrain.box;
      ground.metresPerStep *= 60 / std::max(b.xMax - b.xMin, b.yMax - b.yMin);
    }
    SightPairs pairs(terrain, ground, seed * 1000 + w);
    for (int i = 0; i < count / int(worlds.size()); ++i) {
      const SightPair pair = pairs.next();
      const std::string what = judged(*terrain.oracle, pair, pairs.answer(), engines, random, tally);
      if (what.empty()) continue;
      ADD_FAILURE() << what << "\n  seed " << seed << ", pair " << i << ": " << describe(pair);
      if (++failures > 20) return;
    }
  }
}

/// The pairs were as hard as they are meant to be, and the engines were held to them.
void expectHard(const Tally& tally, bool hasVoids) {
  const auto share = [&](std::uint64_t n) { return double(n) / double(tally.pairs); };
  EXPECT_GE(share(tally.visible), hasVoids ? 0.2 : 0.3);  // of the others many are unknown
  EXPECT_GE(share(tally.blocked), 0.3);
  EXPECT_GE(share(tally.close), 0.1);
  EXPECT_LE(share(tally.hangs), hasVoids ? 0.05 : 0.005);
  EXPECT_LE(share(tally.between), 0.001);
}

class SightEnginesOnRasters : public testing::TestWithParam<RasterFamily> {};
class SightDescents : public testing::TestWithParam<RasterFamily> {};

TEST_P(SightEnginesOnRasters, AreNeverWrong) {
  Tally tally;
  int failures = 0;
  const int wanted = isFull() ? 60'000 : 6'000;
  bool hasVoids = false;
  constexpr std::array<std::array<std::uint32_t, 2>, 6> kSizes = {
      {{33, 21}, {20, 47}, {60, 60}, {2, 2}, {2, 33}, {9, 9}}};
  for (std::uint64_t seed = 1; seed <= kSizes.size(); ++seed) {
    const auto [columns, rows] = kSizes[seed - 1];
    const RasterHeightfield field = GetParam().make(columns, rows, seed);
    const SightOracle oracle(field);
    const SightTerrain terrain = terrainOf(field, oracle);
    auto grid = std::make_shared<SightGrid>(field.columns, field.rows, field.heights);
    std::vector<Engine> engines;
    engines.push_back({"scan", makeSightScan(grid)});
    engines.push_back({"pyramid", makeSightPyramid(grid)});
    hasVoids |= !terrain.holes.empty();
    tryPairs(terrain, engines, seed, wanted / int(kSizes.size()), tally, failures);
    if (failures > 20) break;
  }
  tally.print(std::string(GetParam().name));
  expectHard(tally, hasVoids);
}

class SightEnginesWithoutTerrain : public testing::TestWithParam<RasterFamily> {};

TEST_P(SightEnginesWithoutTerrain, FindNothingInTheWayAndSayThatNothingIsKnown) {
  Tally tally;
  int failures = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const RasterHeightfield field = GetParam().make(20, 15, seed);
    const SightOracle oracle(field);
    const SightTerrain terrain = terrainOf(field, oracle);
    auto grid = std::make_shared<SightGrid>(field.columns, field.rows, field.heights);
    std::vector<Engine> engines;
    engines.push_back({"scan", makeSightScan(grid)});
    engines.push_back({"pyramid", makeSightPyramid(grid)});
    tryPairs(terrain, engines, seed, 500, tally, failures);
  }
  tally.print(std::string(GetParam().name));
  EXPECT_EQ(tally.close, 0u);
  EXPECT_GT(tally.unknown, 0u);
}

/// The descent needs a triangulation, so it has fewer rasters than the other two, which are asked as well.
TEST_P(SightDescents, OnRastersAreNeverWrong) {
  Tally tally;
  int failures = 0;
  const int wanted = isFull() ? 12'000 : 1'200;
  bool hasVoids = false;
  constexpr std::array<std::array<std::uint32_t, 2>, 3> kSizes = {{{25, 21}, {41, 37}, {3, 33}}};
  for (std::uint64_t seed = 1; seed <= kSizes.size(); ++seed)
    for (const BuildOptions& options :
         {BuildOptions{}, BuildOptions{.shape = HoleShape::dataDependent}, BuildOptions{.rimTolerance = 3}}) {
      const auto [columns, rows] = kSizes[seed - 1];
      const RasterHeightfield field = GetParam().make(columns, rows, seed);
      const auto model = build(field, options);
      ASSERT_TRUE(model) << GetParam().name;
      const SightOracle oracle(field);
      const SightTerrain terrain = terrainOf(field, oracle);
      std::vector<Engine> engines;
      engines.push_back({"descent", makeSightDescent(*model), true});
      engines.push_back({"embree", makeSightEmbree(*model)});
      hasVoids |= !terrain.holes.empty();
      tryPairs(terrain, engines, seed + 100, wanted / int(3 * kSizes.size()), tally, failures);
    }
  tally.print(std::string(GetParam().name));
  expectHard(tally, hasVoids);
}

class SightDescentsOnPoints : public testing::TestWithParam<PointFamily> {};

TEST_P(SightDescentsOnPoints, AreNeverWrong) {
  Tally tally;
  int failures = 0;
  const int wanted = isFull() ? 40'000 : 4'000;
  constexpr std::array<std::uint32_t, 4> kSizes = {4, 30, 200, 700};
  for (std::uint64_t seed = 1; seed <= kSizes.size(); ++seed)
    for (const HoleShape shape : {HoleShape::delaunay, HoleShape::dataDependent}) {
      const PointHeightfield field = GetParam().make(kSizes[seed - 1], seed);
      const auto model = build(field, {.shape = shape});
      ASSERT_TRUE(model) << GetParam().name;
      const Cut finest = frontOfPrefix(model->mt, model->mt.nodeCount());
      const SightOracle oracle(model->mt, finest);
      const SightTerrain terrain = terrainOf(model->mt, finest, oracle);
      std::vector<Engine> engines;
      engines.push_back({"descent", makeSightDescent(*model), true});
      tryPairs(terrain, engines, seed + 200, wanted / int(2 * kSizes.size()), tally, failures);
    }
  tally.print(std::string(GetParam().name));
  expectHard(tally, true);
}

TEST(SightEngines, GiveTheSameAnswersOnManyThreads) {
  const RasterHeightfield field = rasterFamilies()[6].make(60, 50, 8);
  const auto model = build(field);
  ASSERT_TRUE(model);
  const SightOracle oracle(field);
  const SightTerrain terrain = terrainOf(field, oracle);
  SightPairs pairs(terrain, {30, 1e-7}, 9);
  std::vector<SightLine> lines;
  for (int i = 0; i < 400; ++i) lines.push_back(lineOf(pairs.next()));
  for (const SightMethod method :
       {SightMethod::scan, SightMethod::pyramid, SightMethod::descent, SightMethod::embree}) {
    const auto engine = makeSightEngine(method, *model);
    ASSERT_TRUE(engine);
    std::vector<SightAnswer> alone, together(lines.size());
    for (const SightLine& line : lines) alone.push_back((*engine)->answer(line, {}));
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < 4; ++t)
      threads.emplace_back([&, t] {
        for (std::size_t i = t; i < lines.size(); i += 4) together[i] = (*engine)->answer(lines[i], {});
      });
    for (std::thread& thread : threads) thread.join();
    for (std::size_t i = 0; i < lines.size(); ++i) {
      ASSERT_EQ(alone[i].verdict, together[i].verdict) << toString(method) << " " << i;
      ASSERT_EQ(alone[i].clearance, together[i].clearance) << toString(method) << " " << i;
      ASSERT_EQ(alone[i].visited, together[i].visited) << toString(method) << " " << i;
    }
  }
}

TEST(SightEngines, ThatWalkOverCellsRefusePoints) {
  const auto model = build(pointFamilies()[0].make(50, 1));
  ASSERT_TRUE(model);
  for (const SightMethod method : {SightMethod::scan, SightMethod::pyramid}) {
    const auto engine = makeSightEngine(method, *model);
    ASSERT_FALSE(engine);
    EXPECT_EQ(engine.error().code, ErrorCode::unsupported);
  }
  EXPECT_TRUE(makeSightEngine(SightMethod::automatic, *model));
  EXPECT_TRUE(makeSightEngine(SightMethod::descent, *model));
}

template <class Family>
std::string nameOf(const testing::TestParamInfo<Family>& made) {
  std::string name(made.param.name);
  std::ranges::replace_if(
      name, [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Families, SightEnginesOnRasters,
                         testing::ValuesIn(rasterFamilies().begin(), rasterFamilies().end()),
                         nameOf<RasterFamily>);
INSTANTIATE_TEST_SUITE_P(Degenerate, SightEnginesWithoutTerrain,
                         testing::ValuesIn(degenerateFamilies().begin(), degenerateFamilies().end()),
                         nameOf<RasterFamily>);
INSTANTIATE_TEST_SUITE_P(Families, SightDescents,
                         testing::ValuesIn(rasterFamilies().begin(), rasterFamilies().end()),
                         nameOf<RasterFamily>);
INSTANTIATE_TEST_SUITE_P(Families, SightDescentsOnPoints,
                         testing::ValuesIn(pointFamilies().begin(), pointFamilies().end()),
                         nameOf<PointFamily>);

}  // namespace
}  // namespace arete::test

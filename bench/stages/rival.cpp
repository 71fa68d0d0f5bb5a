// SPDX-License-Identifier: GPL-3.0-or-later
//
// One run of hmm at the finest tolerance against one build for all of them, on one core, the same, by turns:
// what disturbs the machine for a while disturbs both. hmm's time is that of its whole program, from PNG to
// STL, which goes nowhere. Arete's is stated both ways: the build in memory, features included (what the
// mark is about), and file to file, the DEM's reading and the .amt's writing included.
#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <variant>

#include "bench/forked.h"
#include "bench/hmm.h"
#include "bench/stages/stages.h"
#include "io/geo/dem/dem_reader.h"

namespace arete::bench {
namespace {

namespace fs = std::filesystem;

/// Made, the DEM too where it is a generated one, by a process of its own: GDAL may start threads.
Result<HmmInput> makeInput(const DemSource& source, const std::string& png) {
  ARETE_TRY(const Json made, runForked([&]() -> Result<Json> {
              ARETE_CHECK(generateDem(source));
              ARETE_TRY(const DemRead dem, readDem(source.path));
              const auto* field = std::get_if<RasterHeightfield>(&dem.heightfield);
              if (field == nullptr) return failure(ErrorCode::unsupported, "not a raster", source.path);
              ARETE_TRY(const HmmInput input, writeHmmInput(*field, png));
              return Json(input.unit);
            }));
  return HmmInput{png, made.get<double>()};
}

Result<Figures> buildPinned(const DemSource& source, const std::string& model) {
  ARETE_TRY(const Json built, runForked([&]() -> Result<Json> {
              ARETE_CHECK(stayOnOneCore());
              ARETE_TRY(const Figures figures, buildOnce(source, HoleShape::delaunay, 1, model));
              return toJson(figures);
            }));
  return figuresFromJson(built);
}

double valueOf(const Figures& figures, const std::string& stage, const std::string& name) {
  for (const Figure& f : figures)
    if (f.stage == stage && f.name == name) return f.value;
  return 0;
}

struct Round {
  HmmRun hmm;
  double build = 0, buildProcessor = 0, fileToFile = 0, peakPerSample = 0, samples = 0;
};

Result<Round> oneRound(const DemSource& source, const Plan& plan, const HmmInput& input,
                       const std::string& model) {
  ARETE_TRY(const HmmRun hmm, runHmm(plan.hmm, input, source.tolerances.front()));
  ARETE_TRY(const Figures built, buildPinned(source, model));
  Round round;
  round.hmm = hmm;
  round.samples = valueOf(built, "build", "samples");
  round.build = valueOf(built, "build", "time");
  round.buildProcessor = valueOf(built, "build", "processor time");
  round.peakPerSample = valueOf(built, "build", "peak memory");
  round.fileToFile =
      round.build +
      1e-9 * round.samples * (valueOf(built, "build parts", "read") + valueOf(built, "build parts", "write"));
  return round;
}

}  // namespace

Result<Figures> rivalStage(const DemSource& wet, const Plan& plan) {
  const DemSource source = withoutLake(wet);
  const std::string png = (fs::path(plan.scratch) / (source.name + "-hmm.png")).string();
  const std::string model = (fs::path(plan.scratch) / (source.name + "-rival.amt")).string();
  const auto removeBoth = [&] {
    std::error_code ignored;
    for (const std::string& path : {png, png + ".aux.xml", model}) fs::remove(path, ignored);
  };
  const Result<HmmInput> input = makeInput(source, png);
  if (!input) {
    removeBoth();
    if (input.error().code == ErrorCode::unsupported) return Figures{};  // voids: no contest
    return tl::unexpected(input.error());
  }
  std::vector<Round> rounds;
  const Stopwatch watch;
  do {
    const Result<Round> round = oneRound(source, plan, *input, model);
    if (!round) {
      removeBoth();
      return tl::unexpected(round.error());
    }
    rounds.push_back(*round);
  } while (int(rounds.size()) < plan.repetition.most && watch.seconds() < plan.repetition.enoughSeconds);
  removeBoth();

  const auto median = [&](const auto& of) {
    std::vector<double> values;
    for (const Round& round : rounds) values.push_back(of(round));
    return medianOf(values);
  };
  Figures figures;
  const std::string variant = fmt::format("delaunay, 1 core; hmm at {:g}", source.tolerances.front());
  const auto add = [&](const char* name, double value, const char* unit, Better better) {
    figures.push_back({source.name, "rival", variant, name, value, unit, better});
  };
  const double samples = rounds.front().samples;
  add("samples", samples, "", Better::neither);
  add("hmm's triangles", rounds.front().hmm.triangles, "", Better::neither);
  add("hmm", median([](const Round& r) { return r.hmm.seconds; }), "s", Better::neither);
  add("hmm, triangulating", median([](const Round& r) { return r.hmm.triangulateSeconds; }), "s",
      Better::neither);
  add("build", median([](const Round& r) { return r.build; }), "s", Better::lower);
  add("file to file", median([](const Round& r) { return r.fileToFile; }), "s", Better::lower);
  add("rate by hmm's", median([](const Round& r) { return r.hmm.seconds / r.build; }), "", Better::higher);
  add("in processor time", median([](const Round& r) { return r.hmm.processorSeconds / r.buildProcessor; }),
      "", Better::higher);
  add("file to file by hmm's", median([](const Round& r) { return r.hmm.seconds / r.fileToFile; }), "",
      Better::higher);
  add("by hmm's triangulating", median([](const Round& r) { return r.hmm.triangulateSeconds / r.build; }), "",
      Better::higher);
  add("peak memory", median([](const Round& r) { return r.peakPerSample; }), "bytes/sample", Better::lower);
  add("hmm's", median([](const Round& r) { return r.hmm.peakBytes / r.samples; }), "bytes/sample",
      Better::neither);
  return figures;
}

}  // namespace arete::bench

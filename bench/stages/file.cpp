// SPDX-License-Identifier: GPL-3.0-or-later
//
// A model in its file: how many bytes, how soon it is open, what it takes to check it, and what of it a
// program that has used all of it holds in memory. Cold first, while nothing maps the file: what is mapped
// cannot be dropped from the cache. Last the packed form of the same model.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "bench/page_cache.h"
#include "bench/sources.h"
#include "bench/stages/stages.h"
#include "bench/threads.h"
#include "engine/criteria/criterion.h"
#include "engine/cut/cut.h"
#include "io/query/extract/query_footprint.h"
#include "io/store/amt/file.h"
#include "terrain/locate/ground_height.h"

namespace arete::bench {
namespace {

/// A field of /proc/self/status, in bytes; 0 where it is not known.
double ownMemory(const std::string& field) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind(field + ":", 0) == 0) return 1024 * std::strtod(line.c_str() + field.size() + 1, nullptr);
  return 0;
}

/// What this process holds: pages of mapped files, and pages of its own.
double residentBytes() {
  return ownMemory("RssFile") + ownMemory("RssAnon");
}

struct ColdTimes {
  double left = 0;  ///< of the file in the cache after dropping it, at most
  std::vector<double> open, load, cut;
  bool isCold() const { return left < kColdFraction; }
};

/// Each question to a file just dropped from the cache. Errors: those of loading.
Result<ColdTimes> timeCold(const std::string& model, double tolerance, const Repetition& repetition) {
  ColdTimes times;
  const auto drop = [&]() -> Status {
    ARETE_TRY(const double left, dropFromCache(model));
    times.left = std::max(times.left, left);
    return {};
  };
  AmtLoadOptions trusted;
  trusted.verify = AmtVerify::none;
  const Stopwatch all;
  do {
    ARETE_CHECK(drop());
    if (!times.isCold()) return times;
    {
      const Stopwatch watch;
      ARETE_CHECK(openAmt(model));
      times.open.push_back(watch.seconds());
    }
    ARETE_CHECK(drop());
    {
      const Stopwatch watch;
      ARETE_CHECK(loadAmt(model));
      times.load.push_back(watch.seconds());
    }
    ARETE_CHECK(drop());
    {
      const Stopwatch watch;
      ARETE_TRY(const auto loaded, loadAmt(model, trusted));
      ARETE_CHECK(takeCut(loaded.mt, UniformError(tolerance), {.method = CutMethod::saturated}));
      times.cut.push_back(watch.seconds());
    }
  } while (int(times.load.size()) < repetition.most && all.seconds() < repetition.enoughSeconds);
  return times;
}

/// Those of the DEM, or its points that do not repeat another.
double samplesOf(const TerrainModel& model) {
  return model.isRaster ? double(model.columns) * model.rows : double(model.mt.vertexCount());
}

/// How long it takes to load a file and to take a saturated cut of it.
double openAndCutMilliseconds(const std::string& path, const AmtLoadOptions& options, double tolerance,
                              const Repetition& repetition) {
  return 1000 * medianSeconds(repetition, [&] {
           const auto loaded = loadAmt(path, options);
           return takeCut(loaded->mt, UniformError(tolerance), {.method = CutMethod::saturated});
         });
}

/// How long it takes to open a file for the height at one place, and to tell it.
double openAndTellHeightMilliseconds(const std::string& model, const Repetition& repetition) {
  return 1000 * medianSeconds(repetition, [&]() -> std::optional<GroundHeight> {
           const auto file = openAmt(model);
           if (!file) return std::nullopt;
           const auto outline = file->read({.wanted = requiredNowhere()});
           if (!outline) return std::nullopt;
           const Vec2 middle{std::floor(outline->columns / 2.0), std::floor(outline->rows / 2.0)};
           QueryFootprint wanted(*outline);
           wanted.add(middle);
           const auto part = file->read({.wanted = wanted.within(0)});
           if (!part) return std::nullopt;
           return GroundHeights(*part).at(part->toSource(middle));
         });
}

/// What a question takes that reads its part of a file, with every check.
template <class Add>
void timeQuestions(const DemSource& source, const std::string& model, double tolerance,
                   const Repetition& repetition, const Add& add) {
  AmtLoadOptions enough;
  enough.wanted = [tolerance](const Box3&) { return tolerance; };
  add("open, check and cut", openAndCutMilliseconds(model, enough, tolerance, repetition), "ms");
  if (!source.isScattered)  // of points all is read
    add("open, check and tell a height", openAndTellHeightMilliseconds(model, repetition), "ms");
}

/// The same model packed, in a file beside its own that does not stay.
Result<Figures> timePacked(const DemSource& source, HoleShape shape, const std::string& model,
                           double tolerance, const Plan& plan) {
  Figures figures;
  const std::string packed = model + ".packed";
  double samples = 0;
  {
    ARETE_TRY(const auto loaded, loadModel(model));
    samples = samplesOf(loaded);
    const Stopwatch watch;
    ARETE_CHECK(writeAmt(packed, loaded, {}, {.isPacked = true}));
    figures.push_back({source.name, "file", fmt::format("{}, packed", toString(shape)), "pack and write",
                       watch.seconds(), "s", Better::lower});
  }
  const auto add = [&](const std::string& name, double value, const char* unit) {
    figures.push_back(
        {source.name, "file", fmt::format("{}, packed", toString(shape)), name, value, unit, Better::lower});
  };
  add("size", double(std::filesystem::file_size(packed)) / samples, "bytes/sample");
  for (const int threads : {1, 0}) {
    const auto limit = limitTo(threads);
    add("load with checks, " + threadsText(threads),
        medianSeconds(plan.repetition, [&] { return loadAmt(packed); }), "s");
  }
  timeQuestions(source, packed, tolerance, plan.repetition, add);
  std::filesystem::remove(packed);
  return figures;
}

}  // namespace

Result<Figures> fileStage(const DemSource& source, HoleShape shape, const std::string& model,
                          const Plan& plan) {
  Figures figures;
  const auto add = [&](const std::string& name, double value, const char* unit,
                       Better better = Better::lower) {
    figures.push_back({source.name, "file", std::string(toString(shape)), name, value, unit, better});
  };
  const double tolerance = source.tolerances[source.tolerances.size() / 2];
  ARETE_TRY(const ColdTimes cold, timeCold(model, tolerance, plan.repetition));

  double samples = 0;
  {
    const double before = residentBytes();
    const auto loaded = loadAmt(model);  // its checks touch every byte
    if (!loaded) return tl::unexpected(loaded.error());
    samples = samplesOf(*loaded);
    ARETE_TRY(const AmtFile file, openAmt(model));
    add("size", double(file.bytes().size()) / samples, "bytes/sample");
    add("in memory, all touched", (residentBytes() - before) / samples, "bytes/sample");
  }
  // Opening takes microseconds: one run is a thousand.
  constexpr int kOpens = 1000;
  const double open = medianSeconds(plan.repetition,
                                    [&] {
                                      for (int i = 0; i < kOpens; ++i)
                                        if (!openAmt(model)) return false;
                                      return true;
                                    }) /
                      kOpens;
  add("open", open * 1e6, "us");
  for (const int threads : {1, 0}) {
    const auto limit = limitTo(threads);
    add("load with checks, " + threadsText(threads),
        medianSeconds(plan.repetition, [&] { return loadAmt(model); }), "s");
  }
  AmtLoadOptions trusted;
  trusted.verify = AmtVerify::none;
  add("open and cut", openAndCutMilliseconds(model, trusted, tolerance, plan.repetition), "ms");
  timeQuestions(source, model, tolerance, plan.repetition, add);
  add("left in the cache", 100 * cold.left, "%", Better::neither);
  if (cold.isCold()) {
    add("open, cold", 1e6 * medianOf(cold.open), "us");
    add("load with checks, cold", medianOf(cold.load), "s");
    add("open and cut, cold", 1000 * medianOf(cold.cut), "ms");
  }
  Result<Figures> packed = timePacked(source, shape, model, tolerance, plan);
  if (!packed) return packed;
  figures.insert(figures.end(), packed->begin(), packed->end());
  return figures;
}

}  // namespace arete::bench

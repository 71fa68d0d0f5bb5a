// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a DEM to a model in memory and on the disk: reading, building, writing. The parts of it are what the
// stage clock has credited; the parts of a build add up to it, but for what no stage claims.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <variant>

#include "bench/forked.h"
#include "bench/page_cache.h"
#include "bench/sources.h"
#include "bench/stages/stages.h"
#include "bench/threads.h"
#include "io/geo/dem/dem_reader.h"
#include "io/store/amt/file.h"
#include "terrain/builder/build.h"
#include "terrain/features/fixed_vertices.h"

namespace arete::bench {
namespace {

template <class Work>
auto inStage(StageClock& clock, const char* stage, const Work& work) {
  const StageClock::Scope scope(&clock, stage);
  return work();
}

/// The features that stay, and the build. `finest`: of points, their triangulation.
template <class Heightfield, class... Finest>
Result<TerrainModel> buildFrom(const Heightfield& field, HoleShape shape, const RunContext& context,
                               Finest... finest) {
  ARETE_TRY(const FixedVertices fixed, inStage(*context.clock, "features", [&] {
              return chooseFixedVertices(field, finest..., {}, context);
            }));
  BuildOptions options;
  options.shape = shape;
  options.fixedVertices = fixed.vertices;
  return build(field, std::move(finest)..., options, context);
}

Result<TerrainModel> buildOf(const DemHeightfield& dem, HoleShape shape, const RunContext& context) {
  if (const auto* raster = std::get_if<RasterHeightfield>(&dem)) return buildFrom(*raster, shape, context);
  const auto& points = std::get<PointHeightfield>(dem);
  ARETE_TRY(FinestPoints finest, finestPoints(points, context));
  return buildFrom(points, shape, context, std::move(finest));
}

}  // namespace

Result<Figures> readStage(const DemSource& source, const Plan& plan) {
  Figures figures;
  const std::string what = std::filesystem::path(source.path).extension().string();
  const auto add = [&](const char* name, double value, const char* unit, Better better) {
    figures.push_back({source.name, "read", what, name, value, unit, better});
  };
  // Warm first: what reading needs of GDAL is then in memory, and cold is the file alone.
  ARETE_TRY(const RasterHeightfield field, readField(source));
  const double samples = double(field.size());
  const double seconds = medianSeconds(plan.repetition, [&] { return readField(source); });
  add("samples", samples, "", Better::neither);
  add("time", seconds, "s", Better::lower);
  add("rate", samples / seconds, "samples/s", Better::higher);
  std::vector<double> cold;
  double left = 0;
  for (int i = 0; i < plan.repetition.most && left < kColdFraction; ++i) {
    ARETE_TRY(const double dropped, dropFromCache(source.path));
    left = std::max(left, dropped);
    const Stopwatch watch;
    ARETE_CHECK(readField(source));
    cold.push_back(watch.seconds());
  }
  add("left in the cache", 100 * left, "%", Better::neither);
  if (left < kColdFraction) add("time, cold", medianOf(cold), "s", Better::lower);
  return figures;
}

// The stages of one build are credited to a clock; what they do not claim is a figure of its own.
Result<Figures> buildOnce(const DemSource& source, HoleShape shape, int threads, const std::string& model) {
  const auto limit = limitTo(threads);
  StageClock clock;
  RunContext context = onThreads(threads);
  context.clock = &clock;
  ARETE_TRY(DemRead dem, inStage(clock, "read", [&] { return readDem(source.path); }));
  const double samples = std::visit([](const auto& field) { return double(field.size()); }, dem.heightfield);

  const Stopwatch whole;
  ARETE_TRY(const TerrainModel built, buildOf(dem.heightfield, shape, context));
  const double seconds = whole.seconds(), peak = peakBytes();
  ARETE_CHECK(inStage(clock, "write", [&] { return writeAmt(model, built, onThreads(threads)); }));

  Figures figures;
  const auto add = [&](const char* stage, const std::string& name, double value, const char* unit,
                       Better better) {
    figures.push_back({source.name, stage, "", name, value, unit, better});
  };
  add("build", "samples", samples, "", Better::neither);
  for (const StageTime& part : clock.times())
    if (part.stage == "features" || part.stage == "triangulate")
      add("build", part.stage, part.seconds, "s", Better::lower);
  add("build", "time", seconds, "s", Better::lower);
  add("build", "rate", samples / seconds, "samples/s", Better::higher);
  add("build", "peak memory", peak / samples, "bytes/sample", Better::lower);
  double claimed = 0, processor = 0;
  for (const StageTime& part : clock.times()) {
    if (part.stage == "write") add("build", part.stage, part.seconds, "s", Better::lower);
    if (part.stage != "read" && part.stage != "write") {
      claimed += part.seconds;
      processor += part.cpuSeconds;
    }
    add("build parts", part.stage, 1e9 * part.seconds / samples, "ns/sample", Better::lower);
    add("build cores", part.stage, part.cpuSeconds / std::max(part.seconds, 1e-9), "", Better::neither);
  }
  add("build parts", "no stage", 1e9 * (seconds - claimed) / samples, "ns/sample", Better::lower);
  add("build", "processor time", processor, "s", Better::lower);
  return figures;
}

}  // namespace arete::bench

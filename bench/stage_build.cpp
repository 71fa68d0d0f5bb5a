// SPDX-License-Identifier: GPL-3.0-or-later
//
// From a DEM to a file: reading, building, writing, opening. The parts of a build are told apart by the
// progress it reports.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string_view>
#include <variant>

#include "bench/forked.h"
#include "bench/stages.h"
#include "bench/threads.h"
#include "io/amt_file.h"
#include "io/dem_reader.h"
#include "terrain/build.h"
#include "terrain/fixed_vertices.h"

namespace arete::bench {
namespace {

Result<RasterHeightfield> readField(const DemSource& source) {
  Result<DemRead> dem = readDem(source.path);
  if (!dem) return tl::unexpected(dem.error());
  if (!std::holds_alternative<RasterHeightfield>(dem->heightfield))
    return failure(ErrorCode::unsupported, "not a raster", source.path);
  return std::move(std::get<RasterHeightfield>(dem->heightfield));
}

}  // namespace

Result<Figures> readStage(const DemSource& source, const Plan& plan) {
  const Result<RasterHeightfield> field = readField(source);
  if (!field) return tl::unexpected(field.error());
  const double samples = double(field->size());
  const double seconds = medianSeconds(plan.repetition, [&] { return readField(source); });
  const std::string what = std::filesystem::path(source.path).extension().string();
  return Figures{{source.name, "read", what, "samples", samples, "", Better::neither},
                 {source.name, "read", what, "time", seconds, "s", Better::lower},
                 {source.name, "read", what, "rate", samples / seconds, "samples/s", Better::higher}};
}

Result<Figures> buildOnce(const DemSource& source, HoleShape shape, int threads, const std::string& model) {
  const auto limit = limitTo(threads);
  const Result<RasterHeightfield> field = readField(source);
  if (!field) return tl::unexpected(field.error());
  const double samples = double(field->size());

  const Stopwatch whole;
  const Result<FixedVertices> fixed = chooseFixedVertices(*field, {}, onThreads(threads));
  if (!fixed) return tl::unexpected(fixed.error());
  const double featureSeconds = whole.seconds();
  BuildOptions options;
  options.shape = shape;
  options.fixedVertices = fixed->vertices;
  RunContext context = onThreads(threads);
  double triangulated = featureSeconds;
  context.progress = [&](std::string_view stage, double fraction) {
    if (stage == "triangulate" && fraction >= 1) triangulated = whole.seconds();
  };
  const Result<TerrainModel> built = build(*field, options, context);
  if (!built) return tl::unexpected(built.error());
  const double seconds = whole.seconds(), peak = peakBytes();

  const Stopwatch writing;
  if (const Status status = writeAmt(model, *built, onThreads(threads)); !status)
    return tl::unexpected(status.error());
  const double writeSeconds = writing.seconds();
  const auto figure = [&](const char* name, double value, const char* unit, Better better) {
    return Figure{source.name, "build", "", name, value, unit, better};
  };
  return Figures{figure("samples", samples, "", Better::neither),
                 figure("features", featureSeconds, "s", Better::lower),
                 figure("triangulate", triangulated - featureSeconds, "s", Better::lower),
                 figure("time", seconds, "s", Better::lower),
                 figure("rate", samples / seconds, "samples/s", Better::higher),
                 figure("peak memory", peak / samples, "bytes/sample", Better::lower),
                 figure("write", writeSeconds, "s", Better::lower)};
}

Result<Figures> fileStage(const DemSource& source, HoleShape shape, const std::string& model,
                          const Plan& plan) {
  const Result<AmtFile> file = openAmt(model);
  if (!file) return tl::unexpected(file.error());
  const double bytes = double(file->bytes().size());
  const double samples = double(file->model().columns) * file->model().rows;
  // Opening takes microseconds: one run is a thousand.
  constexpr int kOpens = 1000;
  const double open = medianSeconds(plan.repetition,
                                    [&] {
                                      for (int i = 0; i < kOpens; ++i)
                                        if (!openAmt(model)) return false;
                                      return true;
                                    }) /
                      kOpens;
  Figures figures = {
      {source.name, "file", std::string(toString(shape)), "size", bytes / samples, "bytes/sample",
       Better::lower},
      {source.name, "file", std::string(toString(shape)), "open", open * 1e6, "us", Better::lower}};
  for (const int threads : {1, 0}) {
    const auto limit = limitTo(threads);
    const double load = medianSeconds(plan.repetition, [&] { return loadAmt(model); });
    figures.push_back({source.name, "file", std::string(toString(shape)),
                       "load with checks, " + threadsText(threads), load, "s", Better::lower});
  }
  return figures;
}

}  // namespace arete::bench

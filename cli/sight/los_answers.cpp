// SPDX-License-Identifier: GPL-3.0-or-later
//
// The lines say which part of the model is read. Where the method reads all samples of a raster, that is all
// of it, unless the memory budget is too small for it.
#include "cli/sight/los_answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <span>
#include <utility>

#include "cli/arguments/arguments.h"
#include "cli/sight/arguments.h"
#include "io/query/extract/batches.h"
#include "io/query/parts/asked_places.h"

namespace arete {
namespace {

/// The terrain that some lines require: around both ends and below the line. All of the model where the
/// method reads all samples.
///
/// @param rows the numbers of the lines
RequiredError wantedFor(SightMethod method, const LosQuestion& question, std::span<const std::uint32_t> rows,
                        const TerrainModel& outline) {
  const auto& all = question.pairs.rows;
  if (bestMethod(method, question.options.sight.maxError, all.size(), outline) != SightMethod::descent)
    return {};
  std::vector<std::array<Vec2, 2>> ends;
  for (const std::uint32_t row : rows) ends.push_back({all[row][0].xy, all[row][1].xy});
  return wantedBetween(ends, question.earth, outline);
}

}  // namespace

Result<LosAnswers> answerLines(const LosQuestion& question, const TerrainModel& model,
                               const RunContext& context) {
  // Profiles at full resolution walk over the cells of a raster.
  const bool hasProfiles = question.options.frequencyMegahertz > 0 || question.options.clutter.height;
  const auto grid = hasProfiles && model.isRaster ? std::make_shared<const SightGrid>(model) : nullptr;
  const Profiles profiles(model, grid);
  const GroundHeights& heights = profiles.heights();
  LosAnswers all;
  all.rows = SightRows::of(question.pairs, heights, question.typed);
  for (const SightPath& path : all.rows.paths)
    all.buried.push_back({depthBelowGround(path.from, path.fromHeight, heights),
                          depthBelowGround(path.to, path.toHeight, heights)});
  all.method = bestMethod(question.method, question.options.sight.maxError, all.rows.paths.size(), model);
  if (!model.isRaster && all.method != SightMethod::descent)
    return failure(ErrorCode::usage, fmt::format("requires a raster; {} is made of points", question.model),
                   fmt::format("--method {}", toString(all.method)));
  ARETE_TRY(const auto engine, makeSightEngine(all.method, model, grid, context));
  ARETE_TRY(all.answers,
            answerPaths(all.rows.paths, question.earth, *engine, profiles, question.options, context));
  return all;
}

Result<LosAnswers> answerLines(const LosQuestion& question, const AmtFile& file, const TerrainModel& outline,
                               const Session& session) {
  const auto& lines = question.pairs.rows;
  std::vector<Vec2> middles;
  for (const auto& [first, second] : lines) middles.push_back((first.xy + second.xy) * 0.5);
  LosAnswers all;
  all.rows.rows.resize(lines.size());
  ARETE_CHECK(answerInBatches(middles, [&](std::span<const std::uint32_t> batch) -> Status {
    LosQuestion some = question;
    if (batch.size() < lines.size() && question.method == SightMethod::automatic)
      some.method = SightMethod::descent;
    ARETE_TRY(const TerrainModel model,
              readWanted(file, outline, wantedFor(some.method, question, batch, outline), session.context()));
    SightPairs pairs;
    for (const std::uint32_t row : batch) pairs.rows.push_back(lines[row]);
    ARETE_TRY(LosAnswers answered,
              answerLines({pairs, some.typed, some.options, some.earth, some.method, some.model}, model,
                          session.context()));
    for (std::size_t k = 0; k < batch.size(); ++k) {
      answered.rows.rows[k].path += all.rows.paths.size();
      all.rows.rows[batch[k]] = std::move(answered.rows.rows[k]);
    }
    std::ranges::copy(answered.rows.paths, std::back_inserter(all.rows.paths));
    std::ranges::copy(answered.buried, std::back_inserter(all.buried));
    std::ranges::move(answered.answers, std::back_inserter(all.answers));
    all.method = answered.method;
    return {};
  }));
  return all;
}

void warnOfBuriedEnds(const LosAnswers& answers, const std::string& unit, const Session& session) {
  std::size_t buried = 0;
  double deepest = 0;
  for (const auto& path : answers.buried)
    for (std::size_t end = 0; end < 2; ++end) {
      const double below = path[end];
      if (!(below > 0)) continue;
      ++buried;
      deepest = std::max(deepest, below);
      if (answers.buried.size() == 1)
        session.warn(fmt::format("the {} end lies {} below the ground", end == 0 ? "first" : "second",
                                 withUnit(below, unit)));
    }
  if (buried > 0 && answers.buried.size() > 1)
    session.warn(fmt::format("{} below the ground, by up to {}", grouped(buried, "end lies", "ends lie"),
                             withUnit(deepest, unit)));
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The simplification of [deBergDobrindt1995]: repeat { choose an independent set of removable vertices;
// remove each; retriangulate its hole; record the modification } until no vertex can be removed. One
// repetition is a level (level.h).
//
// A level admits the removals whose cost is under a threshold, which grows from level to level
// (engine/simplify/level_schedule.h).
//
// A level visits one vertex in ten, and so nearly all of the memory. Therefore a large mesh is divided into
// tiles that fit a processor's cache: a thread takes one tile through several levels by itself (tile.h), then
// the next tile. A vertex with a neighbour outside its tile is held until all tiles are done; the held
// vertices then go through the same levels on all threads together. So no two threads write the same data:
// every triangle around a vertex that a thread removes has all its corners in the thread's tile, and no star
// of another tile's vertex has such a triangle. (Joining a new triangle to its neighbour writes to a triangle
// beyond the rim, which can have a corner in another tile; but only the twin across the rim's edge, which no
// walk around that corner reads.) What happens in a tile depends on nothing that other threads do meanwhile,
// so the MT is the same for any number of threads (docs/decisions/0015).
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/per_thread.h"
#include "engine/parallel/run_context.h"
#include "engine/parallel/shared_progress.h"
#include "engine/simplify/level_schedule.h"
#include "engine/simplify/simplified_root.h"
#include "terrain/simplify/level.h"
#include "terrain/simplify/state.h"
#include "terrain/simplify/tile.h"
#include "terrain/simplify/tile_options.h"

namespace arete {

/// Runs all levels of a build. `state`, `context` and what they refer to must outlive the Simplifier; it runs
/// once.
template <class Plan, class Errors>
class Simplifier {
 public:
  Simplifier(SimplifyState<Plan, Errors>& state, const TileOptions& tiles, const RunContext& context)
      : s_(state), tiles_(tiles), context_(context), together_(state, context.clock) {}

  /// Removes every vertex that can be removed. Errors: interrupted.
  /// @param isFixed per vertex, not 0 = it is never removed.
  Result<SimplifiedRoot> run(const std::vector<std::uint8_t>& isFixed) {
    start(isFixed);
    while (!s_.thresholds.empty()) {
      s_.thresholds.compact();
      const std::uint32_t tiles = tileCount();
      const LevelSchedule::Step step = tiles > 1 ? levelsInTiles(tiles) : levelOfAll();
      if (context_.cancelled()) return failure(ErrorCode::interrupted, "the build was interrupted");
      if (step == LevelSchedule::Step::end) break;
      if (double(s_.liveTriangles) < Errors::kLeastLive * double(s_.mesh.triangles.size()))
        s_.errors.compact(s_.mesh.compact(s_.thresholds.vertices()));
    }
    context_.report("simplify", 1);
    return rootOf(s_.mesh, levels_);
  }

 private:
  using Worker = TileWorker<Plan, Errors>;
  using Tile = ThresholdList::Tile;

  void start(const std::vector<std::uint8_t>& isFixed) {
    const auto vertexCount = static_cast<std::uint32_t>(s_.mesh.vertexHalfedge.size());
    s_.liveTriangles = s_.mesh.triangles.size();
    s_.records.resize(vertexCount);
    // Vertices are visited in the order of their triangles in memory, which is that of the ground.
    s_.thresholds.assign(s_.mesh.verticesInOrder(), isFixed);
    // Errors below a ten-millionth of the relief count as equal: rounding noise must not make levels.
    schedule_.emplace(s_.thresholds, LevelSchedule::Options{.first = s_.heightRange * 1e-7,
                                                            .ratio = s_.options.thresholdRatioOrDefault()});
    // Progress counts vertices, not levels: most levels are late and short.
    progress_.emplace(context_, "simplify", schedule_->sizeAtStart());

    const StageClock::Scope stage(context_.clock, "simplify: evaluate");
    const RemovalCost<Plan, Errors> cost(s_);
    forRanges(LoopThreads::all, vertexCount, 4096, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i) {
        const VertexId v(static_cast<std::uint32_t>(i));
        RemovalRecord& record = s_.records[v];
        record = {};
        if (isFixed[i] != 0) {
          record.state = RemovalRecord::State::fixed;
          continue;
        }
        cost.evaluateInFinest(v, record);
        if (record.state != RemovalRecord::State::stale) s_.thresholds.set(v, record.cost);
      }
    });
  }

  /// The number of tiles of the next levels; 1: all threads work together. So they do where rims are
  /// simplified, as the fills of a level are reserved one after the other (Rim::claim()).
  std::uint32_t tileCount() const {
    const std::uint32_t indices = s_.thresholds.all().size();
    const std::uint32_t tiles = indices / std::clamp(indices / tiles_.fewest, tiles_.least, tiles_.most);
    return tiles < tiles_.fewest || s_.rim != nullptr ? 1 : tiles;
  }

  /// One level.
  LevelSchedule::Step levelOfAll() {
    ++levels_;
    progress_->add(together_.levelOfAll(schedule_->threshold(), ++numbers_, {++groups_, 0}));
    return schedule_->advance();
  }

  /// The levels of one pass over the tiles.
  LevelSchedule::Step levelsInTiles(std::uint32_t tiles) {
    const std::vector<double> thresholds = schedule_->pass(tiles_.span);
    const auto levels = static_cast<std::uint32_t>(thresholds.size()) - 1;
    ++groups_;
    const Tile everything = s_.thresholds.all();
    const auto indexOf = [&](std::uint64_t tile) {
      return everything.begin + static_cast<std::uint32_t>(everything.size() * tile / tiles);
    };

    std::vector<std::vector<VertexId>> held(tiles);
    {
      const StageClock::Scope stage(context_.clock, "simplify: tiles");
      parallelForTasks(std::uint32_t(0), tiles, [&](std::uint32_t p) {
        Worker& worker = workers_.local();
        for (std::uint32_t k = 0; k < levels && !context_.cancelled(); ++k)
          progress_->add(
              worker.levelOf({indexOf(p), indexOf(p + 1)}, thresholds[k], numbers_ + 1 + k, {groups_, p}));
        held[p].swap(worker.held());
        s_.thresholds.sort(held[p]);
      });
    }
    levels_ += levels;
    numbers_ += levels;

    std::vector<VertexId> some;
    for (const std::vector<VertexId>& of : held) some.insert(some.end(), of.begin(), of.end());
    for (const VertexId v : some) s_.thresholds.set(v, ThresholdList::kNow);
    for (std::uint32_t k = 0; k < levels && !context_.cancelled(); ++k)
      progress_->add(together_.levelOf(some, thresholds[k], ++numbers_, {groups_, tiles}));
    return schedule_->advanceTo(thresholds.back());
  }

  SimplifyState<Plan, Errors>& s_;
  TileOptions tiles_;
  const RunContext& context_;
  LevelWorkers<Plan, Errors> together_;
  PerThread<Worker> workers_{[this] { return Worker(s_); }};
  std::uint32_t levels_ = 0;   // thresholds
  std::uint32_t numbers_ = 0;  // of levels, with those of held vertices
  std::uint32_t groups_ = 0;   // of batches
  std::optional<LevelSchedule> schedule_;
  std::optional<SharedProgress> progress_;
};

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The build of de Berg and Dobrindt (1995): repeat { choose an independent set of removable vertices; remove
// each; retriangulate its hole; record the modification } until nothing is removable. That is a level
// (simplify_level.h). From level to level the threshold below which a removal must cost grows: cheap removals
// go first everywhere, which is what keeps the cuts at any error small (without thresholds the same
// bound takes 1.9 times as many triangles). It grows in smaller steps the fewer vertices are left. Most of
// the time goes into the first levels, of which only the finest cuts tell; levels among few vertices take
// next to none, and all coarser cuts live on their order (docs/decisions/0016 to 0018).
//
// A level visits a vertex in ten, and so all of memory. Therefore a large mesh goes through some levels piece
// by piece: the ground is divided into pieces that fit a processor's cache, each thread takes one through all
// those levels by itself (simplify_piece.h), then the next. A vertex with a neighbour beyond its piece is
// held until all pieces are through: no two threads ever meet, as every triangle around a vertex that one of
// them removes has its corners in one piece, and the stars of other pieces' vertices have none such. (Sewing
// writes to a triangle beyond the rim, which can have a corner in another piece: but only what it says of the
// rim's edge, and who looks at the star of that corner does not ask for it.) Those that were held go through
// the same levels after, together. So what happens in a piece depends on nothing that others do meanwhile,
// and the MT is the same for any number of threads (docs/decisions/0015).
#pragma once

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "engine/parallel/shared_progress.h"
#include "terrain/simplify/level.h"
#include "terrain/simplify/state.h"
#include "terrain/simplify/tile.h"
#include "terrain/simplify/tile_options.h"

namespace arete {

/// What the levels leave: the root.
struct SimplifiedRoot {
  std::vector<std::uint32_t> vertices;
  std::vector<SurvivingTriangle> triangles;
  std::uint32_t levels = 0;
};

template <class Plan, class Errors>
class Simplifier {
 public:
  Simplifier(SimplifyState<Plan, Errors>& state, const TileOptions& tiles, const RunContext& context)
      : s_(state), tiles_(tiles), context_(context), together_(state, context.clock) {}

  /// Removes what can be removed. `isFixed`: per vertex, not 0 = stays.
  Result<SimplifiedRoot> run(const std::vector<std::uint8_t>& isFixed) {
    start(isFixed);
    // Below a ten-millionth of the relief all errors are alike: noise of the arithmetic must not make levels.
    double threshold = s_.heightRange * 1e-7;
    while (!s_.waiting.empty()) {
      s_.waiting.forgetGone();
      const std::size_t before = s_.waiting.size();
      const std::uint32_t pieces = pieceCount();
      const double next = pieces > 1 ? levelsByPieces(threshold, pieces) : levelOfAll(threshold);
      if (context_.cancelled()) return failure(ErrorCode::interrupted, "the build was interrupted");
      threshold = std::max(next, leastUseful());
      if (s_.waiting.size() == before) {
        const double pending = s_.waiting.least();
        if (!(pending < std::numeric_limits<double>::infinity())) break;
        threshold = std::max(threshold, pending);
      }
      threshold = std::min(threshold, kLargest);
      if (double(s_.liveTriangles) < Errors::kLeastLive * double(s_.mesh.triangles.size()))
        s_.errors.compact(s_.mesh.compact(s_.waiting.vertices()));
    }
    context_.report("simplify", 1);
    return root();
  }

 private:
  using Worker = TileWorker<Plan, Errors>;
  using Piece = ThresholdList::Piece;

  void start(const std::vector<std::uint8_t>& isFixed) {
    const auto vertexCount = static_cast<std::uint32_t>(s_.mesh.vertexHalfedge.size());
    s_.liveTriangles = s_.mesh.triangles.size();
    s_.notes.resize(vertexCount);
    // Vertices are visited in the order of their triangles in memory, which is that of the ground.
    s_.waiting.assign(s_.mesh.verticesInOrder(), isFixed);
    waitingAtStart_ = std::max<std::size_t>(s_.waiting.size(), 1);
    // Most levels are late and short: progress by what is left.
    progress_.emplace(context_, "simplify", waitingAtStart_);

    const StageClock::Scope stage(context_.clock, "simplify: evaluate");
    const RemovalCost<Plan, Errors> cost(s_);
    forRanges(LoopThreads::all, vertexCount, 4096, [&](std::size_t begin, std::size_t end) {
      for (auto v = static_cast<std::uint32_t>(begin); v != end; ++v) {
        RemovalRecord& note = s_.notes[v];
        note = {};
        if (isFixed[v] != 0) {
          note.state = RemovalRecord::State::fixed;
          continue;
        }
        cost.lookInFinest(v, note);
        if (note.state != RemovalRecord::State::stale) s_.waiting.set(v, note.cost);
      }
    });
  }

  /// Into how many pieces the ground is divided now. Rims are looked after by one for all.
  std::uint32_t pieceCount() const {
    const std::uint32_t places = s_.waiting.everything().size();
    const std::uint32_t pieces = places / std::clamp(places / tiles_.fewest, tiles_.least, tiles_.most);
    return pieces < tiles_.fewest || s_.rim != nullptr ? 1 : pieces;
  }

  /// By how much the threshold grows now. What it grows by falls with the vertices that are left.
  double ratio() const {
    const double growth = s_.options.thresholdRatioOrDefault() - 1,
                 left = double(s_.waiting.size()) / double(waitingAtStart_);
    return 1 + std::max(std::min(growth, kLeastGrowth), growth * left);
  }

  /// The least threshold that concerns a fiftieth of those that may go: where costs are spread over many
  /// orders of magnitude, steps in which next to none go would be all there is.
  double leastUseful() const { return s_.waiting.thresholdOf(0.02); }

  /// One level. Returns the threshold of the next.
  double levelOfAll(double threshold) {
    ++levels_;
    progress_->add(together_.levelOfAll(threshold, ++numbers_, {++groups_, 0}));
    return threshold * ratio();
  }

  /// As many levels as a piece goes through. Returns the threshold of the next.
  double levelsByPieces(double threshold, std::uint32_t pieces) {
    std::vector<double> thresholds = {threshold};
    const double step = ratio(), end = threshold * tiles_.span;
    do  // once at least: of flat ground all thresholds are 0
      thresholds.push_back(std::min(thresholds.back() * step, kLargest));
    while (thresholds.size() <= kMostLevels && thresholds.back() < end);
    const auto levels = static_cast<std::uint32_t>(thresholds.size()) - 1;
    ++groups_;
    const Piece everything = s_.waiting.everything();
    const auto placeOf = [&](std::uint64_t piece) {
      return everything.begin + static_cast<std::uint32_t>(everything.size() * piece / pieces);
    };

    std::vector<std::vector<std::uint32_t>> held(pieces);
    {
      const StageClock::Scope stage(context_.clock, "simplify: tiles");
      tbb::parallel_for(
          tbb::blocked_range<std::uint32_t>(0, pieces, 1),
          [&](const auto& range) {
            for (std::uint32_t p = range.begin(); p != range.end(); ++p) {
              Worker& worker = workers_.local();
              for (std::uint32_t k = 0; k < levels && !context_.cancelled(); ++k)
                progress_->add(worker.levelOf({placeOf(p), placeOf(p + 1)}, thresholds[k], numbers_ + 1 + k,
                                              {groups_, p}));
              held[p].swap(worker.held());
              s_.waiting.sort(held[p]);
            }
          },
          tbb::simple_partitioner());
    }
    levels_ += levels;
    numbers_ += levels;

    std::vector<std::uint32_t> some;
    for (const std::vector<std::uint32_t>& of : held) some.insert(some.end(), of.begin(), of.end());
    for (const std::uint32_t v : some) s_.waiting.set(v, ThresholdList::kNow);
    for (std::uint32_t k = 0; k < levels && !context_.cancelled(); ++k)
      progress_->add(together_.levelOf(some, thresholds[k], ++numbers_, {groups_, pieces}));
    return thresholds.back();
  }

  SimplifiedRoot root() const {
    SimplifiedRoot root;
    root.levels = levels_;
    std::vector<std::uint8_t> seen(s_.mesh.vertexHalfedge.size(), 0);
    for (const LiveMesh::Triangle& triangle : s_.mesh.triangles) {
      if (triangle.isDead()) continue;
      root.triangles.push_back({triangle.birth, triangle.corners});
      for (const std::uint32_t v : triangle.corners) seen[v] = 1;
    }
    for (std::uint32_t v = 0; v < seen.size(); ++v)
      if (seen[v]) root.vertices.push_back(v);
    return root;
  }

  static_assert(ThresholdList::kNone == LiveMesh::kNone);  // see LiveMesh::compact()
  static constexpr double kLeastGrowth = 0.015;
  static constexpr double kLargest = std::numeric_limits<float>::max();  // below ThresholdList::kNever
  static constexpr std::size_t kMostLevels = 16;                         // of a piece by itself

  SimplifyState<Plan, Errors>& s_;
  TileOptions tiles_;
  const RunContext& context_;
  LevelWorkers<Plan, Errors> together_;
  tbb::enumerable_thread_specific<Worker> workers_{[this] { return Worker(s_); }};
  std::uint32_t levels_ = 0;   // thresholds
  std::uint32_t numbers_ = 0;  // of levels, those of held vertices counted again
  std::uint32_t groups_ = 0;   // of batches
  std::size_t waitingAtStart_ = 1;
  std::optional<SharedProgress> progress_;
};

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The pyramid stores the highest sample of each square of 8 x 8 cells, of each 4 x 4 of these squares, and so
// on. From the first end of the line to the last, a square that is below the line is skipped as a whole; one
// that may matter is entered, down to its cells. (Maximum mipmaps for rays through heightfields:
// [TevsIhrkeSeidel2008].)

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/float_bounds.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"
#include "terrain/sight/engine.h"
#include "terrain/sight/walk.h"

namespace arete {
namespace {

constexpr std::uint32_t kFirstSize = 8, kGrowth = 4;
constexpr int kHints = 32;

struct Level {
  std::uint32_t size = 0;  ///< cells along a side of a square
  std::uint32_t columns = 0, rows = 0;
  std::vector<float> top;     ///< at least the highest sample of the square, its border included
  std::vector<char> hasGaps;  ///< some sample is NODATA

  std::size_t at(int column, int row) const {
    return static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
  }
};

class SightPyramid final : public SightEngine {
 public:
  SightPyramid(std::shared_ptr<const SightGrid> grid, const RunContext& context) : grid_(std::move(grid)) {
    withThreads(context, [&] {
      levels_.push_back(firstLevel());
      while (levels_.back().columns > 1 || levels_.back().rows > 1) levels_.push_back(nextLevel());
    });
  }

  // A clearance is sought in two passes: the hints bound it, so that most of the pyramid is skipped. Where a
  // hint turns out not to hold, the line is answered again without them.
  SightAnswer answer(const SightLine& line, const SightOptions& options) const override {
    std::uint64_t visited = 0;
    if (options.wantsClearance) {
      SightJudge judge(line, options);
      hint(line, judge);
      pass(judge, visited);
      if (judge.areHintsKept()) return judge.answer(visited);
    }
    SightJudge judge(line, options);
    pass(judge, visited);
    return judge.answer(visited);
  }

 private:
  Level shape(std::uint32_t size) const {
    Level level;
    level.size = size;
    level.columns = std::max(1u, (grid_->columns() - 1 + size - 1) / size);
    level.rows = std::max(1u, (grid_->rows() - 1 + size - 1) / size);
    level.top.resize(std::size_t{level.columns} * level.rows);
    level.hasGaps.resize(level.top.size());
    return level;
  }

  // Squares share their border samples, so that the terrain between two squares belongs to one of them.
  // Heights are rounded upwards: a square never hides what lies in it.
  Level firstLevel() const {
    Level level = shape(kFirstSize);
    parallelFor(std::uint32_t{0}, level.rows, [&](std::uint32_t row) {
      const std::uint32_t rowEnd = std::min((row + 1) * level.size + 1, grid_->rows());
      for (std::uint32_t column = 0; column < level.columns; ++column) {
        const std::uint32_t columnEnd = std::min((column + 1) * level.size + 1, grid_->columns());
        double top = -HUGE_VAL;
        bool hasGaps = false;
        for (std::uint32_t r = row * level.size; r < rowEnd; ++r)
          for (std::uint32_t c = column * level.size; c < columnEnd; ++c) {
            const double z = grid_->height(c, r);
            if (std::isnan(z))
              hasGaps = true;
            else
              top = std::max(top, z);
          }
        const std::size_t at = std::size_t{row} * level.columns + column;
        level.top[at] = floatAtLeast(top);
        level.hasGaps[at] = hasGaps;
      }
    });
    return level;
  }

  // Each square holds the largest of the squares below it, and a gap if one of them has a gap.
  Level nextLevel() const {
    const Level& finer = levels_.back();
    Level level = shape(finer.size * kGrowth);
    std::fill(level.top.begin(), level.top.end(), -HUGE_VALF);
    for (std::uint32_t row = 0; row < finer.rows; ++row)
      for (std::uint32_t column = 0; column < finer.columns; ++column) {
        const std::size_t from = std::size_t{row} * finer.columns + column;
        const std::size_t to = std::size_t{row / kGrowth} * level.columns + column / kGrowth;
        level.top[to] = std::max(level.top[to], finer.top[from]);
        level.hasGaps[to] |= finer.hasGaps[from];
      }
    return level;
  }

  /// Gives the judge a few heights along the line. The least clearance is probably close to theirs, so most
  /// of the rest is skipped.
  void hint(const SightLine& line, SightJudge& judge) const {
    for (int i = 0; i <= kHints; ++i) {
      const double s = line.length() * (i / double{kHints});
      if (const double z = grid_->at(line.planAt(s)); !std::isnan(z)) judge.hint(s, z);
    }
  }

  void pass(SightJudge& judge, std::uint64_t& visited) const {
    forLegs(*grid_, judge, [&](const SightLeg& leg, SightRange range) {
      enter(levels_.size() - 1, leg, range, judge, visited);
    });
  }

  void enter(std::size_t which, const SightLeg& leg, SightRange range, SightJudge& judge,
             std::uint64_t& visited) const {
    const Level& level = levels_[which];
    forSquares(leg, range, level.size, static_cast<int>(level.columns), static_cast<int>(level.rows),
               [&](int column, int row, double t0, double t1) {
                 ++visited;
                 const std::size_t at = level.at(column, row);
                 const double top = level.top[at];
                 if (!judge.matters(leg.distance(t0), top, leg.distance(t1), top, level.hasGaps[at] != 0))
                   return true;
                 if (which == 0) {
                   visited += judgeCells(*grid_, leg, {t0, t1}, judge);
                 } else {
                   enter(which - 1, leg, {t0, t1}, judge, visited);
                 }
                 return !judge.isDone();
               });
  }

  std::shared_ptr<const SightGrid> grid_;
  std::vector<Level> levels_;
};

}  // namespace

std::unique_ptr<SightEngine> makeSightPyramid(std::shared_ptr<const SightGrid> grid,
                                              const RunContext& context) {
  return std::make_unique<SightPyramid>(std::move(grid), context);
}

}  // namespace arete

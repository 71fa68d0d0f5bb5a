// SPDX-License-Identifier: GPL-3.0-or-later
//
// Visits every cell below the line, from its first end to its last.
#include <utility>

#include "terrain/sight/engine.h"
#include "terrain/sight/walk.h"

namespace arete {
namespace {

class SightScan final : public SightEngine {
 public:
  explicit SightScan(std::shared_ptr<const SightGrid> grid) : grid_(std::move(grid)) {}

  SightAnswer answer(const SightLine& line, const SightOptions& options) const override {
    SightJudge judge(line, options);
    std::uint64_t visited = 0;
    forLegs(*grid_, judge,
            [&](const SightLeg& leg, SightRange range) { visited += judgeCells(*grid_, leg, range, judge); });
    return judge.answer(visited);
  }

 private:
  std::shared_ptr<const SightGrid> grid_;
};

}  // namespace

std::unique_ptr<SightEngine> makeSightScan(std::shared_ptr<const SightGrid> grid) {
  return std::make_unique<SightScan>(std::move(grid));
}

}  // namespace arete

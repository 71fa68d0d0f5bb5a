// SPDX-License-Identifier: GPL-3.0-or-later
//
// Viewsheds cell by cell against the answers of an engine.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>

#include "terrain/sight/earth.h"
#include "terrain/sight/engine.h"
#include "terrain/viewshed/viewshed.h"

namespace arete::test {

inline ViewshedCell cellOf(SightVerdict verdict) {
  return verdict == SightVerdict::visible   ? ViewshedCell::seen
         : verdict == SightVerdict::blocked ? ViewshedCell::hidden
                                            : ViewshedCell::unknown;
}

/// Who knows better.
struct CellOracle {
  const SightEarth& earth;
  const SightEngine& engine;
  const SightGrid& grid;
  double unitMetres = 1;
};

struct CellTally {
  std::uint64_t cells = 0, wrong = 0, rays = 0;
};

/// Each `every`th cell from `first` on; tells of the first few that are wrong.
inline void expectCells(const Viewshed& viewshed, const CellOracle& oracle, const ViewshedObserver& observer,
                        const ViewshedOptions& options, const std::string& what, CellTally& tally,
                        std::size_t first = 0, std::size_t every = 1) {
  tally.rays += viewshed.rays;
  for (std::size_t at = first; at < viewshed.cells.size(); at += every) {
    const Vec2 to{double(at % viewshed.columns), double(at / viewshed.columns)};
    const ViewshedCell cell = viewshed.cells[at];
    const double z = oracle.grid.row(0)[at];
    if (std::isnan(z)) {
      ASSERT_EQ(cell, ViewshedCell::outside) << what;
      continue;
    }
    const SightLine line(*oracle.earth.track(observer.plan, to), observer.height, z + options.targetHeight,
                         oracle.unitMetres);
    const SightAnswer answer = oracle.engine.answer(line, {.nodata = options.nodata});
    ++tally.cells;
    if (cell != cellOf(answer.verdict) && tally.wrong++ < 5)
      ADD_FAILURE() << what << ": cell " << to.x << ", " << to.y << " is " << int(cell) << ", not "
                    << int(cellOf(answer.verdict)) << "; clearance " << answer.clearance.value_or(NAN)
                    << " at " << answer.least.distance << " of " << line.length() << ", observer "
                    << observer.plan.x << ", " << observer.plan.y << ", " << observer.height;
  }
}

}  // namespace arete::test

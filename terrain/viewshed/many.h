// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/viewshed/viewshed.h"

namespace arete {

/// One of several observers, with the field it looks at.
struct ViewshedSite {
  ViewshedObserver observer;
  ViewshedField field;
};

/// What several observers see together, on the model's own grid, row by row.
struct ViewshedOfMany {
  std::uint32_t columns = 0, rows = 0;
  /// Seen by any; else undecided or unknown by any; else hidden from any; outside for all.
  std::vector<ViewshedCell> cells;
  /// What stands for a number that is not known: greater than any number of observers.
  static constexpr std::uint16_t kUnknown = 65533, kUndecided = 65534;
  /// How many see the cell. Not known where whether one of them does is not: kUndecided where any is
  /// undecided, else kUnknown.
  std::vector<std::uint16_t> count;
  /// The observer nearest along the ground of those that see the cell, counted from 1; 0 = none. Not known
  /// where one that is no farther may see it as well: the nearest such says which of the two. Empty unless
  /// asked for.
  std::vector<std::uint16_t> server;
};

/// Viewsheds of up to 65 000 observers, one after the other, each on all threads; the options' own field is
/// not used. The same for any number of threads. Preconditions: `earth` and `model` are those of the maker.
/// Errors: usage (none, too many), those of ViewshedMaker::from(). Memory: 21 bytes per sample beside one
/// viewshed.
Result<ViewshedOfMany> viewshedOfMany(const ViewshedMaker& maker, const TerrainModel& model,
                                      const SightEarth& earth, std::span<const ViewshedSite> sites,
                                      const ViewshedOptions& options, bool wantsServer,
                                      const RunContext& context = {});

}  // namespace arete

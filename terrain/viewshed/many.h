// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/viewshed/viewshed.h"

namespace arete {

/// One of several observers, with its own field of view.
struct ViewshedSite {
  ViewshedObserver observer;
  ViewshedField field;
};

/// What several observers see together, on the model's own grid, row by row.
struct ViewshedOfMany {
  std::uint32_t columns = 0, rows = 0;
  /// Seen by any observer; else undecided or unknown for any; else hidden from any; else outside for all.
  std::vector<ViewshedCell> cells;
  /// Marks in place of a number, which are larger than any number of observers.
  static constexpr std::uint16_t kUnknown = 65533, kUndecided = 65534;
  /// The number of observers that see the cell; kUndecided or kUnknown if any of them is undecided or
  /// unknown.
  std::vector<std::uint16_t> count;
  /// The number, from 1, of the observer nearest along the ground of those that see the cell; 0 = none. If an
  /// observer that is no farther is undecided or unknown, the mark of the nearest such. Empty if not
  /// requested.
  std::vector<std::uint16_t> server;
  std::uint64_t withoutLine = 0;  ///< the most Viewshed::withoutLine of an observer
};

/// Computes the viewsheds of up to 65 000 observers one after the other, each on all threads, and combines
/// them; the same for any number of threads. Memory: 21 bytes per sample, and one viewshed.
/// @param model,earth those of the maker.
/// @param options their own field is not used.
/// @param wantsServer compute ViewshedOfMany::server.
/// @return Errors: usage: no observer or too many; those of ViewshedMaker::from().
Result<ViewshedOfMany> viewshedOfMany(const ViewshedMaker& maker, const TerrainModel& model,
                                      const SightEarth& earth, std::span<const ViewshedSite> sites,
                                      const ViewshedOptions& options, bool wantsServer,
                                      const RunContext& context = {});

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "terrain/viewshed.h"

namespace arete {

/// One of several observers, with the field it looks at.
struct ViewshedSite {
  ViewshedObserver observer;
  ViewshedField field;
};

/// What several observers see together, on the model's own grid, row by row.
struct ViewshedCover {
  static constexpr std::int32_t kNobody = -1;

  std::uint32_t columns = 0, rows = 0;
  std::vector<std::uint32_t> counts;  ///< how many see the cell
  /// The best server: of the sites that see the cell the nearest along the ground, of equally near ones the
  /// first.
  std::vector<std::int32_t> best;
  std::uint64_t seen = 0;  ///< cells that anybody sees
  std::uint64_t rays = 0;
};

/// One viewshed after the other; the options' own field is not used. Memory: the result and one viewshed,
/// however many sites there are. The same for any number of threads. Errors: those of ViewshedMaker::from(),
/// naming the site by its number from 1; usage (more sites than 31 bits can number).
Result<ViewshedCover> viewshedCover(const ViewshedMaker& maker, const SightEarth& earth,
                                    std::span<const ViewshedSite> sites, const ViewshedOptions& options,
                                    const RunContext& context = {});

}  // namespace arete

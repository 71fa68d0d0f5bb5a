// SPDX-License-Identifier: GPL-3.0-or-later
//
// A running result per cell: the cell of the largest weight, the count, and the nearest observer that sees it
// and that may see it.
#include "terrain/viewshed/many.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"

namespace arete {
namespace {

constexpr std::size_t kMostObservers = 65000, kCellsPerTask = 4096;
static_assert(kMostObservers < ViewshedOfMany::kUnknown);

/// Of several observers' cells, that of the largest weight is the result.
int weightOf(ViewshedCell cell) {
  switch (cell) {
    case ViewshedCell::seen:
      return 4;
    case ViewshedCell::undecided:
      return 3;
    case ViewshedCell::unknown:
      return 2;
    case ViewshedCell::hidden:
      return 1;
    default:
      return 0;
  }
}

bool isSure(ViewshedCell cell) {
  return cell != ViewshedCell::unknown && cell != ViewshedCell::undecided;
}

std::uint16_t markOf(ViewshedCell cell) {
  return cell == ViewshedCell::undecided ? ViewshedOfMany::kUndecided : ViewshedOfMany::kUnknown;
}

/// Adds one observer's cell to the count.
void addTo(std::uint16_t& count, ViewshedCell cell) {
  const bool isCounted = count < ViewshedOfMany::kUnknown;
  if (!isSure(cell)) {
    count = isCounted ? markOf(cell) : std::max(count, markOf(cell));
  } else if (isCounted && cell == ViewshedCell::seen) {
    ++count;
  }
}

/// The nearest observer so far, or its mark; 0 = none.
struct Nearest {
  std::uint16_t number = 0;
  float distance = 0;

  void add(std::uint16_t other, float itsDistance) {
    if (number != 0 && !(itsDistance < distance)) return;
    number = other;
    distance = itsDistance;
  }
};

}  // namespace

Result<ViewshedOfMany> viewshedOfMany(const ViewshedMaker& maker, const TerrainModel& model,
                                      const SightEarth& earth, std::span<const ViewshedSite> sites,
                                      const ViewshedOptions& options, bool wantsServer,
                                      const RunContext& context) try {
  if (sites.empty()) return failure(ErrorCode::usage, "there is no observer", "sites");
  if (sites.size() > kMostObservers)
    return failure(ErrorCode::usage,
                   fmt::format("{} observers are more than {}", sites.size(), kMostObservers), "sites");
  ViewshedOfMany all;
  all.columns = model.columns;
  all.rows = model.rows;
  const std::size_t size = std::size_t{all.columns} * all.rows;
  all.cells.assign(size, ViewshedCell::outside);
  all.count.assign(size, 0);
  std::vector<Nearest> sees(wantsServer ? size : 0), maySee(sees);
  for (std::size_t n = 0; n < sites.size(); ++n) {
    RunContext part = context;
    part.progress = [&](std::string_view stage, double fraction) {
      context.report(stage, (double(n) + fraction) / double(sites.size()));
    };
    ViewshedOptions its = options;
    its.field = sites[n].field;
    ARETE_TRY(const auto one, maker.from(sites[n].observer, its, part));
    all.withoutLine = std::max(all.withoutLine, one.withoutLine);
    const auto server = static_cast<std::uint16_t>(n + 1);
    withThreads(context, [&] {
      parallelFor(IndexRange<std::size_t>(0, size, kCellsPerTask), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end() && !context.cancelled(); ++i) {
          const ViewshedCell cell = one.cells[i];
          if (weightOf(cell) > weightOf(all.cells[i])) all.cells[i] = cell;
          addTo(all.count[i], cell);
          if (!wantsServer || (isSure(cell) && cell != ViewshedCell::seen)) continue;
          const Vec2 place{double(i % all.columns), double(i / all.columns)};
          const auto along = earth.distance(sites[n].observer.plan, place);
          if (!along) continue;
          const auto distance = static_cast<float>(*along);
          if (isSure(cell)) {
            sees[i].add(server, distance);
          } else {
            maySee[i].add(markOf(cell), distance);
          }
        }
      });
    });
    if (context.cancelled()) return failure(ErrorCode::interrupted, "the viewshed was stopped");
  }
  all.server.reserve(sees.size());
  for (std::size_t i = 0; i < sees.size(); ++i) {
    const bool isKnown =
        maySee[i].number == 0 || (sees[i].number != 0 && sees[i].distance < maySee[i].distance);
    all.server.push_back(isKnown ? sees[i].number : maySee[i].number);
  }
  return all;
} catch (...) {
  return caughtFailure();
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/viewshed_many.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <utility>

#include "engine/with_threads.h"

namespace arete {
namespace {

constexpr std::size_t kMostObservers = 65000, kCellsPerTask = 4096;

/// Which of two cells says more about what the observers see together.
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

}  // namespace

Result<ViewshedOfMany> viewshedOfMany(const ViewshedMaker& maker, const TerrainModel& model,
                                      const SightEarth& earth, std::span<const ViewshedSite> sites,
                                      const ViewshedOptions& options, bool wantsServer,
                                      const RunContext& context) {
  if (sites.empty()) return failure(ErrorCode::usage, "there is no observer");
  if (sites.size() > kMostObservers)
    return failure(ErrorCode::usage,
                   fmt::format("{} observers are more than {}", sites.size(), kMostObservers));
  ViewshedOfMany all;
  all.columns = model.columns;
  all.rows = model.rows;
  const std::size_t size = std::size_t{all.columns} * all.rows;
  all.cells.assign(size, ViewshedCell::outside);
  all.count.assign(size, 0);
  std::vector<float> nearest;
  if (wantsServer) {
    all.server.assign(size, 0);
    nearest.assign(size, 0);
  }
  for (std::size_t n = 0; n < sites.size(); ++n) {
    RunContext part = context;
    part.progress = [&](std::string_view stage, double fraction) {
      context.report(stage, (double(n) + fraction) / double(sites.size()));
    };
    ViewshedOptions its = options;
    its.field = sites[n].field;
    const auto one = maker.from(sites[n].observer, its, part);
    if (!one) return tl::unexpected(one.error());
    const auto server = static_cast<std::uint16_t>(n + 1);
    withThreads(context, [&] {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, size, kCellsPerTask), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end() && !context.cancelled(); ++i) {
          const ViewshedCell cell = one->cells[i];
          if (weightOf(cell) > weightOf(all.cells[i])) all.cells[i] = cell;
          if (cell != ViewshedCell::seen) continue;
          ++all.count[i];
          if (!wantsServer) continue;
          const Vec2 place{double(i % all.columns), double(i / all.columns)};
          const auto track = earth.track(sites[n].observer.plan, place);
          if (!track) continue;
          const auto distance = static_cast<float>(track->points.back().distance);
          if (all.server[i] == 0 || distance < nearest[i]) {
            all.server[i] = server;
            nearest[i] = distance;
          }
        }
      });
    });
    if (context.cancelled()) return failure(ErrorCode::interrupted, "the viewshed was stopped");
  }
  return all;
}

}  // namespace arete

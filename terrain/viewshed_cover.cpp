// SPDX-License-Identifier: GPL-3.0-or-later
//
// Distances are asked for only where a second site sees a cell.
#include "terrain/viewshed_cover.h"

#include <tbb/parallel_for.h>

#include <atomic>
#include <cmath>
#include <string>
#include <utility>

#include "engine/with_threads.h"

namespace arete {
namespace {

class Distances {
 public:
  explicit Distances(const SightEarth& earth) : earth_(earth), steps_(earth.planeSteps()) {}

  Result<double> between(Vec2 from, Vec2 to) const {
    if (steps_) {
      const double x = to.x - from.x, y = to.y - from.y;
      return std::hypot(x * steps_->x.x + y * steps_->y.x, x * steps_->x.y + y * steps_->y.y);
    }
    const auto track = earth_.track(from, to);
    if (!track) return tl::unexpected(track.error());
    return track->points.back().distance;
  }

 private:
  const SightEarth& earth_;
  std::optional<SightEarth::PlaneSteps> steps_;
};

}  // namespace

Result<ViewshedCover> viewshedCover(const ViewshedMaker& maker, const SightEarth& earth,
                                    std::span<const ViewshedSite> sites, const ViewshedOptions& options,
                                    const RunContext& context) {
  if (sites.size() > 0x7FFFFFFFu)
    return failure(ErrorCode::usage, "more than 31 bits can number", "the observers");
  ViewshedCover cover;
  cover.columns = maker.grid().columns();
  cover.rows = maker.grid().rows();
  cover.counts.resize(std::size_t{cover.columns} * cover.rows);
  cover.best.assign(cover.counts.size(), ViewshedCover::kNobody);
  const Distances distances(earth);
  RunContext quiet = context;
  quiet.progress = nullptr;
  context.report("viewsheds", 0);
  for (std::size_t i = 0; i < sites.size(); ++i) {
    ViewshedOptions one = options;
    one.field = sites[i].field;
    one.value = ViewshedValue::none;
    const auto viewshed = maker.from(sites[i].observer, one, quiet);
    if (!viewshed) {
      const Error& error = viewshed.error();
      if (error.code == ErrorCode::interrupted) return tl::unexpected(error);
      return failure(error.code, error.describe(), "observer " + std::to_string(i + 1));
    }
    cover.rays += viewshed->rays;
    std::atomic<bool> isBroken = false;
    withThreads(context, [&] {
      tbb::parallel_for(0u, cover.rows, [&](std::uint32_t row) {
        for (std::uint32_t column = 0; column < cover.columns; ++column) {
          const std::size_t at = std::size_t{row} * cover.columns + column;
          if (viewshed->cells[at] != ViewshedCell::seen) continue;
          ++cover.counts[at];
          std::int32_t& best = cover.best[at];
          if (best != ViewshedCover::kNobody) {
            const Vec2 to{double(column), double(row)};
            const auto old = distances.between(sites[std::size_t(best)].observer.plan, to),
                       now = distances.between(sites[i].observer.plan, to);
            if (!old || !now) isBroken = true;  // not seen: both have answered for their lines
            if (isBroken || !(*now < *old)) continue;
          }
          best = static_cast<std::int32_t>(i);
        }
      });
    });
    if (isBroken) return failure(ErrorCode::invalidData, "has no distance", "a cell that is seen");
    context.report("viewsheds", double(i + 1) / double(sites.size()));
  }
  for (const std::uint32_t count : cover.counts) cover.seen += count > 0;
  return cover;
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#include "viewer/window/viewshed_job.h"

#include <algorithm>
#include <utility>

namespace arete {
namespace {

Rgba colorOf(ViewshedCell cell) {
  switch (cell) {
    case ViewshedCell::seen:
      return {255, 176, 32, 120};
    case ViewshedCell::hidden:
      return {24, 30, 48, 130};
    case ViewshedCell::unknown:
    case ViewshedCell::undecided:
      return {60, 120, 220, 130};
    default:
      return {0, 0, 0, 0};
  }
}

}  // namespace

ViewshedOverlay overlayOf(const Viewshed& viewshed, int mostPixels) {
  const std::uint32_t most = std::uint32_t(std::max(mostPixels, 1));
  const std::uint32_t step = (std::max(viewshed.columns, viewshed.rows) + most - 1) / most;
  PlanPicture overlay;
  overlay.width = int((viewshed.columns + step - 1) / step);
  overlay.height = int((viewshed.rows + step - 1) / step);
  overlay.rgba.reserve(std::size_t(overlay.width) * std::size_t(overlay.height));
  for (int y = 0; y < overlay.height; ++y)
    for (int x = 0; x < overlay.width; ++x) {
      const std::uint32_t column = std::min(std::uint32_t(x) * step + step / 2, viewshed.columns - 1);
      const std::uint32_t row = std::min(std::uint32_t(y) * step + step / 2, viewshed.rows - 1);
      overlay.rgba.push_back(colorOf(viewshed.cells[std::size_t(row) * viewshed.columns + column]));
    }
  // Sample 0 covers the plan from -1/2 to 1/2.
  overlay.scale = {1.0 / (step * double(overlay.width)), 1.0 / (step * double(overlay.height))};
  overlay.shift = {0.5 * overlay.scale.x, 0.5 * overlay.scale.y};
  return {std::make_shared<const PlanPicture>(std::move(overlay)), viewshed.seen,
          viewshed.seen + viewshed.hidden + viewshed.unknown + viewshed.undecided};
}

Legend overlayLegend() {
  return {.title = "viewshed",
          .entries = {{colorOf(ViewshedCell::seen), "seen"},
                      {colorOf(ViewshedCell::hidden), "hidden"},
                      {colorOf(ViewshedCell::unknown), "unknown"}}};
}

void ViewshedJob::start(const TerrainModel& model, const SightEarth& earth, const ViewshedObserver& observer,
                        double targetHeight, int mostPixels) {
  work_.start([&model, &earth, observer, targetHeight,
               mostPixels](const RunContext& context) -> Result<ViewshedOverlay> {
    ARETE_TRY(const auto maker, ViewshedMaker::make(model, earth, {}, context));
    ViewshedOptions options;
    options.targetHeight = targetHeight;
    ARETE_TRY(const auto viewshed, maker.from(observer, options, context));
    return overlayOf(viewshed, mostPixels);
  });
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// In the image plane of the observer an edge of the terrain is a straight segment, and the skyline of all
// terrain up to some distance is the upper envelope of the edges. A sample is visible if and only if it is
// not below that skyline [DeFlorianiMagillo1994]. The plan is cut into four sectors (ViewshedSector) and
// these into wedges, each swept from the observer outwards, one lattice line after the other
// [FranklinRay1994]. (Sweeps that rotate about the observer [VanKreveld1996] decide all samples in O(n log
// n), for terrain that is level in each cell.)
//
// Rounding. Edges that point at the observer have no width in the image. Near u = 0, where edges along x
// point at the observer, u is exact to its last bit. So it is for diagonals if u is measured from the
// diagonal, by y - x in place of y: wedges with u >= 1/2 are sheared that way.
//
// Over an ellipsoid the plan is an AzimuthalMap, in which tracks are straight except for a thousandth of a
// step. How much the terrain rises within that is uncertain, and so is whether a line that close to NODATA is
// over terrain. Edges that point at the observer are left out.
//
// What is decided here is beyond all uncertainty: terrain that hides is at least two tolerances above the
// line, and terrain in front of a visible sample is not above the line at all. Every other sample takes an
// engine's answer: those in between, less than a step away, beside NODATA and not hidden by terrain in front
// of that, or behind a corner of the terrain that a line may meet in a single point.

#include <algorithm>
#include <cmath>

#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/shared_progress.h"
#include "engine/parallel/with_threads.h"
#include "terrain/viewshed/wedge.h"

namespace arete {
namespace {

/// Samples of the farthest lattice line in a wedge, roughly.
constexpr double kWedgeSamples = 512;

std::vector<ViewshedWedge> wedgesOf(const ImagePlane& image, bool isAlongRows) {
  std::vector<ViewshedWedge> wedges;
  const SightGrid& grid = image.task().grid;
  for (const int sign : {1, -1}) {
    const ViewshedSector sector{isAlongRows, sign};
    const double at = isAlongRows ? image.task().observer.plan.x : image.task().observer.plan.y;
    const double far = sign > 0 ? (isAlongRows ? grid.columns() : grid.rows()) - 1 - at : at;
    if (!(far > 0)) continue;
    // The sectors along rows own the samples on the diagonals; mapped, where these are rounded, a little
    // more.
    const double more = image.isMapped() && isAlongRows ? 1e-9 : 0;
    const int parts = 4 * std::max(1, static_cast<int>(far / 2 / kWedgeSamples));
    for (int i = 0; i < parts; ++i) {
      const double first = -1 + 2.0 * i / parts, last = -1 + 2.0 * (i + 1) / parts;
      wedges.push_back({sector, i == 0 ? first - more : first, i + 1 == parts ? last + more : last,
                        i > 0 || isAlongRows, i + 1 == parts && isAlongRows});
    }
  }
  return wedges;
}

}  // namespace

std::optional<std::string> whyNotSweep(const ViewshedTask& task, const AzimuthalMap* map) {
  if (!task.earth.planeSteps() && !task.earth.geodesicError())
    return "tracks over this Earth are neither straight in plan nor geodesics";
  const bool isMapped = !task.earth.planeSteps();
  if (isMapped && task.options.value != ViewshedValue::none)
    return "over an ellipsoid it gives cells, but no heights or horizons";
  const SightGrid& grid = task.grid;
  const Vec2 o = task.observer.plan;
  const double margin = isMapped ? 2 : 0;  // geodesics may leave the DEM
  if (!(o.x >= margin && o.y >= margin && o.x <= grid.columns() - 1 - margin &&
        o.y <= grid.rows() - 1 - margin))
    return isMapped ? "the observer is outside of the DEM or at its border"
                    : "the observer is outside of the DEM";
  const int column = static_cast<int>(o.x), row = static_cast<int>(o.y);
  double greatest = 0;
  for (int r = row - 2; r <= row + 3; ++r)
    for (int c = column - 2; c <= column + 3; ++c) {
      if (c < 0 || r < 0 || c >= static_cast<int>(grid.columns()) || r >= static_cast<int>(grid.rows()))
        continue;
      const double z = grid.height(static_cast<std::uint32_t>(c), static_cast<std::uint32_t>(r));
      if (!std::isnan(z)) greatest = std::max(greatest, std::fabs(z - task.observer.height));
    }
  const double above = task.observer.height - grid.at(o), unit = task.model.georeference.verticalUnitMetres;
  if (above < -0.5e-6 / unit) return "the observer is below the ground";
  // An edge that nearly meets the observer is left out where it is nearest. Beside NODATA it may be the rim
  // of the terrain; then rounding decides whether the observer is over terrain.
  constexpr double kNearest = 2e-6;
  const auto off = [](double v) { return std::fabs(v - std::round(v)); };
  const auto isNear = [&](double v) { return off(v) > 0 && off(v) < kNearest; };
  const bool isNearEdge = isNear(o.x) || isNear(o.y) || isNear(o.x - o.y) || isNear(o.x + o.y);
  if (isNearEdge && !(above >= 100 * kNearest * greatest))
    return "the observer is on the ground, very close to an edge";
  if (std::isnan(above) && off(o.x) > 0 && (off(o.x - o.y) < kNearest || off(o.x + o.y) < kNearest))
    return "the observer is over NODATA, very close to an edge";
  // Mapped terrain is drawn too high by what it rises within the map's error: an observer on the ground would
  // be below it. The factors 4 and 2 are tested.
  if (map != nullptr && above < 4 * map->planError(0) * greatest + 2 * map->heightError(0) / unit)
    return "the observer is on the ground";
  return std::nullopt;
}

Status viewshedSweep(const ViewshedTask& task, const AzimuthalMap* map, const RunContext& context,
                     Viewshed& result) {
  const ImagePlane image(task, map, &task.steepness);
  const Vec2 o = task.observer.plan;
  if (o.x == std::floor(o.x) && o.y == std::floor(o.y)) {
    const std::size_t own =
        static_cast<std::size_t>(o.y) * task.grid.columns() + static_cast<std::size_t>(o.x);
    ARETE_TRY(const auto answer, task.exact.at(o, task.grid.row(0)[own]));
    result.cells[own] = answer.cell;
    if (!result.values.empty()) result.values[own] = answer.value;
    result.rays += answer.cell != ViewshedCell::outside;
  }
  double before = 0;
  for (const bool isAlongRows : {true, false}) {
    const std::vector<ViewshedWedge> wedges = wedgesOf(image, isAlongRows);
    std::vector<std::uint64_t> rays(wedges.size());
    std::vector<Status> statuses(wedges.size());
    SharedProgress progress(context, "viewshed", wedges.size(), before, before + 0.5);
    withThreads(context, [&] {
      parallelFor(std::size_t{0}, wedges.size(), [&](std::size_t i) {
        if (context.cancelled()) return;
        ViewshedWedgeSweep sweep(image, wedges[i], result);
        statuses[i] = sweep.run(context);
        rays[i] = sweep.rays();
        progress.add();
      });
    });
    if (context.cancelled()) return failure(ErrorCode::interrupted, "the viewshed was stopped");
    for (const Status& status : statuses)
      if (!status) return status;
    for (const std::uint64_t count : rays) result.rays += count;
    before = 0.5;
  }
  return {};
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/terrain_model.h"
#include "terrain/sight/answer.h"
#include "terrain/sight/earth.h"
#include "terrain/sight/engine.h"
#include "terrain/sight/grid.h"

namespace arete {

/// What an observer sees of a cell: of a target above a place of the terrain.
enum class ViewshedCell : std::uint8_t {
  hidden,     ///< the line of sight to it is blocked
  seen,       ///< visible
  unknown,    ///< nothing known is in the way, but there is NODATA (NodataSight::unknown)
  undecided,  ///< the tolerance asked for does not tell
  outside,    ///< beyond the distances or the field of view, or there is no sample
};

struct ViewshedObserver {
  Vec2 plan;          ///< plan coordinates of the model
  double height = 0;  ///< its own height, in the DEM's vertical unit
};

/// The part of the world that is looked at; both ends of each range are in it.
struct ViewshedField {
  double leastMetres = 0, greatestMetres = std::numeric_limits<double>::infinity();  ///< along the ground
  /// Horizontal field: from this azimuth clockwise, degrees; all around from 360 on.
  double fromAzimuth = 0, azimuthSpan = 360;
  /// Vertical field: elevation angles of the target above the observer's horizontal, degrees.
  double lowest = -90, highest = 90;
};

enum class ViewshedValue : std::uint8_t {
  none,
  /// The least height above the terrain, in the DEM's vertical unit, that would be seen there: 0 where the
  /// terrain is; infinite where none would (an observer below the ground, NODATA that blocks); NaN where
  /// NODATA in between leaves it unknown. Whatever the target height.
  leastHeight,
  /// The tangent of the elevation at which the terrain ends for the observer, looking over the cell: of all
  /// terrain from the observer to the cell, the cell's included: of what there is, where NODATA does not
  /// block. Infinite as above.
  horizon,
};

enum class ViewshedMethod : std::uint8_t {
  automatic,  ///< the sweep where it can, else rays
  sweep,      ///< all cells at once, the horizon kept (viewshed_sweep.cpp): over planes and geodesics
  rays,       ///< an engine's answer for each cell
};
std::string_view toString(ViewshedMethod method);

struct ViewshedOptions {
  double targetHeight = 0;  ///< above the terrain, in the DEM's vertical unit; at least 0
  ViewshedField field;
  NodataSight nodata = NodataSight::unknown;
  /// Three classes: what bounds within this do not decide is `undecided`. By rays and the descent only.
  double maxError = 0;
  ViewshedValue value = ViewshedValue::none;
  ViewshedMethod method = ViewshedMethod::automatic;
};

/// On the model's own grid, row by row.
struct Viewshed {
  std::uint32_t columns = 0, rows = 0;
  std::vector<ViewshedCell> cells;
  std::vector<float> values;  ///< as asked for; NaN outside, for the observer's own place's horizon
  std::uint64_t seen = 0, hidden = 0, unknown = 0, undecided = 0, outside = 0;
  ViewshedMethod method = ViewshedMethod::rays;  ///< which it was
  std::uint64_t rays = 0;                        ///< cells that took an engine's answer
};

/// What can be seen of a terrain. For every cell the answer is that of a SightEngine for the line from the
/// observer to (sample, its height + target height): docs/topics/visibility.md,
/// by either method. Thread-safe.
class ViewshedMaker {
 public:
  /// Preconditions: the model and the earth outlive it; `grid`, where given, is the model's. Errors:
  /// unsupported (a model of points).
  static Result<ViewshedMaker> make(const TerrainModel& model, const SightEarth& earth,
                                    std::shared_ptr<const SightGrid> grid = {},
                                    const RunContext& context = {});

  /// A place within 1e-9 of a lattice line counts as on it. Errors: usage (options out of range),
  /// unsupported (the sweep, where it cannot), interrupted, those of the earth. The sweep: O(samples) for
  /// terrain as it is, with a worst case of O(samples * side); rays: O(samples) answers. Memory: the result
  /// and O(side) per thread. The same bytes for any number of threads.
  Result<Viewshed> from(const ViewshedObserver& observer, const ViewshedOptions& options = {},
                        const RunContext& context = {}) const;

  /// The same for targets anywhere, on the terrain at `places` (plan coordinates; NaN is nowhere) or the
  /// target height above it: a viewshed of one row, by rays. Errors: those of from(); unsupported (the
  /// sweep).
  Result<Viewshed> of(std::span<const Vec2> places, const ViewshedObserver& observer,
                      const ViewshedOptions& options = {}, const RunContext& context = {}) const;

  const SightGrid& grid() const { return *grid_; }

 private:
  ViewshedMaker(const TerrainModel& model, const SightEarth& earth, std::shared_ptr<const SightGrid> grid)
      : model_(&model), earth_(&earth), grid_(std::move(grid)) {}

  Result<std::shared_ptr<const SightEngine>> engineFor(const ViewshedOptions& options) const;

  const TerrainModel* model_;
  const SightEarth* earth_;
  std::shared_ptr<const SightGrid> grid_;
  std::shared_ptr<const SightEngine> engine_;
  std::shared_ptr<const std::vector<float>> steepness_;
};

}  // namespace arete

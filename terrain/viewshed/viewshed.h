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

/// Whether an observer sees the target above one sample.
enum class ViewshedCell : std::uint8_t {
  hidden,     ///< the line of sight to it is blocked
  seen,       ///< it is visible
  unknown,    ///< nothing known is in the way, but NODATA is (NodataSight::unknown)
  undecided,  ///< the terrain within the requested tolerance does not decide it
  outside,    ///< out of range or of the field of view, or the sample is NODATA
};

/// The value of a cell in a raster of bytes: 255 seen, 0 hidden, 100 unknown, 200 undecided, 1 outside.
std::uint8_t byteOf(ViewshedCell cell);

struct ViewshedObserver {
  Vec2 plan;          ///< plan coordinates of the model
  double height = 0;  ///< from the DEM's zero (not above the terrain), in the DEM's vertical unit
};

/// The field of view. Both ends of each range belong to it.
struct ViewshedField {
  double leastMetres = 0, greatestMetres = std::numeric_limits<double>::infinity();  ///< along the ground
  /// Horizontal: degrees; `azimuthSpan` clockwise from `fromAzimuth`. 360 or more = all around.
  double fromAzimuth = 0, azimuthSpan = 360;
  /// Vertical: degrees; elevation angles of the target above the observer's horizontal.
  double lowest = -90, highest = 90;
};

enum class ViewshedValue : std::uint8_t {
  none,
  /// The least height above the terrain at which a target would be seen, in the DEM's vertical unit. 0 if the
  /// terrain itself is seen; infinite if no height is (an observer below the ground, NODATA that blocks); NaN
  /// if NODATA leaves it unknown. It does not depend on the target height.
  leastHeight,
  /// The tangent of the elevation angle of the horizon over the cell: of the highest terrain seen from the
  /// observer up to the cell, the cell included. NODATA that does not block is left out. Infinite as above.
  horizon,
};

enum class ViewshedMethod : std::uint8_t {
  automatic,  ///< the sweep if it can do the task, else rays
  sweep,      ///< all cells at once by a growing skyline (sweep.cpp); over planes and geodesics
  rays,       ///< an engine's answer for each cell
};
std::string_view toString(ViewshedMethod method);

struct ViewshedOptions {
  double targetHeight = 0;  ///< above the terrain, in the DEM's vertical unit; 0 or more
  ViewshedField field;
  NodataSight nodata = NodataSight::unknown;
  /// Tolerance in the DEM's vertical unit: cells that terrain within it does not decide are `undecided`. 0 =
  /// full resolution. With a tolerance the method is rays, by the descent.
  double maxError = 0;
  ViewshedValue value = ViewshedValue::none;
  ViewshedMethod method = ViewshedMethod::automatic;
};

/// The result, on the model's own grid, row by row.
struct Viewshed {
  std::uint32_t columns = 0, rows = 0;
  std::vector<ViewshedCell> cells;
  std::vector<float>
      values;  ///< ViewshedOptions::value; NaN outside, and for the horizon at the observer itself
  std::uint64_t seen = 0, hidden = 0, unknown = 0, undecided = 0, outside = 0;
  ViewshedMethod method = ViewshedMethod::rays;  ///< the method used
  std::uint64_t rays = 0;                        ///< number of cells that an engine answered
  /// Cells to which the Earth has no line, as over a pole; they are unknown.
  std::uint64_t withoutLine = 0;
};

/// Computes viewsheds. By either method, each cell is the answer of a SightEngine for the line from the
/// observer to (sample, its height + target height): docs/topics/visibility.md. Thread-safe.
class ViewshedMaker {
 public:
  /// Prepares a pyramid, and for a geodesic Earth the steepness of the terrain. O(samples), parallel.
  /// @param model,earth outlive the result.
  /// @param grid the model's samples, possibly shared; null: made here.
  /// @return Errors: unsupported: a model of points.
  static Result<ViewshedMaker> make(const TerrainModel& model, const SightEarth& earth,
                                    std::shared_ptr<const SightGrid> grid = {},
                                    const RunContext& context = {});

  /// The viewshed of one observer, the same bytes for any number of threads. An observer within 1e-9 of a
  /// lattice line counts as on it. The sweep takes O(samples) for usual terrain and O(samples * side) at
  /// worst; rays take O(samples) answers of an engine. Memory: the result, and O(side) per thread.
  /// @return Errors: usage: options out of range (the culprit is the field); unsupported: the sweep cannot do
  ///     it; interrupted; those of the earth at the observer. A sample that it has no line to is unknown.
  Result<Viewshed> from(const ViewshedObserver& observer, const ViewshedOptions& options = {},
                        const RunContext& context = {}) const;

  /// The same for targets on, or the target height above, the terrain at given places, by rays.
  /// @param places plan coordinates; NaN stays outside.
  /// @return a viewshed of one row. Errors: those of from(); unsupported: the sweep.
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

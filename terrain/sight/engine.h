// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string_view>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/terrain_model.h"
#include "terrain/sight/answer.h"
#include "terrain/sight/grid.h"
#include "terrain/sight/line.h"

namespace arete {

/// Ways to find out what is below a sight line. All give the same answer, that of the finest triangulation
/// (docs/topics/visibility.md); they differ in what they look at.
enum class SightMethod {
  automatic,  ///< the pyramid for rasters, the descent for points and for a tolerance
  descent,    ///< down the multitriangulation, by its signed bounds
  pyramid,    ///< rasters: blocks of cells with their highest samples, then cells
  scan,       ///< rasters: every cell below the line
  embree,     ///< rasters: Embree, on a front raised and one lowered by its bounds, then the descent
};
std::string_view toString(SightMethod method);

/// Thread-safe: it is only read.
class SightEngine {
 public:
  virtual ~SightEngine() = default;
  virtual SightAnswer answer(const SightLine& line, const SightOptions& options) const = 0;
};

/// Preconditions: the model outlives the engine; so does the grid, which is that of the model, shared by who
/// asks for several engines. Errors: unsupported (a method for rasters and a model of points; a tolerance and
/// a method that has none). descent: O(root triangles); pyramid: O(samples), parallel; scan: O(1); embree:
/// O(front log front).
Result<std::unique_ptr<SightEngine>> makeSightEngine(SightMethod method, const TerrainModel& model,
                                                     std::shared_ptr<const SightGrid> grid = {},
                                                     const RunContext& context = {});

/// The engines by themselves.
std::unique_ptr<SightEngine> makeSightScan(std::shared_ptr<const SightGrid> grid);
std::unique_ptr<SightEngine> makeSightPyramid(std::shared_ptr<const SightGrid> grid,
                                              const RunContext& context = {});
std::unique_ptr<SightEngine> makeSightDescent(const TerrainModel& model);
std::unique_ptr<SightEngine> makeSightEmbree(const TerrainModel& model);

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <string_view>

#include "engine/base/result.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/terrain_model.h"
#include "terrain/sight/answer.h"
#include "terrain/sight/grid.h"
#include "terrain/sight/line.h"

namespace arete {

/// Algorithms for lines of sight. All give the same answer, that of the finest triangulation
/// (docs/topics/visibility.md); they differ in how much of the terrain they examine.
enum class SightMethod {
  automatic,  ///< pyramid for rasters, descent for models of points
  descent,    ///< hierarchy of triangles with signed error bounds [DeFlorianiMagillo1994]; takes a tolerance
  pyramid,    ///< rasters: squares of cells with their highest samples [TevsIhrkeSeidel2008], then cells
  scan,       ///< rasters: every cell below the line [AmanatidesWoo1987]
  embree,     ///< rasters: Embree [WaldWoop2014] on a raised and a lowered front, then the descent
};
std::string_view toString(SightMethod method);

/// Answers single lines of sight. Thread-safe.
class SightEngine {
 public:
  virtual ~SightEngine() = default;
  virtual SightAnswer answer(const SightLine& line, const SightOptions& options) const = 0;
};

/// The method for a number of lines: for many, one that reads all samples of a raster first; for few, for
/// points and with a tolerance the descent, which starts at once.
SightMethod methodFor(std::size_t lines, double maxError, const TerrainModel& model);

/// Makes an engine. Preparation takes, descent: O(root triangles); pyramid: O(samples), in parallel; scan:
/// O(samples) without a grid, else O(1); embree: O(front log front).
/// @param model outlives the engine.
/// @param grid samples of the model, which several engines may share; null: made here if needed.
/// @return the engine. Errors: unsupported: a method for rasters and a model of points.
Result<std::unique_ptr<SightEngine>> makeSightEngine(SightMethod method, const TerrainModel& model,
                                                     std::shared_ptr<const SightGrid> grid = {},
                                                     const RunContext& context = {});

// The engines one by one. Preconditions: those of makeSightEngine(); a raster, except for the descent.
std::unique_ptr<SightEngine> makeSightScan(std::shared_ptr<const SightGrid> grid);
std::unique_ptr<SightEngine> makeSightPyramid(std::shared_ptr<const SightGrid> grid,
                                              const RunContext& context = {});
std::unique_ptr<SightEngine> makeSightDescent(const TerrainModel& model);
std::unique_ptr<SightEngine> makeSightEmbree(const TerrainModel& model);

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
// A pyramid of grids. The coarsest starts from low random relief and is eroded towards the balance of uplift
// and incision; each finer grid starts from the one before, interpolated and roughened by a little noise, and
// needs only the steps that carve the valleys the coarser one could not see. The model is wider than the map
// by a margin that is cut away, so that the map's edges are cut through country rather than made by the edge.
#include "datasets/terrain_generator.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "datasets/crs_wkt.h"
#include "datasets/erosion.h"
#include "datasets/flow_routing.h"
#include "datasets/lake.h"
#include "datasets/landscape.h"
#include "datasets/noise.h"
#include "datasets/random.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/thread_limit.h"
#include "engine/parallel/with_threads.h"

namespace arete {
namespace {

constexpr std::uint32_t kSmallest = 16, kLargest = 16385;
constexpr std::uint32_t kCoarsestSide = 200;  ///< cells; below this a grid starts from noise
constexpr double kSteepness = 330;            ///< U / K, metres: what decides the relief

/// The model's plan: the map and its margin, at the finest level.
struct Plan {
  std::uint32_t columns, rows;  ///< margin included
  std::uint32_t margin;
  double pixelMetres;
};

struct Level {
  ReliefGrid grid;
  std::vector<float> upliftMetres;  ///< of one step
  std::vector<float> erodibility;
};

Level makeLevel(const Plan& plan, int halvings, const Landscape& landscape, double incision) {
  Level level;
  const std::uint32_t step = 1u << halvings;
  ReliefGrid& grid = level.grid;
  grid.columns = (plan.columns + step - 1) / step + (halvings > 0);
  grid.rows = (plan.rows + step - 1) / step + (halvings > 0);
  grid.cellMetres = plan.pixelMetres * step;
  const std::size_t cells = std::size_t(grid.columns) * grid.rows;
  grid.heights.resize(cells);
  grid.isOutlet.resize(cells);
  level.upliftMetres.resize(cells);
  level.erodibility.resize(cells);
  const double x0 = -0.5 * plan.pixelMetres * (plan.columns - 1),
               y0 = -0.5 * plan.pixelMetres * (plan.rows - 1);
  parallelFor(IndexRange<std::uint32_t>(0, grid.rows, 8), [&](const auto& range) {
    for (std::uint32_t row = range.begin(); row < range.end(); ++row)
      for (std::uint32_t column = 0; column < grid.columns; ++column) {
        const std::size_t cell = std::size_t(row) * grid.columns + column;
        const Landscape::Place place =
            landscape.at({x0 + column * grid.cellMetres, y0 + row * grid.cellMetres});
        const bool edge = column == 0 || row == 0 || column + 1 == grid.columns || row + 1 == grid.rows;
        grid.isOutlet[cell] = edge || place.inland <= 0;
        grid.heights[cell] = place.inland <= 0 ? 0 : landscape.edgeHeight(place);
        level.upliftMetres[cell] = static_cast<float>(kSteepness * incision * place.uplift);
        level.erodibility[cell] = static_cast<float>(place.erodibility);
      }
  });
  return level;
}

/// Catmull-Rom's weights of the four samples around a fraction: smooth, so that no facets seed the valleys.
std::array<double, 4> cubicWeights(double t) {
  return {t * (-0.5 + t * (1 - 0.5 * t)), 1 + t * t * (-2.5 + 1.5 * t), t * (0.5 + t * (2 - 1.5 * t)),
          t * t * (-0.5 + 0.5 * t)};
}

/// Height between the cells of a grid, positions beyond its edge moved to the edge.
double heightAt(const ReliefGrid& grid, double column, double row) {
  const double x = std::clamp(column, 0.0, grid.columns - 1.0), y = std::clamp(row, 0.0, grid.rows - 1.0);
  const auto x0 = static_cast<std::int64_t>(x), y0 = static_cast<std::int64_t>(y);
  const std::array<double, 4> wx = cubicWeights(x - double(x0)), wy = cubicWeights(y - double(y0));
  double sum = 0;
  for (std::int64_t b = 0; b < 4; ++b) {
    const auto line = std::clamp<std::int64_t>(y0 + b - 1, 0, grid.rows - 1) * grid.columns;
    double along = 0;
    for (std::int64_t a = 0; a < 4; ++a)
      along += wx[std::size_t(a)] *
               grid.heights[std::size_t(line + std::clamp<std::int64_t>(x0 + a - 1, 0, grid.columns - 1))];
    sum += wy[std::size_t(b)] * along;
  }
  return sum;
}

/// Heights of `fine` between its outlets from the grid of twice the cell size, bent by a noise a few cells
/// wide: a valley that could only run in eight directions on the coarse grid winds on the fine one.
void refine(const ReliefGrid& coarse, ReliefGrid& fine, std::uint64_t seed) {
  constexpr double kBendCells = 1.6, kBendWavelength = 9;  // coarse cells
  const double roughness = 0.05 * fine.cellMetres;
  const FractalOptions bend{2, 2, 0.5};
  parallelFor(IndexRange<std::uint32_t>(0, fine.rows, 16), [&](const auto& range) {
    for (std::uint32_t row = range.begin(); row < range.end(); ++row)
      for (std::uint32_t column = 0; column < fine.columns; ++column) {
        const std::size_t cell = std::size_t(row) * fine.columns + column;
        if (fine.isOutlet[cell]) continue;
        const double x = 0.5 * column, y = 0.5 * row;
        const double u = x / kBendWavelength, v = y / kBendWavelength;
        const double height = heightAt(coarse, x + kBendCells * fractalNoise(seed + 1, u, v, bend),
                                       y + kBendCells * fractalNoise(seed + 11, u, v, bend));
        const double noise = Random::toUnit(Random::at(seed, column, row));
        fine.heights[cell] = std::max(height, 0.5) + roughness * noise;
      }
  });
}

void startFromNoise(const Plan& plan, ReliefGrid& grid, std::uint64_t seed) {
  const double extent = plan.pixelMetres * std::max(plan.columns, plan.rows);
  for (std::uint32_t row = 0; row < grid.rows; ++row)
    for (std::uint32_t column = 0; column < grid.columns; ++column) {
      const std::size_t cell = std::size_t(row) * grid.columns + column;
      if (grid.isOutlet[cell]) continue;
      const double x = column * grid.cellMetres / extent, y = row * grid.cellMetres / extent;
      grid.heights[cell] += 900 * (0.6 + fractalNoise(seed, 5 * x, 5 * y, {8, 2, 0.65}));
    }
}

/// How a level is eroded: fewer steps the finer, as their cost grows and their task shrinks.
struct Schedule {
  int steps;
  int stepsBetweenFills;
};

Schedule scheduleOf(int halvings, bool coarsest) {
  if (coarsest) return {90, 1};
  if (halvings >= 2) return {40, 5};
  return {halvings == 1 ? 25 : 15, 100};
}

Result<ReliefGrid> shape(const Plan& plan, const TerrainOptions& options, const RunContext& context) {
  const double extent = options.pixelMetres * (std::max(options.columns, options.rows) - 1);
  const Landscape landscape(options.seed, extent, options.sea);
  int halvings = 0;
  while ((std::max(plan.columns, plan.rows) >> halvings) > kCoarsestSide) ++halvings;

  ErosionStep step;
  DrainageNetwork network;
  ReliefGrid coarse;
  const int coarsest = halvings;
  for (; halvings >= 0; --halvings) {
    const std::uint64_t seed = Random::mix(options.seed + 1000 * static_cast<std::uint64_t>(halvings + 1));
    step.incision = 0.001 * options.pixelMetres * (1 << halvings);
    step.diffusionSquareMetres = 8000 * step.incision;
    Level level = makeLevel(plan, halvings, landscape, step.incision);
    if (halvings == coarsest)
      startFromNoise(plan, level.grid, seed);
    else
      refine(coarse, level.grid, seed);
    coarse = {};
    level.grid.scatterCells(0.48, seed);
    const Schedule schedule = scheduleOf(halvings, halvings == coarsest);
    for (int i = 0; i < schedule.steps; ++i) {
      if (context.cancelled())
        return failure(ErrorCode::interrupted, "generating the terrain was interrupted");
      // A level costs about as much as all coarser ones together.
      const double before = halvings == coarsest ? 0 : 1.0 / (1 << std::min(2 * halvings + 2, 30));
      const double after = 1.0 / (1 << std::min(2 * halvings, 30));
      context.report("eroding", before + (after - before) * i / schedule.steps);
      if (i % schedule.stepsBetweenFills == 0)
        removeDepressions(level.grid, halvings == coarsest ? Depressions::fill : Depressions::carve, 0.1,
                          seed, network);
      erode(level.grid, level.upliftMetres, level.erodibility, step, network);
    }
    coarse = std::move(level.grid);
  }
  context.report("eroding", 1);
  return coarse;
}

RasterHeightfield cut(const ReliefGrid& grid, const Plan& plan, const TerrainOptions& options) {
  RasterHeightfield field;
  field.columns = options.columns;
  field.rows = options.rows;
  field.heights.reserve(std::size_t(field.columns) * field.rows);
  for (std::size_t row = 0; row < field.rows; ++row)
    for (std::size_t column = 0; column < field.columns; ++column) {
      const double z = grid.heights[(row + plan.margin) * grid.columns + column + plan.margin];
      field.heights.push_back(std::floor(z * 64 + 0.5) / 64);
    }
  return field;
}

}  // namespace

Result<RasterHeightfield> generateTerrain(const TerrainOptions& options, const RunContext& context) {
  for (const std::uint32_t side : {options.columns, options.rows})
    if (side < kSmallest || side > kLargest)
      return failure(ErrorCode::usage,
                     fmt::format("terrain is generated from {} to {} columns and rows", kSmallest, kLargest),
                     fmt::format("{} x {}", options.columns, options.rows));
  if (!(options.pixelMetres > 0) || !std::isfinite(options.pixelMetres))
    return failure(ErrorCode::usage, "the pixel size must be a positive number of metres",
                   fmt::format("{}", options.pixelMetres));

  const std::uint32_t margin = std::max(8u, std::max(options.columns, options.rows) / 10);
  const Plan plan = {options.columns + 2 * margin, options.rows + 2 * margin, margin, options.pixelMetres};
  RunContext limited = context;
  limited.threads = context.threads > 0 ? std::min(context.threads, hardwareThreads()) : hardwareThreads();
  ARETE_TRY(ReliefGrid grid, withThreads(limited, [&] { return shape(plan, options, context); }));
  RasterHeightfield field = cut(grid, plan, options);
  grid = {};
  if (options.lake) floodLake(field, options.pixelMetres);

  Georeference& georeference = field.georeference;
  // South of the Alps, a whole multiple of a kilometre, so that pixel corners are whole metres.
  georeference.geoTransform = {400000, options.pixelMetres, 0, 5200000, 0, -options.pixelMetres};
  georeference.hasGeoTransform = true;
  georeference.crsWkt = std::string(kUtm32Wkt);
  georeference.verticalUnit = std::string("m");
  field.source = fmt::format("generated:{}x{}:seed={}", options.columns, options.rows, options.seed);
  field.sourceChecksum = heightsChecksum(field);
  return field;
}

}  // namespace arete

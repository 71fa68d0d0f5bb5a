// SPDX-License-Identifier: GPL-3.0-or-later
//
// A level is made of the one before, four nodes to one. Slopes and aspects are stored multiplied by the part
// of the node's square that has data, so that their mean is the plain mean of four, nodes beyond the edges
// counting as without data, and so that what interpolates between nodes divides by the part interpolated
// likewise: what has no data has no weight. Heights are weighted by that part.
#include "viewer/heights/height_pyramid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "engine/base/caught_failure.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"
#include "viewer/heights/ground_scale.h"

namespace arete {
namespace {

constexpr std::uint32_t kSmallestLevel = 32;  // along its longer side
constexpr std::size_t kMostLevels = 16;       // shaders/ground.glsl

std::int16_t coded(double part) {
  return std::int16_t(std::lround(std::clamp(part, -1.0, 1.0) * HeightPyramid::kOne));
}

/// Slopes and directions at the nodes of a lattice.
class Slopes {
 public:
  Slopes(const TerrainModel& model, const HeightLattice& lattice, const GroundScale& scale)
      : model_(model), lattice_(lattice), scale_(scale) {
    const auto& g = model.georeference.geoTransform;
    if (model.isRaster)
      axes_ = {g[1] * lattice.step.x, g[2] * lattice.step.y, g[4] * lattice.step.x, g[5] * lattice.step.y};
    else
      axes_ = {lattice.step.x, 0, 0, lattice.step.y};
    determinant_ = axes_[0] * axes_[3] - axes_[1] * axes_[2];
  }

  HeightPyramid::Ground at(std::uint32_t column, std::uint32_t row) const {
    const double here = height(column, row);
    if (std::isnan(here)) return {};
    const double c = along(height(std::int64_t(column) - 1, row), here,
                           height(std::int64_t(column) + 1, row)),
                 r = along(height(column, std::int64_t(row) - 1), here,
                           height(column, std::int64_t(row) + 1));
    const Vec2 unit = scale_.at(model_.toSource(
        {lattice_.first.x + column * lattice_.step.x, lattice_.first.y + row * lattice_.step.y}));
    const double rise = model_.georeference.verticalUnitMetres / determinant_;
    const double east = (axes_[3] * c - axes_[2] * r) * rise / unit.x,
                 north = (axes_[0] * r - axes_[1] * c) * rise / unit.y;
    const double steepness = std::hypot(east, north);
    HeightPyramid::Ground ground{.covered = coded(1)};
    ground.slope = coded(std::atan(steepness) / (std::numbers::pi / 2));
    constexpr double kLevel = 1e-5;  // less is the rounding of heights
    if (steepness > kLevel) {
      ground.east = coded(-east / steepness);
      ground.north = coded(-north / steepness);
    }
    return ground;
  }

 private:
  double height(std::int64_t column, std::int64_t row) const {
    if (column < 0 || row < 0 || column >= lattice_.columns || row >= lattice_.rows) return std::nan("");
    return lattice_.heights[std::size_t(row) * lattice_.columns + std::size_t(column)];
  }
  static double along(double before, double here, double after) {
    if (!std::isnan(before) && !std::isnan(after)) return (after - before) / 2;
    if (!std::isnan(after)) return after - here;
    return std::isnan(before) ? 0 : here - before;
  }

  const TerrainModel& model_;
  const HeightLattice& lattice_;
  const GroundScale& scale_;
  std::array<double, 4>
      axes_{};  // source units of a step along a row (x), a column (x), a row (y), a column (y)
  double determinant_ = 1;
};

Box2 boxOf(const TerrainModel& model, const HeightLattice& lattice) {
  Box2 box{INFINITY, INFINITY, -INFINITY, -INFINITY};
  for (const double i : {0.0, double(lattice.columns - 1)})
    for (const double j : {0.0, double(lattice.rows - 1)}) {
      const Vec2 p =
          model.toSource({lattice.first.x + i * lattice.step.x, lattice.first.y + j * lattice.step.y});
      box.xMin = std::min(box.xMin, p.x), box.xMax = std::max(box.xMax, p.x);
      box.yMin = std::min(box.yMin, p.y), box.yMax = std::max(box.yMax, p.y);
    }
  return box;
}

HeightPyramid::Level coarser(const HeightPyramid::Level& fine) {
  HeightPyramid::Level level{.columns = (fine.columns + 1) / 2, .rows = (fine.rows + 1) / 2};
  level.heights.resize(std::size_t(level.columns) * level.rows);
  level.ground.resize(level.heights.size());
  parallelFor(std::uint32_t(0), level.rows, [&](std::uint32_t row) {
    for (std::uint32_t column = 0; column < level.columns; ++column) {
      double height = 0, weight = 0, slope = 0, east = 0, north = 0, covered = 0;
      for (std::uint32_t y = 2 * row; y < std::min(2 * row + 2, fine.rows); ++y)
        for (std::uint32_t x = 2 * column; x < std::min(2 * column + 2, fine.columns); ++x) {
          const std::size_t i = std::size_t(y) * fine.columns + x;
          const HeightPyramid::Ground& g = fine.ground[i];
          slope += g.slope, east += g.east, north += g.north, covered += g.covered;
          if (fine.heights[i] == HeightPyramid::kNone) continue;
          height += double(fine.heights[i]) * g.covered;
          weight += g.covered;
        }
      const std::size_t to = std::size_t(row) * level.columns + column;
      level.heights[to] = weight > 0 ? float(height / weight) : HeightPyramid::kNone;
      const auto quarter = [](double sum) { return std::int16_t(std::lround(sum / 4)); };
      level.ground[to] = {quarter(slope), quarter(east), quarter(north), quarter(covered)};
      // Ever so little data keeps some weight.
      if (covered > 0 && level.ground[to].covered == 0) level.ground[to].covered = 1;
    }
  });
  return level;
}

}  // namespace

Result<HeightPyramid> HeightPyramid::create(const TerrainModel& model, const PyramidOptions& options,
                                            const RunContext& context) try {
  HeightLattice lattice;
  if (model.isRaster) lattice = latticeOfSamples(model);
  if (!lattice.isExact) {
    ARETE_TRY(HeightLattice resampled, latticeOfTriangles(model, options.step, options.mostNodes));
    lattice = std::move(resampled);
  }
  HeightPyramid pyramid;
  pyramid.isExact_ = lattice.isExact;
  pyramid.scale_ = {1 / lattice.step.x, 1 / lattice.step.y};
  pyramid.shift_ = {-lattice.first.x / lattice.step.x, -lattice.first.y / lattice.step.y};
  const Vec3& scale = model.mt.metric().scale;
  pyramid.spacing_ = {std::abs(scale.x) * lattice.step.x, std::abs(scale.y) * lattice.step.y};

  double low = INFINITY, high = -INFINITY;
  for (const double height : lattice.heights)
    if (!std::isnan(height)) low = std::min(low, height), high = std::max(high, height);
  if (!(low <= high)) return failure(ErrorCode::invalidData, "the model has no height", model.source);
  // A whole number, where floats have room for one, keeps whole heights whole.
  pyramid.base_ = std::floor((low + high) / 2);
  pyramid.reach_ = std::max(high - pyramid.base_, pyramid.base_ - low);

  Level finest{.columns = lattice.columns, .rows = lattice.rows};
  finest.heights.resize(lattice.heights.size());
  finest.ground.resize(lattice.heights.size());
  const GroundScale ground(model.georeference, boxOf(model, lattice));
  const Slopes slopes(model, lattice, ground);
  context.report("preparing heights", 0);
  withThreads(context, [&] {
    parallelFor(std::uint32_t(0), lattice.rows, [&](std::uint32_t row) {
      if (context.cancelled()) return;
      for (std::uint32_t column = 0; column < lattice.columns; ++column) {
        const std::size_t i = std::size_t(row) * lattice.columns + column;
        const double height = lattice.heights[i];
        finest.heights[i] = std::isnan(height) ? kNone : float(height - pyramid.base_);
        finest.ground[i] = slopes.at(column, row);
      }
    });
    lattice.heights = {};
    pyramid.levels_.push_back(std::move(finest));
    while (!context.cancelled() && pyramid.levels_.size() < kMostLevels &&
           std::max(pyramid.levels_.back().columns, pyramid.levels_.back().rows) > kSmallestLevel)
      pyramid.levels_.push_back(coarser(pyramid.levels_.back()));
  });
  if (context.cancelled())
    return failure(ErrorCode::interrupted, "preparing the heights was stopped", model.source);
  context.report("preparing heights", 1);
  if (model.isRaster && !pyramid.isExact_)
    pyramid.warnings_.push_back(
        {WarningCode::display,
         fmt::format("colours and contours are of its finest triangles resampled every {:.4g} of a sample",
                     lattice.step.x)});
  return pyramid;
} catch (...) {
  return caughtFailure();
}

HeightPyramid HeightPyramid::none() {
  HeightPyramid pyramid;
  pyramid.levels_.push_back({.columns = 1, .rows = 1, .heights = {kNone}, .ground = {Ground{}}});
  pyramid.spacing_ = {1, 1};
  return pyramid;
}

std::optional<double> HeightPyramid::heightAt(Vec2 plan) const {
  const Level& level = levels_.front();
  if (level.columns < 2 || level.rows < 2) return std::nullopt;
  const double x = plan.x * scale_.x + shift_.x, y = plan.y * scale_.y + shift_.y;
  if (!(x >= 0 && y >= 0 && x <= level.columns - 1 && y <= level.rows - 1)) return std::nullopt;
  const std::uint32_t column = std::min(std::uint32_t(x), level.columns - 2),
                      row = std::min(std::uint32_t(y), level.rows - 2);
  const float* above = &level.heights[std::size_t(row) * level.columns + column];
  const float* under = above + level.columns;
  const double a = double(above[0]), b = double(above[1]), c = double(under[0]), d = double(under[1]);
  const auto has = [](double h) { return h > -1e38; };
  const double u = x - column, v = y - row;
  if (has(a) && has(d)) {
    if (u >= v && has(b)) return base_ + a + u * (b - a) + v * (d - b);
    if (u <= v && has(c)) return base_ + a + u * (d - c) + v * (c - a);
    return std::nullopt;
  }
  if (!has(b) || !has(c)) return std::nullopt;
  if (has(a) && u + v <= 1) return base_ + a + u * (b - a) + v * (c - a);
  if (has(d) && u + v >= 1) return base_ + d + (1 - u) * (c - d) + (1 - v) * (b - d);
  return std::nullopt;
}

}  // namespace arete

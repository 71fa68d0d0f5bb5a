// SPDX-License-Identifier: GPL-3.0-or-later
//
// Over an ellipsoid, heights are replaced by those that have the same elevation angle without curvature. On
// an Earth of curvature k, a height h at the distance s is seen from the height h0 at the tangent
//
//     T = [ (h - h0) / (1 + k h) - (1 - cos ks) / k ] / (sin(ks) / k)
//
// (sightTangent() in terrain/sight/line.h), so without curvature it would be T s high. With b = k s^2, the
// drop (1 - cos ks) / k is b/2 (1 - kb/12 + ...), and the factor ks / sin ks is 1 + kb/6 + ...; AzimuthalMap
// limits ks.
#include "terrain/viewshed/image_plane.h"

#include <algorithm>
#include <numbers>

#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"

namespace arete {
namespace {

/// Terrain is drawn by its uncertainty higher than computed and may be as much lower: by twice it, and
/// rounding.
constexpr double kUncertainties = 2.1;
/// The tolerance of a sight line in metres, and what it grows by per metre of its length (SightLine).
constexpr double kTolerance = 1e-6, kTolerancePerMetre = 1e-12;
/// An image coordinate is rounded by a few parts in 2^53.
constexpr double kRounding = 2e-15;
/// A line of sight in the raster is at most this many times as long as the raster's sides together.
constexpr double kLongestLine = 1.1;
/// Beside a track, terrain of slope r is higher by at most kRise * r * (deviation of the track).
constexpr double kRise = 1.1;

struct Heights {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
};

Heights heightsOf(const SightGrid& grid) {
  Heights heights;
  for (std::uint32_t row = 0; row < grid.rows(); ++row) {
    const double* z = grid.row(row);
    for (std::uint32_t column = 0; column < grid.columns(); ++column) {
      heights.least = z[column] < heights.least ? z[column] : heights.least;
      heights.greatest = z[column] > heights.greatest ? z[column] : heights.greatest;
    }
  }
  return heights;
}

}  // namespace

ImagePlane::ImagePlane(const ViewshedTask& task, const AzimuthalMap* map, const std::vector<float>* steepness)
    : task_(task),
      map_(map),
      steepness_(steepness),
      steps_(map != nullptr ? map->steps : *task.earth.planeSteps()),
      unit_(task.model.georeference.verticalUnitMetres),
      h0_(task.observer.height) {
  const SightGrid& grid = task.grid;
  const Heights heights = heightsOf(grid);
  const double length =
      std::hypot(steps_.x.x, steps_.x.y) * grid.columns() + std::hypot(steps_.y.x, steps_.y.y) * grid.rows();
  const double range =
      std::max(heights.greatest + task.options.targetHeight, h0_) - std::min(heights.least, h0_);
  const double largest = std::max(std::fabs(heights.least), std::fabs(heights.greatest)) + range;
  // In the image, edges are at most as many times steeper than on the ground as samples lie before them.
  const double rounding = kRounding * (double(grid.columns()) + grid.rows()) * range + kRounding * largest;
  const double perUnit = map != nullptr ? unit_ : 1;  // heights in the image per unit of the DEM
  const double least = kTolerance / unit_ * perUnit,
               most = (kTolerance + kTolerancePerMetre * kLongestLine * length) / unit_ * perUnit;
  lift_ = std::max(0.0, rounding * perUnit - least / 2);
  slack_ = 2 * most + 2 * rounding * perUnit + lift_;
}

std::size_t ImagePlane::index(const ViewshedSector& s, int x, int y) const {
  const auto column = static_cast<std::size_t>(s.line(s.isAlongRows ? x : y)),
             row = static_cast<std::size_t>(s.line(s.isAlongRows ? y : x));
  return row * task_.grid.columns() + column;
}

ImagePlane::Curved ImagePlane::curved(double x, double y, double twiceDrop) const {
  const double east = x * steps_.x.x + y * steps_.y.x, north = x * steps_.x.y + y * steps_.y.y;
  const double square = east * east + north * north,
               // Close to the observer the quotient is all rounding; the clamp makes it harmless.
      k = std::clamp(square > 0 ? twiceDrop / square : 0, map_->leastCurvature, map_->mostCurvature);
  const double b = k * twiceDrop;  // (ks)^2
  const double scale =
      1 + b * (1.0 / 6 + b * (7.0 / 360 + b * (31.0 / 15120 + b * (127.0 / 604800 + b * (73.0 / 3421440)))));
  return {scale, scale * twiceDrop / 2 * (1 - b / 12 * (1 - b / 30)), k, std::sqrt(square)};
}

/// How much higher the terrain on the tracks may be than at the place computed. Three terms: the terrain
/// rises beside the track, relative to a line that may itself be steeper than the terrain; the drop of the
/// ground is uncertain, and is scaled along with the height; the curvature is.
double ImagePlane::uncertainty(double x, double y, const Curved& curved, double z, float steepness) const {
  const double steps = std::hypot(x, y), below = std::fabs(z - h0_) * unit_;
  const double fall = below / std::max(steps, 1.0), step = curved.distance / std::max(steps, 1e-9);
  const double rise = std::fabs(steepness) * unit_ + std::max(0.0, fall - step);
  return kRise * map_->planError(steps) * rise +
         map_->heightError(curved.distance) * (1 + map_->mostCurvature * below) +
         map_->curvatureError() * std::fabs(z * unit_) * below;
}

void ImagePlane::draw(const ViewshedSector& sector, int x, int low, int high, int shear,
                      ImageLine& line) const {
  const Vec2 o = observer(sector);
  line.x = x - o.x;
  line.from = low;
  line.count = std::max(0, high - low + 1);
  const auto count = static_cast<std::size_t>(line.count);
  for (auto* values : {&line.z, &line.u, &line.v}) values->resize(count);
  line.bin.resize(count);
  line.hasGaps = false;
  if (count == 0) return;
  const std::size_t first = index(sector, x, low);
  const std::ptrdiff_t stride =
      sector.sign * (sector.isAlongRows ? static_cast<std::ptrdiff_t>(task_.grid.columns()) : 1);
  const double* z = task_.grid.row(0) + first;
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double at = z[static_cast<std::ptrdiff_t>(i) * stride];
    line.z[i] = at;
    sum += at;
  }
  line.hasGaps = std::isnan(sum);
  if (map_ == nullptr) {
    const double h = h0_ - lift_, per = 1 / line.x, off = o.y - shear * o.x;
    const int s = low - shear * x;
    for (std::size_t i = 0; i < count; ++i) {
      line.u[i] = ((s + static_cast<int>(i)) - off) / line.x;
      line.v[i] = (line.z[i] - h) * per;
    }
    return;
  }
  for (auto* values : {&line.uncertainty, &line.mapX, &line.mapY, &line.twiceDrop, &line.away})
    values->resize(count);
  line.isBesideGap.resize(count);
  // The map is sampled along rising lattice numbers, which a sector may count backwards.
  const int start = sector.sign > 0 ? low : -high;
  map_->along(sector.isAlongRows, sector.line(x), start, line.count, line.mapX.data(), line.mapY.data(),
              line.twiceDrop.data());
  if (sector.sign < 0)
    for (auto* values : {&line.mapX, &line.mapY, &line.twiceDrop})
      std::reverse(values->begin(), values->end());
  // The sign bit of a steepness marks a sample with a missing neighbour.
  const float* steep = steepness_->data() + first;
  for (std::size_t i = 0; i < count; ++i) {
    const Curved b = curved(line.mapX[i], line.mapY[i], line.twiceDrop[i]);
    const double raised =
        uncertainty(line.mapX[i], line.mapY[i], b, line.z[i], steep[static_cast<std::ptrdiff_t>(i) * stride]);
    const Vec2 place = sector.turned({line.mapX[i], line.mapY[i]});
    line.uncertainty[i] = kUncertainties * raised;
    line.isBesideGap[i] = std::signbit(steep[static_cast<std::ptrdiff_t>(i) * stride]);
    line.away[i] = place.x;
    line.u[i] = place.y / place.x;
    line.v[i] = (elevated(b, line.z[i]) + raised + lift_) / place.x;
  }
}

ImagePlane::Sample ImagePlane::sample(const ViewshedSector& sector, int x, int y) const {
  const Vec2 o = observer(sector);
  const std::size_t at = index(sector, x, y);
  const double z = task_.grid.row(0)[at];
  // Without a map, coordinates on the plane are differences of sample numbers.
  if (map_ == nullptr) return {{x - o.x, y - o.y}, z + lift_ - h0_, 0, false};
  const int column = sector.line(sector.isAlongRows ? x : y), row = sector.line(sector.isAlongRows ? y : x);
  double mapX, mapY, twiceDrop;
  map_->along(sector.isAlongRows, sector.line(x), sector.isAlongRows ? row : column, 1, &mapX, &mapY,
              &twiceDrop);
  const Curved b = curved(mapX, mapY, twiceDrop);
  const float steep = (*steepness_)[at];
  const double raised = uncertainty(mapX, mapY, b, z, steep);
  return {sector.turned({mapX, mapY}), elevated(b, z) + raised + lift_, kUncertainties * raised,
          std::signbit(steep)};
}

double ImagePlane::direction(const ViewshedSector& sector, int x, int y, int shear) const {
  const Vec2 o = observer(sector);
  if (map_ == nullptr) return ((y - shear * x) - (o.y - shear * o.x)) / (x - o.x);
  double mapX, mapY, twiceDrop;
  map_->along(sector.isAlongRows, sector.line(x), sector.line(y), 1, &mapX, &mapY, &twiceDrop);
  const Vec2 p = sector.turned({mapX, mapY});
  return p.y / p.x;
}

double ImagePlane::target(const ImageLine& line, std::size_t i, double above) const {
  if (map_ == nullptr) return (line.z[i] + above - h0_) * (1 / line.x);
  const Curved b = curved(line.mapX[i], line.mapY[i], line.twiceDrop[i]);
  return elevated(b, line.z[i] + above) / line.away[i];
}

Vec2 ImagePlane::ground(const ViewshedSector& sector, const ImageLine& line, std::size_t i) const {
  // The steps turn either kind of coordinates into metres.
  double x, y;
  if (map_ != nullptr) {
    x = line.mapX[i];
    y = line.mapY[i];
  } else {
    const Vec2 o = observer(sector);
    const Vec2 p = sector.turned({line.x, line.from + static_cast<int>(i) - o.y});
    x = p.x;
    y = p.y;
  }
  return {x * steps_.x.x + y * steps_.y.x, x * steps_.x.y + y * steps_.y.y};
}

Vec2 ImagePlane::xStep(const ViewshedSector& s) const {
  const Vec2 step = s.isAlongRows ? steps_.x : steps_.y;
  return {s.sign * step.x, s.sign * step.y};
}

Vec2 ImagePlane::yStep(const ViewshedSector& s) const {
  const Vec2 step = s.isAlongRows ? steps_.y : steps_.x;
  return {s.sign * step.x, s.sign * step.y};
}

std::vector<float> viewshedSteepness(const SightGrid& grid, const RunContext& context) {
  const std::uint32_t columns = grid.columns(), rows = grid.rows();
  // Steepness of each cell, stored at its upper left sample: a triangle that rises by a along a row and b
  // along a column rises by at most hypot(a, b) in a step. NODATA differences are left out.
  std::vector<float> cells(std::size_t{columns} * rows, 0), steep(cells.size());
  withThreads(context, [&] {
    parallelFor(0u, rows - 1, [&](std::uint32_t row) {
      const double *upper = grid.row(row), *lower = grid.row(row + 1);
      float* out = cells.data() + std::size_t{row} * columns;
      for (std::uint32_t c = 0; c + 1 < columns; ++c) {
        const auto most = [](double a, double b) {  // of the differences that are no NaN
          a = std::fabs(a);
          b = std::fabs(b);
          return a > b || std::isnan(b) ? (std::isnan(a) ? 0 : a) : b;
        };
        const double x = most(upper[c + 1] - upper[c], lower[c + 1] - lower[c]),
                     y = most(lower[c] - upper[c], lower[c + 1] - upper[c + 1]);
        constexpr double kFloat = 1.0001;  // more than conversion to float takes away
        out[c] = static_cast<float>(kFloat * std::sqrt(x * x + y * y));
      }
    });
    // The maximum of 4 x 4 cells, whose upper left samples are -2 to +1 away: of four in a row, then in a
    // column.
    std::vector<float> across(cells.size());
    parallelFor(0u, rows, [&](std::uint32_t row) {
      const float* in = cells.data() + std::size_t{row} * columns;
      float* out = across.data() + std::size_t{row} * columns;
      for (std::uint32_t c = 0; c < columns; ++c) {
        float most = in[c];
        if (c > 0) most = std::max(most, in[c - 1]);
        if (c > 1) most = std::max(most, in[c - 2]);
        if (c + 1 < columns) most = std::max(most, in[c + 1]);
        out[c] = most;
      }
    });
    parallelFor(0u, rows, [&](std::uint32_t row) {
      float* out = steep.data() + std::size_t{row} * columns;
      const std::uint32_t first = row > 1 ? row - 2 : 0, last = std::min(row + 1, rows - 1);
      for (std::uint32_t r = first; r <= last; ++r) {
        const float* in = across.data() + std::size_t{r} * columns;
        for (std::uint32_t c = 0; c < columns; ++c) out[c] = std::max(out[c], in[c]);
      }
      if (row == 0 || row + 1 == rows) {
        for (std::uint32_t c = 0; c < columns; ++c) out[c] = -out[c];
        return;
      }
      const double *z0 = grid.row(row - 1), *z1 = grid.row(row), *z2 = grid.row(row + 1);
      out[0] = -out[0];
      out[columns - 1] = -out[columns - 1];
      for (std::uint32_t c = 1; c + 1 < columns; ++c)
        if (std::isnan(z0[c - 1] + z0[c] + z0[c + 1] + z1[c - 1] + z1[c] + z1[c + 1] + z2[c - 1] + z2[c] +
                       z2[c + 1]))
          out[c] = -out[c];
    });
  });
  return steep;
}

}  // namespace arete

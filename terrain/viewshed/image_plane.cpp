// SPDX-License-Identifier: GPL-3.0-or-later
//
// On an Earth of curvature k a height h at the distance s is seen from the height h0 under the tangent
//
//     T = [ (h - h0) / (1 + k h) - (1 - cos ks) / k ] / (sin(ks) / k)
//
// (sightTangent()), so over a plane at the same distance it would be T s high: with b = k s^2, what is in
// brackets has (1 - cos ks) / k = b/2 (1 - kb/12 + ...) and is scaled by ks / sin ks = 1 + kb/6 + ...
#include "terrain/viewshed/image_plane.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numbers>

#include "engine/parallel/with_threads.h"

namespace arete {
namespace {

/// What is drawn too high by a doubt may be lower by twice as much.
constexpr double kDoubts = 2.1;

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

ImagePlane::ImagePlane(const ViewshedTask& task, const AzimuthalMap* fan, const std::vector<float>* steepness)
    : task_(task),
      fan_(fan),
      steepness_(steepness),
      steps_(fan != nullptr ? fan->steps : *task.earth.planeSteps()),
      unit_(task.model.georeference.verticalUnitMetres),
      h0_(task.observer.height) {
  const SightGrid& grid = task.grid;
  const Heights heights = heightsOf(grid);
  const double length =
      std::hypot(steps_.x.x, steps_.x.y) * grid.columns() + std::hypot(steps_.y.x, steps_.y.y) * grid.rows();
  const double range =
      std::max(heights.greatest + task.options.targetHeight, h0_) - std::min(heights.least, h0_);
  const double largest = std::max(std::fabs(heights.least), std::fabs(heights.greatest)) + range;
  // A coordinate in the picture is rounded by a few parts in 2^53; the steepest edges there are as many
  // times steeper than on the ground as samples lie before them.
  const double rounding = 2e-15 * (double(grid.columns()) + grid.rows()) * range + 2e-15 * largest;
  const double perUnit = fan != nullptr ? unit_ : 1;  // of the picture's heights
  const double least = 1e-6 / unit_ * perUnit, most = (1e-6 + 1e-12 * 1.1 * length) / unit_ * perUnit;
  lift_ = std::max(0.0, rounding * perUnit - least / 2);
  slack_ = 2 * most + 2 * rounding * perUnit + lift_;
}

std::size_t ImagePlane::index(const ViewshedSector& s, int x, int y) const {
  const auto column = static_cast<std::size_t>(s.line(s.isAlongRows ? x : y)),
             row = static_cast<std::size_t>(s.line(s.isAlongRows ? y : x));
  return row * task_.grid.columns() + column;
}

ImagePlane::Bent ImagePlane::bent(double x, double y, double bend) const {
  const double east = x * steps_.x.x + y * steps_.y.x, north = x * steps_.x.y + y * steps_.y.y;
  const double square = east * east + north * north,
               // All but at the observer, the quotient is of rounding.
      k = std::clamp(square > 0 ? bend / square : 0, fan_->leastCurvature, fan_->mostCurvature);
  const double b = k * bend;  // (ks)^2
  const double scale =
      1 + b * (1.0 / 6 + b * (7.0 / 360 + b * (31.0 / 15120 + b * (127.0 / 604800 + b * (73.0 / 3421440)))));
  return {scale, scale * bend / 2 * (1 - b / 12 * (1 - b / 30)), k, std::sqrt(square)};
}

/// How much higher than drawn without it the terrain on the tracks may be. A line that is steeper than the
/// terrain is as much higher or lower beside it; and what the curvature does to the drop of the ground grows
/// with the height that is scaled along with it.
double ImagePlane::doubt(double x, double y, const Bent& bent, double z, float steepness) const {
  const double steps = std::hypot(x, y), below = std::fabs(z - h0_) * unit_;
  const double fall = below / std::max(steps, 1.0), step = bent.distance / std::max(steps, 1e-9);
  const double rise = std::fabs(steepness) * unit_ + std::max(0.0, fall - step);
  return 1.1 * fan_->planError(steps) * rise +
         fan_->heightError(bent.distance) * (1 + fan_->mostCurvature * below) +
         fan_->curvatureError() * std::fabs(z * unit_) * below;
}

void ImagePlane::take(const ViewshedSector& sector, int x, int low, int high, int shear,
                      PictureLine& line) const {
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
  if (fan_ == nullptr) {
    const double h = h0_ - lift_, per = 1 / line.x, off = o.y - shear * o.x;
    const int s = low - shear * x;
    for (std::size_t i = 0; i < count; ++i) {
      line.u[i] = ((s + static_cast<int>(i)) - off) / line.x;
      line.v[i] = (line.z[i] - h) * per;
    }
    return;
  }
  for (auto* values : {&line.doubt, &line.fanX, &line.fanY, &line.bend, &line.away}) values->resize(count);
  line.isBesideGap.resize(count);
  // The fan counts with the plan's numbers, the sector perhaps against them.
  const int start = sector.sign > 0 ? low : -high;
  fan_->along(sector.isAlongRows, sector.line(x), start, line.count, line.fanX.data(), line.fanY.data(),
              line.bend.data());
  if (sector.sign < 0)
    for (auto* values : {&line.fanX, &line.fanY, &line.bend}) std::reverse(values->begin(), values->end());
  const float* steep = steepness_->data() + first;
  for (std::size_t i = 0; i < count; ++i) {
    const Bent b = bent(line.fanX[i], line.fanY[i], line.bend[i]);
    const double raised =
        doubt(line.fanX[i], line.fanY[i], b, line.z[i], steep[static_cast<std::ptrdiff_t>(i) * stride]);
    const Vec2 place = sector.turned({line.fanX[i], line.fanY[i]});
    line.doubt[i] = kDoubts * raised;
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
  if (fan_ == nullptr) return {{x - o.x, y - o.y}, z + lift_ - h0_, 0, false};
  const int column = sector.line(sector.isAlongRows ? x : y), row = sector.line(sector.isAlongRows ? y : x);
  double fx, fy, bend;
  fan_->along(sector.isAlongRows, sector.line(x), sector.isAlongRows ? row : column, 1, &fx, &fy, &bend);
  const Bent b = bent(fx, fy, bend);
  const float steep = (*steepness_)[at];
  const double raised = doubt(fx, fy, b, z, steep);
  return {sector.turned({fx, fy}), elevated(b, z) + raised + lift_, kDoubts * raised, std::signbit(steep)};
}

double ImagePlane::direction(const ViewshedSector& sector, int x, int y, int shear) const {
  const Vec2 o = observer(sector);
  if (fan_ == nullptr) return ((y - shear * x) - (o.y - shear * o.x)) / (x - o.x);
  double fx, fy, bend;
  fan_->along(sector.isAlongRows, sector.line(x), sector.line(y), 1, &fx, &fy, &bend);
  const Vec2 p = sector.turned({fx, fy});
  return p.y / p.x;
}

double ImagePlane::target(const PictureLine& line, std::size_t i, double above) const {
  if (fan_ == nullptr) return (line.z[i] + above - h0_) * (1 / line.x);
  const Bent b = bent(line.fanX[i], line.fanY[i], line.bend[i]);
  return elevated(b, line.z[i] + above) / line.away[i];
}

Vec2 ImagePlane::ground(const ViewshedSector& sector, const PictureLine& line, std::size_t i) const {
  double x, y;
  if (fan_ != nullptr) {
    x = line.fanX[i];
    y = line.fanY[i];
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
  // Of each cell, by its upper left sample: a surface that rises by a along a row and b along a column rises
  // by hypot(a, b) in a step, in either triangle.
  std::vector<float> cells(std::size_t{columns} * rows, 0), steep(cells.size());
  withThreads(context, [&] {
    tbb::parallel_for(0u, rows - 1, [&](std::uint32_t row) {
      const double *upper = grid.row(row), *lower = grid.row(row + 1);
      float* out = cells.data() + std::size_t{row} * columns;
      for (std::uint32_t c = 0; c + 1 < columns; ++c) {
        const auto most = [](double a, double b) {  // of differences that are there
          a = std::fabs(a);
          b = std::fabs(b);
          return a > b || std::isnan(b) ? (std::isnan(a) ? 0 : a) : b;
        };
        const double x = most(upper[c + 1] - upper[c], lower[c + 1] - lower[c]),
                     y = most(lower[c] - upper[c], lower[c + 1] - upper[c + 1]);
        out[c] = static_cast<float>(1.0001 * std::sqrt(x * x + y * y));
      }
    });
    // The most of four cells in a row, then in a column: those with upper left samples from -2 to +1.
    std::vector<float> across(cells.size());
    tbb::parallel_for(0u, rows, [&](std::uint32_t row) {
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
    tbb::parallel_for(0u, rows, [&](std::uint32_t row) {
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

// SPDX-License-Identifier: GPL-3.0-or-later
//
// The middles of a cell's edges become points in space on the ellipsoid, where neither a pole nor the seam of
// longitudes is special; the cross product of the two vectors between them is the area.
#include "io/geo/polygons/ground_areas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "engine/base/vec.h"
#include "io/geo/crs/lonlat.h"

namespace arete {
namespace {

constexpr std::uint32_t kMostGridLines = 256;

/// Evenly spaced cells of an axis, its first and last among them.
std::vector<std::uint32_t> gridLines(std::uint32_t cells) {
  const std::uint32_t count = std::min(cells, kMostGridLines);
  std::vector<std::uint32_t> lines;
  for (std::uint32_t i = 0; i < count; ++i)
    lines.push_back(count == 1 ? 0 : std::uint32_t(std::uint64_t(i) * (cells - 1) / (count - 1)));
  return lines;
}

struct Ellipsoid {
  double semiMajorAxis, flattening;

  Vec3 at(Vec2 lonLat) const {
    const double turn = std::numbers::pi / 180, e2 = flattening * (2 - flattening);
    const double sine = std::sin(lonLat.y * turn), cosine = std::cos(lonLat.y * turn);
    const double n = semiMajorAxis / std::sqrt(1 - e2 * sine * sine);
    return {n * cosine * std::cos(lonLat.x * turn), n * cosine * std::sin(lonLat.x * turn),
            n * (1 - e2) * sine};
  }
};

double crossLength(const Vec3& a, const Vec3& b) {
  return std::hypot(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

}  // namespace

std::optional<GroundAreas> GroundAreas::of(const Georeference& georeference, std::uint32_t columns,
                                           std::uint32_t rows) {
  if (georeference.crsWkt.empty() || !georeference.hasGeoTransform || columns == 0 || rows == 0) return {};
  const auto lonLat = CrsLonLat::of(georeference);
  if (!lonLat) return {};
  const Ellipsoid ellipsoid{georeference.semiMajorAxisMetres,
                            georeference.inverseFlattening == 0 ? 0 : 1 / georeference.inverseFlattening};
  GroundAreas areas;
  areas.columns_ = columns;
  areas.atColumns_ = gridLines(columns);
  areas.atRows_ = gridLines(rows);
  std::vector<Vec2> middles;
  for (const std::uint32_t row : areas.atRows_)
    for (const std::uint32_t column : areas.atColumns_)
      for (const auto& [x, y] : {std::array{-0.5, 0.0}, {0.5, 0.0}, {0.0, -0.5}, {0.0, 0.5}})
        middles.push_back(georeference.toSource(column + x, row + y));
  lonLat->toLonLat(middles);
  for (std::size_t i = 0; i < middles.size(); i += 4) {
    std::array<Vec3, 4> at;
    for (std::size_t k = 0; k < 4; ++k) {
      // Half a cell beyond a pole, as rasters of the whole Earth with samples on it have, is the pole.
      Vec2& p = middles[i + k];
      if (georeference.isGeographic) p.y = std::clamp(p.y, -90.0, 90.0);
      at[k] = ellipsoid.at(p);
    }
    areas.areas_.push_back(crossLength(at[1] - at[0], at[3] - at[2]));
  }
  return areas;
}

// Between grid lines the area changes linearly along each axis.
void GroundAreas::sumRow(std::uint32_t row) {
  const auto below = [](const std::vector<std::uint32_t>& lines, std::uint32_t cell) {
    const auto next = std::ranges::upper_bound(lines, cell);
    return std::size_t(std::max<std::ptrdiff_t>(
        0, std::min<std::ptrdiff_t>(next - lines.begin() - 1, std::ptrdiff_t(lines.size()) - 2)));
  };
  const auto share = [](const std::vector<std::uint32_t>& lines, std::size_t line, std::uint32_t cell) {
    return lines.size() == 1 ? 0.0 : double(cell - lines[line]) / double(lines[line + 1] - lines[line]);
  };
  const std::size_t upper = below(atRows_, row), width = atColumns_.size();
  const double down = share(atRows_, upper, row);
  const auto between = [](double a, double b, double t) { return t == 0 ? a : t == 1 ? b : a + t * (b - a); };
  const auto onRow = [&](std::size_t line) {
    const double above = areas_[upper * width + line];
    return atRows_.size() == 1 ? above : between(above, areas_[(upper + 1) * width + line], down);
  };
  row_ = row;
  sums_.assign(1, 0);
  sums_.reserve(columns_ + 1);
  lost_.assign(1, 0);
  std::size_t line = 0;
  for (std::uint32_t column = 0; column < columns_; ++column) {
    while (line + 2 < width && atColumns_[line + 1] <= column) ++line;
    const double area =
        width == 1 ? onRow(0) : between(onRow(line), onRow(line + 1), share(atColumns_, line, column));
    const bool isLost = !std::isfinite(area);
    sums_.push_back(sums_.back() + (isLost ? 0 : area));
    lost_.push_back(lost_.back() + isLost);
  }
}

double GroundAreas::ofRun(std::uint32_t row, std::uint32_t begin, std::uint32_t end) {
  if (sums_.empty() || row_ != row) sumRow(row);
  if (lost_[end] != lost_[begin]) return std::nan("");
  return sums_[end] - sums_[begin];
}

}  // namespace arete

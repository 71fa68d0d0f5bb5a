// SPDX-License-Identifier: GPL-3.0-or-later
// For a dam at a river cell, the lake of level z is the part of the cell's catchment below z; every such cell
// drains to the dam through others below z, so the lake is connected. The level that gives the wanted area is
// an order statistic of the catchment's heights. Of the river cells with a fitting catchment, take the one
// that needs the lowest dam. The moraine is land raised to just above the level around the lake, falling off
// outwards.
#include "datasets/lake.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "datasets/flow_routing.h"
#include "datasets/random.h"

namespace arete {
namespace {

/// The catchment of a cell, itself first. Walks against the receivers.
std::vector<std::uint32_t> catchmentOf(std::uint32_t outlet, const DrainageNetwork& network,
                                       std::uint32_t columns) {
  std::vector<std::uint32_t> cells = {outlet};
  cells.reserve(network.upstreamCells[outlet]);
  const auto n = static_cast<std::int64_t>(network.receiver.size());
  const std::int64_t w = columns;
  // The list grows while it is walked through: it is the queue too. A neighbour across the left or right
  // border belongs to another row, and flows to cells next to it, so it is never taken.
  for (std::size_t i = 0; i < cells.size(); ++i)
    for (const std::int64_t offset :
         {-w - 1, -w, -w + 1, std::int64_t(-1), std::int64_t(1), w - 1, w, w + 1}) {
      const std::int64_t neighbour = std::int64_t(cells[i]) + offset;
      if (neighbour < 0 || neighbour >= n || neighbour == outlet) continue;
      if (network.receiver[std::size_t(neighbour)] == cells[i])
        cells.push_back(static_cast<std::uint32_t>(neighbour));
    }
  return cells;
}

struct Lake {
  std::uint32_t dam = 0;
  double level = std::numeric_limits<double>::infinity();
  double depth = std::numeric_limits<double>::infinity();
  std::vector<std::uint32_t> cells;
};

// The cells below the level are those before the order statistic; heights can be equal, so cells are compared
// by their numbers too.
Lake lakeBehind(std::uint32_t dam, std::size_t area, const ReliefGrid& grid, const DrainageNetwork& network) {
  Lake lake;
  lake.dam = dam;
  std::vector<std::uint32_t> cells = catchmentOf(dam, network, grid.columns);
  const auto lower = [&](std::uint32_t a, std::uint32_t b) {
    return grid.heights[a] < grid.heights[b] || (grid.heights[a] == grid.heights[b] && a < b);
  };
  const auto middle = cells.begin() + std::ptrdiff_t(std::min(area, cells.size() - 1));
  std::nth_element(cells.begin(), middle, cells.end(), lower);
  lake.level = grid.heights[*middle];
  lake.depth = lake.level - grid.heights[dam];
  cells.erase(middle, cells.end());
  lake.cells = std::move(cells);
  return lake;
}

/// A lake at the border could run out of the terrain, and the moraine needs room.
bool touchesEdge(const Lake& lake, const ReliefGrid& grid) {
  return std::any_of(lake.cells.begin(), lake.cells.end(), [&](std::uint32_t cell) {
    const std::uint32_t column = cell % grid.columns, row = cell / grid.columns;
    return column < 2 || row < 2 || column + 2 >= grid.columns || row + 2 >= grid.rows;
  });
}

// The moraine falls off from the shore at a fixed slope, so how far it reaches follows from its height.
// Heights are multiples of 1/64 m, as in the rest of the terrain.
void raiseMoraine(RasterHeightfield& field, const Lake& lake, double pixelMetres) {
  constexpr double kFreeboard = 4, kOuterSlope = 0.25;
  const auto reach = std::min<std::int64_t>(
      40, static_cast<std::int64_t>((lake.depth + kFreeboard) / (kOuterSlope * pixelMetres)) + 1);
  std::vector<std::uint8_t> isLake(field.size(), 0);
  for (const std::uint32_t cell : lake.cells) isLake[cell] = 1;
  for (const std::uint32_t cell : lake.cells) {
    const std::int64_t column = cell % field.columns, row = cell / field.columns;
    bool shore = false;
    for (const auto& [x, y] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
      shore = shore || !isLake[std::size_t((row + y) * field.columns + column + x)];
    if (!shore) continue;
    for (std::int64_t y = std::max<std::int64_t>(0, row - reach);
         y <= std::min<std::int64_t>(field.rows - 1, row + reach); ++y)
      for (std::int64_t x = std::max<std::int64_t>(0, column - reach);
           x <= std::min<std::int64_t>(field.columns - 1, column + reach); ++x) {
        double& z = field.heights[std::size_t(y * field.columns + x)];
        const double away = std::sqrt(double((x - column) * (x - column) + (y - row) * (y - row)));
        const double crest = lake.level + kFreeboard - kOuterSlope * pixelMetres * (away - 1);
        if (z > 0 && z < crest) z = std::floor(crest * 64) / 64;
      }
  }
}

}  // namespace

void floodLake(RasterHeightfield& field, double pixelMetres) {
  constexpr double kNoData = std::numeric_limits<double>::quiet_NaN();
  ReliefGrid grid{field.columns, field.rows, pixelMetres, field.heights, {}, {}};
  grid.isOutlet.assign(field.size(), 0);
  for (std::uint32_t row = 0; row < field.rows; ++row)
    for (std::uint32_t column = 0; column < field.columns; ++column) {
      const bool edge = column == 0 || row == 0 || column + 1 == field.columns || row + 1 == field.rows;
      grid.isOutlet[field.index(column, row)] = edge || field.at(column, row) <= 0;
    }
  DrainageNetwork network;
  removeDepressions(grid, Depressions::fill, 1e-4, 1, network);
  routeFlow(grid, network);

  const std::size_t area = std::max<std::size_t>(4, field.size() / 200);
  Lake best;
  std::size_t tried = 0;
  // Rivers that just reach a fitting catchment: their dams lie apart, so a few hundred trials see the whole
  // map.
  for (std::uint32_t cell = 0; cell < field.size() && tried < 300; ++cell) {
    const std::size_t catchment = network.upstreamCells[cell];
    if (grid.isOutlet[cell] || catchment < 6 * area || catchment > 9 * area) continue;
    if (Random::at(7, cell, 0) % (field.size() / 20000 + 1) != 0) continue;
    ++tried;
    Lake lake = lakeBehind(cell, area, grid, network);
    if (lake.depth < best.depth && !touchesEdge(lake, grid)) best = std::move(lake);
  }
  if (best.cells.empty()) {
    // A map too small or too flat for a valley: a pond in the middle.
    const std::uint32_t column = field.columns / 2, row = field.rows / 2;
    for (std::uint32_t y = row - 1; y <= row + 1; ++y)
      for (std::uint32_t x = column - 1; x <= column + 1; ++x) field.heights[field.index(x, y)] = kNoData;
    return;
  }
  raiseMoraine(field, best, pixelMetres);
  for (const std::uint32_t cell : best.cells) field.heights[cell] = kNoData;
}

}  // namespace arete

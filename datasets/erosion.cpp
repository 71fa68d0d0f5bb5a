// SPDX-License-Identifier: GPL-3.0-or-later
// Uplift and incision: walking upstream, a cell's receiver already has its new height, so the implicit
// equation
//     h' = h + U dt - K dt sqrt(A) (h' - h'_receiver) / d
// has one unknown. Hillsides are then diffused explicitly, while river beds stay: a river carries away what
// slides into it, and so no slide can dam it.
#include "datasets/erosion.h"

#include <algorithm>
#include <cmath>

#include "engine/parallel/parallel_loops.h"

namespace arete {
namespace {

constexpr double kStable = 0.22;  ///< cells squared a pass; explicit diffusion is stable up to a quarter
constexpr int kMostPasses = 12;   ///< grids of metre-sized cells get steeper hillsides rather than wait

void incise(ReliefGrid& grid, const std::vector<float>& uplift, const std::vector<float>& erodibility,
            const ErosionStep& step, const DrainageNetwork& network) {
  for (auto it = network.downstream.rbegin(); it != network.downstream.rend(); ++it) {
    const std::uint32_t cell = *it, receiver = network.receiver[cell];
    if (grid.isOutlet[cell]) continue;
    double& height = grid.heights[cell];
    height += uplift[cell];
    if (receiver == cell) continue;
    const int dx = static_cast<int>(receiver % grid.columns) - static_cast<int>(cell % grid.columns);
    const int dy = static_cast<int>(receiver / grid.columns) - static_cast<int>(cell / grid.columns);
    const double area = network.areaSquareMetres(cell, grid.cellMetres) + step.seepageSquareMetres;
    const double factor =
        step.incision * erodibility[cell] * std::sqrt(area) / grid.distanceMetres(cell, receiver, dx, dy);
    height = (height + factor * grid.heights[receiver]) / (1 + factor);
  }
}

void diffuseHillsides(ReliefGrid& grid, const ErosionStep& step, const DrainageNetwork& network) {
  const double cellArea = grid.cellMetres * grid.cellMetres;
  const auto channelCells = static_cast<std::uint32_t>(step.channelSquareMetres / cellArea) + 4;
  const double wanted = step.diffusionSquareMetres / cellArea;
  const int passes = static_cast<int>(std::min<double>(kMostPasses, std::ceil(wanted / kStable)));
  const double share = std::min(wanted / passes, kStable);
  const std::size_t columns = grid.columns;
  std::vector<double> before;
  for (int pass = 0; pass < passes; ++pass) {
    before = grid.heights;
    parallelFor(IndexRange<std::size_t>(1, grid.rows - 1, 16), [&](const auto& range) {
      for (std::size_t row = range.begin(); row < range.end(); ++row)
        for (std::size_t cell = row * columns + 1; cell < (row + 1) * columns - 1; ++cell) {
          if (grid.isOutlet[cell] || network.upstreamCells[cell] >= channelCells) continue;
          const double neighbours =
              before[cell - 1] + before[cell + 1] + before[cell - columns] + before[cell + columns];
          grid.heights[cell] = before[cell] + share * (neighbours - 4 * before[cell]);
        }
    });
  }
}

}  // namespace

void erode(ReliefGrid& grid, const std::vector<float>& upliftMetres, const std::vector<float>& erodibility,
           const ErosionStep& step, DrainageNetwork& network) {
  routeFlow(grid, network);
  incise(grid, upliftMetres, erodibility, step, network);
  diffuseHillsides(grid, step, network);
}

}  // namespace arete

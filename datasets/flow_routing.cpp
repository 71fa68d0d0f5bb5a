// SPDX-License-Identifier: GPL-3.0-or-later
// Receivers are found cell by cell. The order follows each chain of cells from its springs: a cell is written
// once the last of the cells that drain to it has been, so the array runs downstream, neighbours in it are
// mostly neighbours on the ground, and a count of open donors per cell is all the memory it takes.
#include "datasets/flow_routing.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>

#include "datasets/random.h"
#include "engine/parallel/parallel_loops.h"

namespace arete {
namespace {

constexpr std::array<std::array<int, 2>, 8> kNeighbours = {
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}}};

/// visit(neighbour, dx, dy) for the neighbours inside the grid.
template <class Visit>
void forEachNeighbour(const ReliefGrid& grid, std::uint32_t cell, Visit visit) {
  const auto column = static_cast<std::int64_t>(cell % grid.columns);
  const auto row = static_cast<std::int64_t>(cell / grid.columns);
  for (const auto& [dx, dy] : kNeighbours) {
    const std::int64_t x = column + dx, y = row + dy;
    if (x < 0 || y < 0 || x >= grid.columns || y >= grid.rows) continue;
    visit(static_cast<std::uint32_t>(y * grid.columns + x), dx, dy);
  }
}

std::uint32_t steepestDescent(const ReliefGrid& grid, std::uint32_t cell) {
  std::uint32_t best = cell;
  double steepest = 0;
  forEachNeighbour(grid, cell, [&](std::uint32_t neighbour, int dx, int dy) {
    const double drop = grid.heights[cell] - grid.heights[neighbour];
    if (drop <= 0) return;
    const double slope = drop / grid.distanceMetres(cell, neighbour, dx, dy);
    if (slope > steepest) {
      steepest = slope;
      best = neighbour;
    }
  });
  return best;
}

}  // namespace

void ReliefGrid::scatterCells(double reach, std::uint64_t seed) {
  scatter.resize(size());
  for (std::size_t cell = 0; cell < size(); ++cell) {
    const std::uint64_t hash = Random::at(seed, static_cast<std::int64_t>(cell), 0);
    const auto offset = [&](std::uint64_t bits) {
      return static_cast<std::int8_t>((Random::toUnit(bits) * 2 - 1) * reach * 256);
    };
    scatter[cell] = {offset(hash), offset(Random::mix(hash))};
  }
}

double ReliefGrid::distanceMetres(std::uint32_t a, std::uint32_t b, int dx, int dy) const {
  double x = dx, y = dy;
  if (!scatter.empty()) {
    x += (scatter[b][0] - scatter[a][0]) / 256.0;
    y += (scatter[b][1] - scatter[a][1]) / 256.0;
  }
  return cellMetres * std::sqrt(x * x + y * y);
}

void removeDepressions(ReliefGrid& grid, Depressions how, double stepMetres, std::uint64_t seed,
                       DrainageNetwork& scratch) {
  struct Entry {
    double height;
    std::uint32_t cell;
    // Equal heights by index, so that the order is the same with every standard library.
    bool operator>(const Entry& other) const {
      return height > other.height || (height == other.height && cell > other.cell);
    }
  };
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  constexpr std::uint32_t kUnseen = 0xFFFFFFFFu;
  std::vector<std::uint32_t>& order = scratch.downstream;
  std::vector<std::uint32_t>& floodedFrom = scratch.receiver;
  order.clear();
  floodedFrom.assign(grid.size(), kUnseen);
  for (std::uint32_t cell = 0; cell < grid.size(); ++cell)
    if (grid.isOutlet[cell]) {
      floodedFrom[cell] = cell;
      bool rim = false;  // outlets inside a sea need no visit
      forEachNeighbour(grid, cell, [&](std::uint32_t n, int, int) { rim = rim || !grid.isOutlet[n]; });
      if (rim) open.push({grid.heights[cell], cell});
    }
  const auto stepOf = [&](std::uint32_t cell) {
    return stepMetres * (0.1 + Random::toUnit(Random::at(seed, cell, 0)));
  };
  while (!open.empty()) {
    const auto [level, cell] = open.top();
    open.pop();
    if (!grid.isOutlet[cell]) order.push_back(cell);
    forEachNeighbour(grid, cell, [&, height = level, from = cell](std::uint32_t n, int, int) {
      if (floodedFrom[n] != kUnseen) return;
      floodedFrom[n] = from;
      open.push({std::max(grid.heights[n], height + stepOf(n)), n});
    });
  }

  if (how == Depressions::carve)
    for (auto it = order.rbegin(); it != order.rend(); ++it) {
      const std::uint32_t below = floodedFrom[*it];
      if (!grid.isOutlet[below])
        grid.heights[below] = std::min(grid.heights[below], grid.heights[*it] - stepOf(*it));
    }
  for (const std::uint32_t cell : order)
    grid.heights[cell] = std::max(grid.heights[cell], grid.heights[floodedFrom[cell]] + stepOf(cell));
}

void routeFlow(const ReliefGrid& grid, DrainageNetwork& network) {
  const auto cells = static_cast<std::uint32_t>(grid.size());
  network.receiver.resize(cells);
  parallelFor(IndexRange<std::uint32_t>(0, cells, 1 << 14), [&](const auto& range) {
    for (std::uint32_t cell = range.begin(); cell < range.end(); ++cell)
      network.receiver[cell] = grid.isOutlet[cell] ? cell : steepestDescent(grid, cell);
  });

  std::vector<std::uint8_t> openDonors(cells, 0);
  for (std::uint32_t cell = 0; cell < cells; ++cell)
    if (network.receiver[cell] != cell) ++openDonors[network.receiver[cell]];
  network.upstreamCells.assign(cells, 1);
  network.downstream.clear();
  network.downstream.reserve(cells);
  constexpr std::uint8_t kWritten = 0xFF;
  for (std::uint32_t spring = 0; spring < cells; ++spring)
    for (std::uint32_t cell = spring; openDonors[cell] == 0;) {
      openDonors[cell] = kWritten;
      network.downstream.push_back(cell);
      const std::uint32_t receiver = network.receiver[cell];
      if (receiver == cell) break;
      network.upstreamCells[receiver] += network.upstreamCells[cell];
      --openDonors[receiver];
      cell = receiver;
    }
}

}  // namespace arete

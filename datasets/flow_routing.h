// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace arete {

/// Heights on a square-celled grid while they are being shaped. Plain data.
struct ReliefGrid {
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  double cellMetres = 1;
  std::vector<double> heights;         ///< metres, row-major
  std::vector<std::uint8_t> isOutlet;  ///< 1: a fixed height that water leaves at (sea, edge of the model)
  /// Where in its cell a height stands, in 256ths of a cell from the centre: x, y. Empty: at the centre.
  /// Scattered cells have neighbours in all directions, not in eight, and so have the valleys.
  std::vector<std::array<std::int8_t, 2>> scatter;

  std::size_t size() const { return heights.size(); }

  /// Fills `scatter` with offsets up to `reach` of a cell. Precondition: 0 <= reach < 0.5.
  void scatterCells(double reach, std::uint64_t seed);

  /// Metres from cell a to its neighbour b, which stands (dx, dy) cells away.
  double distanceMetres(std::uint32_t a, std::uint32_t b, int dx, int dy) const;
};

/// Where the water of each cell goes.
struct DrainageNetwork {
  std::vector<std::uint32_t> receiver;    ///< the neighbour a cell drains to; itself where it drains nowhere
  std::vector<std::uint32_t> downstream;  ///< every cell once, each after all the cells that drain to it
  std::vector<std::uint32_t> upstreamCells;  ///< cells that drain through a cell, itself included

  double areaSquareMetres(std::size_t cell, double cellMetres) const {
    return upstreamCells[cell] * cellMetres * cellMetres;
  }
};

/// What to do with a place that water cannot leave.
enum class Depressions {
  fill,   ///< raise it to its spill height
  carve,  ///< cut its sill down to it, as far as the outlet's height allows
};

/// Gives every cell a way down to an outlet, falling by about `stepMetres` a cell, random so that rivers
/// wander over what was flat. Priority-flood (Barnes, Lehman, Mulla 2014, "Priority-flood: An optimal
/// depression-filling and watershed-labeling algorithm"); carving as Lindsay 2016, "Efficient hybrid
/// breaching-filling sink removal". Overwrites `scratch`. Precondition: at least one outlet. O(n log n) in
/// the cells.
void removeDepressions(ReliefGrid& grid, Depressions how, double stepMetres, std::uint64_t seed,
                       DrainageNetwork& scratch);

/// Steepest descent to one of eight neighbours, then the order of [BraunWillett2013] and the upstream
/// counts. Reuses the memory of `network`. O(n); the result does not depend on threads.
void routeFlow(const ReliefGrid& grid, DrainageNetwork& network);

}  // namespace arete

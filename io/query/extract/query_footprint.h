// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "engine/base/vec.h"
#include "io/store/format/required_error.h"
#include "terrain/model/terrain_model.h"
#include "terrain/sight/earth.h"
#include "terrain/sight/line.h"

namespace arete {

/// The places, lines and discs that queries will read, so that only this part of a file is read. They are
/// kept as marked cells of a grid over the terrain, in constant memory. The marked cells cover at least what
/// the queries read; of a raster also everything within one sample's width, for algorithms that read all four
/// samples of a cell.
class QueryFootprint {
 public:
  /// @param outline  a part of the model, its root at least. O(planBox()).
  explicit QueryFootprint(const TerrainModel& outline);

  /// Adds a place in plan coordinates. Places outside the terrain are moved to its rim; those that are not
  /// finite are ignored.
  void add(Vec2 plan);
  /// Adds the straight line between two places. O(cells that it crosses).
  void addLine(Vec2 from, Vec2 to);

  /// Adds the ground track of a sight line.
  void addTrack(const SightTrack& track);
  /// Adds everything within a distance of a place along the ground, and cells for which this is uncertain.
  /// O(unmarked cells on its rim) distances.
  void addDisc(const SightEarth& earth, Vec2 centre, double metres);

  /// Adds the rectangle about everything added so far, wider on each side by `margin` of its longer side.
  /// O(cells).
  void addRectangle(double margin);

  /// Requires this error of boxes that meet a marked cell, nothing of others. O(cells); O(1) for a call of
  /// the result, by a summed-area table [Crow1984].
  RequiredError within(double error) const;

 private:
  static constexpr int kCells = 512;  // along each axis

  struct Disc {
    const SightEarth& earth;
    Vec2 centre;
    double metres;
  };
  /// Adds the part of a disc in a square of cells.
  void addPart(const Disc& disc, int column, int row, int size);
  /// The cells that a box meets, and their neighbours.
  struct Cells {
    int left, right, bottom, top;  // all of them included
  };
  Cells cellsAround(Vec2 low, Vec2 high) const;
  bool areMarked(const Cells& cells) const;
  void mark(const Cells& cells);
  static int cellOf(double cells);
  int columnOf(double x) const;
  int rowOf(double y) const;

  Box2 domain_;
  double reach_;
  double columnsPerUnit_ = 0, rowsPerUnit_ = 0;
  std::vector<std::uint8_t> isMarked_;  // row by row
};

}  // namespace arete

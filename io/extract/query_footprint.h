// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "engine/base/vec.h"
#include "io/format/required_error.h"
#include "terrain/model/terrain_model.h"
#include "terrain/sight/earth.h"
#include "terrain/sight/line.h"

namespace arete {

/// Nothing is wanted anywhere: what is read is the root, which tells how far the terrain reaches.
inline RequiredError requiredNowhere() {
  return [](const Box2&) { return std::numeric_limits<double>::infinity(); };
}

/// Places, lines and discs that questions will be about, so that of a file no more is read than these need.
/// They are kept as cells of a grid over the terrain, any number of them in little memory; what is wanted of
/// them is at least what they need. Of a raster that is all that is within a sample's width, for who walks
/// over cells and asks for all four samples of each.
class QueryFootprint {
 public:
  /// The model: of its root alone, or any other part. O(planBox()).
  explicit QueryFootprint(const TerrainModel& outline);

  /// In plan coordinates; what is beside the terrain is put on its rim, what is not finite is passed over.
  void add(Vec2 plan);
  /// All of the straight line between two places. O(cells that it crosses).
  void addLine(Vec2 from, Vec2 to);

  void addTrack(const SightTrack& track);
  /// Everything within so many metres of a place along the ground, and some that is in doubt.
  /// O(cells on its rim that are not wanted yet) distances.
  void addDisc(const SightEarth& earth, Vec2 centre, double metres);

  /// This error of triangles that may touch one of the places, nothing of others.
  RequiredError within(double error) const;

 private:
  static constexpr int kCells = 512;  // along each axis

  struct Disc {
    const SightEarth& earth;
    Vec2 centre;
    double metres;
  };
  /// The part of a disc that is in a square of cells.
  void addPart(const Disc& disc, int column, int row, int size);
  /// Those that a box touches, and those beside them.
  struct Cells {
    int left, right, bottom, top;  // all of them included
  };
  Cells cellsAround(Vec2 low, Vec2 high) const;
  bool areWanted(const Cells& cells) const;
  void mark(const Cells& cells);
  int columnOf(double x) const;
  int rowOf(double y) const;

  Box2 domain_;
  double reach_;
  double columnsPerUnit_ = 0, rowsPerUnit_ = 0;
  std::vector<std::uint8_t> isWanted_;  // row by row
};

}  // namespace arete

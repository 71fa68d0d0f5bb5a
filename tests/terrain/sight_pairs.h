// SPDX-License-Identifier: GPL-3.0-or-later
//
// Pairs of places that are hard on an engine of sight lines, and the comparison of its answers with the
// oracle's.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "datasets/random.h"
#include "terrain/sight/engine.h"
#include "terrain/sight_oracle.h"

namespace arete::test {

/// What the pairs are made over.
struct SightTerrain {
  const SightOracle* oracle = nullptr;
  Box2 box;                                ///< in plan
  std::vector<Vec2> vertices, holes;       ///< of the triangulation; NODATA samples
  std::vector<std::array<Vec2, 2>> edges;  ///< some; of a raster none: its lines are known
  bool isRaster = true;
  double step = 1;                 ///< between samples, in plan
  double lowest = 0, highest = 0;  ///< heights, in the DEM's unit
};
SightTerrain terrainOf(const RasterHeightfield& raster, const SightOracle& oracle);
SightTerrain terrainOf(const MultiTriangulation& mt, const Cut& front, const SightOracle& oracle);

/// How the ground is measured and how it curves.
struct SightGround {
  double metresPerStep = 30, curvature = 0, unitMetres = 1;
  double scale = 1;  ///< of heights above the ground
};

struct SightPair {
  SightTrack track;
  double from = 0, to = 0;
  double unit = 1;
  double step = 1;  ///< between samples, in plan; what is rounding goes by it
  std::string kind;
  /// It runs along lattice lines or diagonals with coordinates that are exact: nothing hangs on rounding.
  bool isExact = false;
};
std::string describe(const SightPair& pair);
SightPair reversed(const SightPair& pair);
SightLine lineOf(const SightPair& pair);

/// Makes pairs, one after the other: places of all kinds, then heights that let the line pass near the
/// terrain for every second one or so.
class SightPairs {
 public:
  SightPairs(const SightTerrain& terrain, const SightGround& ground, std::uint64_t seed)
      : terrain_(terrain), ground_(ground), random_(seed) {}

  SightPair next();
  /// Of the pair made last.
  const OracleAnswer& answer() const { return answer_; }

  /// For tracks made elsewhere: chooses heights over this one.
  void setHeights(SightPair& pair);
  /// Two places, by the kinds that these pairs come in.
  std::array<Vec2, 2> ends(std::string& kind, bool& isExact);

 private:
  /// Digits of the least distance from a line that a place is put at. Coordinates of points are rounded far
  /// more than those of samples.
  double finest() const { return terrain_.isRaster ? 16 : 5; }
  Vec2 anywhere();
  Vec2 place();
  std::array<Vec2, 2> anyEnds(std::string& kind, bool& isExact);
  void bend(SightPair& pair);
  OracleAnswer ask(const SightPair& pair) const;
  template <class T>
  const T& oneOf(const std::vector<T>& all) {
    return all[random_.below(static_cast<std::uint32_t>(all.size()))];
  }

  const SightTerrain& terrain_;
  SightGround ground_;
  Random random_;
  OracleAnswer answer_;
};

/// Empty, or what is wrong with the answer.
std::string wrong(const SightOracle& oracle, const SightPair& pair, const SightOptions& options,
                  const SightAnswer& answer, const OracleAnswer& truth);
/// Whether an answer is right for the track itself; for another one a few 1e-9 of a step away, or where
/// terrain that is met in a single place counts differently; for something between those.
enum class Rounding { none, another, between };
/// The same, forgiving what is right but for rounding.
std::string wrongBeyondRounding(const SightOracle& oracle, const SightPair& pair, const SightOptions& options,
                                const SightAnswer& answer, const OracleAnswer& truth, Rounding& rounding);

}  // namespace arete::test

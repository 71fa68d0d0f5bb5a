// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "engine/base/vec.h"

namespace arete {

/// What a landscape is made from before any water flows: where the sea is, how fast the rock rises and how
/// soft it is, as functions of the plan position (metres from the centre of the map). Pure and thread-safe.
class Landscape {
 public:
  /// `extentMetres`: the longer side of the map.
  Landscape(std::uint64_t seed, double extentMetres, bool sea);

  struct Place {
    double inland;       ///< 0 at the coast, negative at sea, in extents
    double uplift;       ///< 0 .. 1, relative
    double erodibility;  ///< about 0.5 .. 2
  };
  Place at(Vec2 metres) const;

  /// Height of the land that the model's outer edge is held at, metres.
  double edgeHeight(const Place& place) const;

 private:
  std::uint64_t seed_;
  double extent_;
  bool sea_;
  Vec2 inland_;  ///< unit direction away from the sea
};

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "datasets/flow_routing.h"

namespace arete {

/// One step of a landscape: dh/dt = U - K sqrt(A) S along the water, and diffusion on hillsides.
/// Time is folded in: the step's length appears only in the products below.
struct ErosionStep {
  double incision = 0.2;                ///< K dt; a pure number, as sqrt(A) is in metres
  double diffusionSquareMetres = 2000;  ///< D dt of hillsides
  double seepageSquareMetres = 4e4;  ///< added to every drainage area: bounds the slope of the valley heads
  double channelSquareMetres = 4e4;  ///< from this drainage area on a cell is a river bed
};

/// Shapes the grid by one step. `upliftMetres` is U dt of each cell, `erodibility` scales K of each cell.
/// The incision is implicit and unconditionally stable [BraunWillett2013]. O(n); the result does not depend
/// on threads.
void erode(ReliefGrid& grid, const std::vector<float>& upliftMetres, const std::vector<float>& erodibility,
           const ErosionStep& step, DrainageNetwork& network);

}  // namespace arete

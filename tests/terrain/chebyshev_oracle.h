// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace arete::testing {

/// |sum of factor * unknown + rest|, of which the largest is minimised.
struct LinearResidual {
  std::vector<std::pair<std::uint32_t, double>> terms;
  double rest = 0;
};

/// The least value that the largest |residual| can have: a linear program, solved exactly by CGAL's simplex.
/// For tens of unknowns and hundreds of residuals.
double leastMaximum(std::uint32_t unknowns, const std::vector<LinearResidual>& residuals);

}  // namespace arete::testing

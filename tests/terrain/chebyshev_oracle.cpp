// SPDX-License-Identifier: GPL-3.0-or-later
#include "terrain/chebyshev_oracle.h"

#include <CGAL/Gmpzf.h>
#include <CGAL/QP_functions.h>
#include <CGAL/QP_models.h>

namespace arete::testing {

double leastMaximum(std::uint32_t unknowns, const std::vector<LinearResidual>& residuals) {
  CGAL::Quadratic_program<double> program(CGAL::SMALLER, false, 0, false, 0);
  const int bound = static_cast<int>(unknowns);
  int row = 0;
  for (const LinearResidual& r : residuals)
    for (const double sign : {1.0, -1.0}) {  // sign * residual - bound <= 0
      for (const auto& [unknown, factor] : r.terms)
        program.set_a(static_cast<int>(unknown), row, sign * factor);
      program.set_a(bound, row, -1);
      program.set_b(row, -sign * r.rest);
      ++row;
    }
  program.set_c(bound, 1);
  return CGAL::to_double(CGAL::solve_linear_program(program, CGAL::Gmpzf()).objective_value());
}

}  // namespace arete::testing

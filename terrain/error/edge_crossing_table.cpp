// SPDX-License-Identifier: GPL-3.0-or-later
//
// An edge crosses edges of the finest triangulation where it crosses grid columns, grid rows and the
// diagonals column - row = constant. All of this is computed in integers but for the fractions stored.
// Crossings at a sample are left out.
#include "terrain/error/edge_crossing_table.h"

namespace arete {
namespace {

/// a / b rounded down, and the remainder as a fraction of b. Precondition: b != 0.
struct Quotient {
  int whole;
  double part;
  Quotient(int a, int b) {
    if (b < 0) {
      a = -a;
      b = -b;
    }
    whole = a / b - (a % b < 0 ? 1 : 0);
    part = double(a - whole * b) / b;
  }
};

}  // namespace

EdgeCrossingTable::EdgeCrossingTable(std::uint32_t columns) {
  const auto sample = [&](int x, int y) { return y * static_cast<std::int32_t>(columns) + x; };
  // visit(k) for the whole numbers strictly between 0 and `end`.
  const auto forBetween = [](int end, const auto& visit) {
    const int step = end > 0 ? 1 : -1;
    for (int k = step; k * step < end * step; k += step) visit(k);
  };
  first_[0] = 0;
  for (int dy = -kReach; dy <= kReach; ++dy)
    for (int dx = -kReach; dx <= kReach; ++dx) {
      forBetween(dx, [&](int x) {
        const Quotient y(dy * x, dx);
        if (y.part != 0)
          crossings_.push_back({sample(x, y.whole), sample(x, y.whole + 1), double(x) / dx, y.part});
      });
      forBetween(dy, [&](int y) {
        const Quotient x(dx * y, dy);
        if (x.part != 0)
          crossings_.push_back({sample(x.whole, y), sample(x.whole + 1, y), double(y) / dy, x.part});
      });
      forBetween(dx - dy, [&](int diagonal) {
        const Quotient x(dx * diagonal, dx - dy);
        const int y = x.whole - diagonal;
        if (x.part != 0)
          crossings_.push_back(
              {sample(x.whole, y), sample(x.whole + 1, y + 1), double(diagonal) / (dx - dy), x.part});
      });
      first_[index(dx, dy) + 1] = static_cast<std::uint32_t>(crossings_.size());
    }
}

}  // namespace arete

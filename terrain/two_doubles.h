// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace arete {

/// Two doubles that are worked on at once.
using Two = double __attribute__((vector_size(16)));

inline Two both(double x) {
  return Two{x, x};
}
inline Two firsts(Two a, Two b) {
  return Two{a[0], b[0]};
}
inline Two seconds(Two a, Two b) {
  return Two{a[1], b[1]};
}
inline Two swapped(Two x) {
  return Two{x[1], x[0]};
}
inline Two larger(Two a, Two b) {
  return a > b ? a : b;
}
inline Two smaller(Two a, Two b) {
  return a < b ? a : b;
}
inline Two magnitude(Two x) {
  return larger(x, -x);
}
inline double largest(Two x) {
  return larger(x, swapped(x))[0];
}
inline double smallest(Two x) {
  return smaller(x, swapped(x))[0];
}
inline Two load(const double* x) {
  return Two{x[0], x[1]};
}
inline Two load(const float* x) {
  using TwoFloats = float __attribute__((vector_size(8)));
  return __builtin_convertvector((TwoFloats{x[0], x[1]}), Two);
}
/// The nearest whole numbers, of less than 2^51.
inline Two nearest(Two x) {
  const Two shift = both(0x1.8p52);
  return (x + shift) - shift;
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace arete {

/// Two doubles that are worked on at once.
using Double2 = double __attribute__((vector_size(16)));

inline Double2 both(double x) {
  return Double2{x, x};
}
inline Double2 firsts(Double2 a, Double2 b) {
  return Double2{a[0], b[0]};
}
inline Double2 seconds(Double2 a, Double2 b) {
  return Double2{a[1], b[1]};
}
inline Double2 swapped(Double2 x) {
  return Double2{x[1], x[0]};
}
inline Double2 larger(Double2 a, Double2 b) {
  return a > b ? a : b;
}
inline Double2 smaller(Double2 a, Double2 b) {
  return a < b ? a : b;
}
inline Double2 magnitude(Double2 x) {
  return larger(x, -x);
}
inline double largest(Double2 x) {
  return larger(x, swapped(x))[0];
}
inline double smallest(Double2 x) {
  return smaller(x, swapped(x))[0];
}
inline Double2 load(const double* x) {
  return Double2{x[0], x[1]};
}
inline Double2 load(const float* x) {
  using TwoFloats = float __attribute__((vector_size(8)));
  return __builtin_convertvector((TwoFloats{x[0], x[1]}), Double2);
}
/// The nearest whole numbers, of less than 2^51.
inline Double2 nearest(Double2 x) {
  const Double2 shift = both(0x1.8p52);
  return (x + shift) - shift;
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Pairs of doubles in one vector register (a GCC vector extension: SSE2 on x86-64, NEON on ARM64), for the
/// inner loops of RasterError.
namespace arete::simd {

/// Two doubles; + - * / and comparisons work on both lanes at once.
using Double2 = double __attribute__((vector_size(16)));

/// {x, x}
inline Double2 broadcast(double x) {
  return Double2{x, x};
}
/// {a[0], b[0]}
inline Double2 lowLanes(Double2 a, Double2 b) {
  return Double2{a[0], b[0]};
}
/// {a[1], b[1]}
inline Double2 highLanes(Double2 a, Double2 b) {
  return Double2{a[1], b[1]};
}
/// {x[1], x[0]}
inline Double2 swapLanes(Double2 x) {
  return Double2{x[1], x[0]};
}
/// Lane by lane; b where either is NaN.
inline Double2 max(Double2 a, Double2 b) {
  return a > b ? a : b;
}
/// Lane by lane; b where either is NaN.
inline Double2 min(Double2 a, Double2 b) {
  return a < b ? a : b;
}
inline Double2 abs(Double2 x) {
  return max(x, -x);
}
inline double maxLane(Double2 x) {
  return max(x, swapLanes(x))[0];
}
inline double minLane(Double2 x) {
  return min(x, swapLanes(x))[0];
}
/// Two consecutive numbers in memory, of any alignment.
inline Double2 load(const double* x) {
  return Double2{x[0], x[1]};
}
inline Double2 load(const float* x) {
  using Float2 = float __attribute__((vector_size(8)));
  return __builtin_convertvector((Float2{x[0], x[1]}), Double2);
}
/// Each lane rounded to the nearest whole number, ties to even. Precondition: |x| < 2^51.
inline Double2 roundToNearest(Double2 x) {
  const Double2 shift = broadcast(0x1.8p52);
  return (x + shift) - shift;
}

}  // namespace arete::simd

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace arete {

/// Gradient noise over the plane [Perlin1985], with the quintic fade of [Perlin2002]: about -1 .. 1, zero at
/// the integer lattice, twice differentiable. Arithmetic only, so the same bits on every machine.
/// Precondition: |x| and |y| below 2^52.
double gradientNoise(std::uint64_t seed, double x, double y);

struct FractalOptions {
  int octaves = 6;
  double lacunarity = 2;     ///< frequency ratio of one octave to the one before
  double persistence = 0.5;  ///< amplitude ratio
};

/// A sum of octaves of gradient noise, normalised by the sum of the amplitudes: about -1 .. 1.
double fractalNoise(std::uint64_t seed, double x, double y, const FractalOptions& options = {});

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include "engine/memory/uninitialized_vector.h"

namespace arete {

/// The heights of a raster for scattered reads. They are stored as floats where that loses nothing, which
/// holds for most DEMs (whole metres, or floats in the file): a cache line then holds twice as many.
class SampleHeights {
 public:
  /// Keeps a reference to `heights` (NaN for NODATA). O(samples), parallel.
  explicit SampleHeights(std::span<const double> heights);

  std::size_t size() const { return doubles_.size(); }
  /// The heights as given, for sequential reads.
  std::span<const double> given() const { return doubles_; }
  double operator[](std::size_t sample) const {
    return areFloats_ ? static_cast<double>(floats_[sample]) : doubles_[sample];
  }
  /// Calls visit(first) with a pointer to the first height, `const float*` or `const double*`.
  /// @return visit's result
  template <class Visit>
  [[gnu::always_inline]] auto with(const Visit& visit) const {
    return areFloats_ ? visit(floats_.data()) : visit(doubles_.data());
  }
  /// Prefetches the height of a sample.
  [[gnu::always_inline]] void prefetch(std::size_t sample) const {
    if (areFloats_)
      __builtin_prefetch(floats_.data() + sample);
    else
      __builtin_prefetch(doubles_.data() + sample);
  }

 private:
  std::span<const double> doubles_;
  UninitializedVector<float> floats_;
  bool areFloats_ = false;
};

}  // namespace arete

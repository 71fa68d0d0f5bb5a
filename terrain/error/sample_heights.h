// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <span>

#include "engine/memory/uninitialized_vector.h"

namespace arete {

/// The heights of a raster for those who read a few here and a few there: in floats where these are the same
/// numbers, which those of most DEMs are (whole metres, or floats themselves). A line of the cache then has
/// twice as many of them.
class SampleHeights {
 public:
  /// Refers to `heights` (NaN for NODATA) where floats would not do. O(samples), parallel.
  explicit SampleHeights(std::span<const double> heights);

  std::size_t size() const { return doubles_.size(); }
  /// As they were given, for who reads them in their order.
  std::span<const double> given() const { return doubles_; }
  double operator[](std::size_t sample) const {
    return areFloats_ ? static_cast<double>(floats_[sample]) : doubles_[sample];
  }
  /// visit(first): with a pointer to the first of them, of either type.
  template <class Visit>
  [[gnu::always_inline]] auto with(const Visit& visit) const {
    return areFloats_ ? visit(floats_.data()) : visit(doubles_.data());
  }
  /// Asks for a sample's.
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

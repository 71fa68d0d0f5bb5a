// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace arete {

/// Heights that stand alone: lower or higher than all others, with an empty range between, and few. They are
/// likely to mark missing data that the file does not declare, or to be errors of a sensor.
struct LoneHeights {
  struct Value {
    double height = 0;
    std::uint64_t count = 0;
  };
  /// The most values that are listed.
  static constexpr std::size_t kMostValues = 3;

  std::vector<Value> values;       ///< distinct ones, rising; empty where there are more than kMostValues
  std::uint64_t count = 0;         ///< of samples that stand alone
  double lowest = 0, highest = 0;  ///< of these
  double low = 0, high = 0;        ///< of all other samples; NaN without a sample

  bool isLone(double height) const { return height < low || height > high; }
  /// Whether the lone heights are so far away that errors of the others would drown in their range: by a
  /// thousand times the range of the others.
  bool areRemote() const;
};

/// Heights stand alone where the gap to the others exceeds twice the range of these, or half of it for values
/// that often mark missing data (-9999, -32768, ...), and they are up to three distinct values or up to a
/// thousandth of the samples. Up to seven of fewer than 4096 samples must be ten ranges apart. Among fewer
/// than 64 samples or four distinct heights, other values must stand a thousand ranges apart, and above or
/// below level ground a thousand times its height. O(samples), parallel.
/// @param heights  NaN for NODATA
/// @param scale, offset  height = raw * scale + offset, by which raw values are known that mark missing data
LoneHeights loneHeights(std::span<const double> heights, double scale = 1, double offset = 0);

/// A sentence that names lone heights, their number, and `nodata` as the remedy; in raw values.
/// Precondition: count > 0.
std::string describe(const LoneHeights& lone, double scale = 1, double offset = 0);

}  // namespace arete

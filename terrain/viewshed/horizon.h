// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace arete {

/// The skyline of a wedge of directions: the upper envelope of segments in the image plane (ImagePlane),
/// whose u is the direction and whose v is the height in it. Segments come in any order.
///
/// Directions are split into bins. A bin stores its part of the envelope as parts of the segments' own lines,
/// so that nothing is rounded twice, and bounds, which answer most queries.
class ViewshedHorizon {
 public:
  /// Over [first, last], in `bins` bins; -infinity everywhere.
  ViewshedHorizon(double first, double last, std::uint32_t bins);

  /// @return the bin of a direction; the first or last for directions outside.
  int bin(double u) const {
    const auto b = static_cast<int>((u - first_) * perUnit_);
    return b < 0 ? 0 : b > lastBin_ ? lastBin_ : b;
  }
  int binCount() const { return lastBin_ + 1; }
  /// @return a lower bound of the envelope less its slack, all over the bin.
  double low(int bin) const { return low_[static_cast<std::size_t>(bin)]; }
  /// @return an upper bound of the envelope, all over the bin.
  double high(int bin) const { return high_[static_cast<std::size_t>(bin)]; }
  /// @return low() over all bins from one to another.
  double low(int from, int to) const {
    double low = low_[static_cast<std::size_t>(from)];
    for (int b = from + 1; b <= to; ++b) {
      const double other = low_[static_cast<std::size_t>(b)];
      low = other < low ? other : low;
    }
    return low;
  }

  /// Adds the segment from (u0, v0) to (u1, v1), both ends included. Parts outside of [first, last] and
  /// segments of no width are left out. A segment may be left out where it is less than a hundredth of its
  /// slack above the envelope. O(bins it crosses * their parts).
  /// @param slack the true segment is at most this much lower; infinite: it may not exist.
  void add(double u0, double v0, double u1, double v1, double slack);

  /// Bounds of the true envelope.
  struct Bounds {
    double lower, upper;
  };
  /// @return `upper` is the envelope at u, `lower` the least that it may be, by the slack of its segments.
  Bounds at(double u) const;

 private:
  struct Part {  ///< v = a + b u from `start` to where the next part starts
    double start, a, b, slack;
    double at(double u) const { return a + b * u; }
  };
  struct Bin {
    std::uint32_t from = 0, count = 0, capacity = 0;
  };

  double startOf(int bin) const { return first_ + bin * width_; }
  void add(int bin, const Part& line, double from, double to);

  double first_, width_, perUnit_;
  int lastBin_;
  std::vector<double> low_, high_;
  std::vector<Bin> bins_;
  std::vector<Part> parts_;  ///< those of a bin are contiguous
  std::vector<Part> scratch_;
};

}  // namespace arete

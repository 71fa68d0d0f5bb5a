// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace arete {

/// The skyline of a wedge of directions: the upper envelope of segments in a picture whose u is the direction
/// and whose v is how high a thing stands in it. Segments come in any order.
///
/// Directions are split into bins. A bin keeps its part of the envelope as pieces of straight lines, those of
/// the segments themselves, so that nothing is rounded twice; and bounds, which answer most questions.
class ViewshedHorizon {
 public:
  /// Over [first, last], in `bins` bins. The envelope is -infinity everywhere.
  ViewshedHorizon(double first, double last, std::uint32_t bins);

  int bin(double u) const {
    const auto b = static_cast<int>((u - first_) * perUnit_);
    return b < 0 ? 0 : b > lastBin_ ? lastBin_ : b;
  }
  int binCount() const { return lastBin_ + 1; }
  /// The envelope less its slack is nowhere lower, and the envelope nowhere higher, in the bin.
  double low(int bin) const { return low_[static_cast<std::size_t>(bin)]; }
  double high(int bin) const { return high_[static_cast<std::size_t>(bin)]; }
  /// Over bins from one to another.
  double low(int from, int to) const {
    double low = low_[static_cast<std::size_t>(from)];
    for (int b = from + 1; b <= to; ++b) {
      const double other = low_[static_cast<std::size_t>(b)];
      low = other < low ? other : low;
    }
    return low;
  }

  /// The segment from (u0, v0) to (u1, v1), both ends included, known to stand no more than `slack` lower;
  /// an infinite one: it may not be there at all.
  /// It may be left out where it is less than a hundredth of its slack above the envelope. What is outside of
  /// [first, last], and a segment of no width, is left out.
  void add(double u0, double v0, double u1, double v1, double slack);

  /// Bounds of the envelope at u: `upper` is it, `lower` what it is at least after taking off the slack.
  struct Bounds {
    double lower, upper;
  };
  Bounds at(double u) const;

 private:
  struct Piece {  ///< v = a + b u from `start` to where the next piece starts
    double start, a, b, slack;
    double at(double u) const { return a + b * u; }
  };
  struct Bin {
    std::uint32_t from = 0, count = 0, capacity = 0;
  };

  double startOf(int bin) const { return first_ + bin * width_; }
  void add(int bin, const Piece& line, double from, double to);

  double first_, width_, perUnit_;
  int lastBin_;
  std::vector<double> low_, high_;
  std::vector<Bin> bins_;
  std::vector<Piece> pieces_;  ///< each bin's in a row
  std::vector<Piece> scratch_;
};

}  // namespace arete

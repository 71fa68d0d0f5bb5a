// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/vec.h"
#include "surface/fit/fit_lines.h"

namespace arete {

/// Samples of the source's lines, each with its nearest point on the line of the cut. A sample begins at the
/// edge that stands for its way, and only goes on along the line: two lines that are near each other are
/// never confused.
class LineSamples {
 public:
  struct Sample {
    Vec3 place{0, 0, 0};
    std::uint32_t edge = 0;          ///< of the lines
    std::array<double, 2> shares{};  ///< of its ends
    Vec3 residual{0, 0, 0};          ///< from the nearest point to the place
  };

  /// @param width  of the way that a sample stands for
  /// @param inFrame  a place of the lines in the frame of the fit. O(samples)
  template <class InFrame>
  LineSamples(const FitLines& lines, double width, const InFrame& inFrame) : lines_(&lines) {
    for (std::uint32_t e = 0; e < lines.edges.size(); ++e) {
      const std::vector<Vec3>& way = lines.edges[e].way;
      for (std::size_t i = 0; i + 1 < way.size(); ++i) add(e, inFrame(way[i]), inFrame(way[i + 1]), width);
    }
  }
  const std::vector<Sample>& all() const { return samples_; }
  /// Finds the nearest points. @return the sum of the squared distances. O(samples)
  double assign(std::span<const Vec3> positions);
  /// Of what assign() found.
  double largest() const;

 private:
  void add(std::uint32_t edge, const Vec3& p, const Vec3& q, double width);

  const FitLines* lines_;
  double length_ = 0;
  std::vector<Sample> samples_;
};

}  // namespace arete

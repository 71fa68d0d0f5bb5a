// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>

#include "terrain/lattice_plan.h"
#include "terrain/live_mesh.h"
#include "terrain/signed_bound.h"

namespace arete {

/// Vertical error of triangles over a raster, exactly: every sample a triangle covers, its edges included, is
/// compared with the triangle's plane. Triangles are planar in (column, row). NODATA inside a triangle is
/// passed over.
class RasterError {
 public:
  /// The triangles of one hole, named by corners of its link.
  class Hole {
   public:
    Hole(const RasterError& errors, const Star& star, std::uint32_t) : errors_(errors), star_(star) {}
    double maximum(int i, int j, int m, double limit) const {
      return errors_.maximum(star_.link[i], star_.link[j], star_.link[m], limit);
    }
    double maximum(int i, int j, int m, SignedBound& bound) const {
      return errors_.maximum(star_.link[i], star_.link[j], star_.link[m], bound);
    }
    SignedBound alongEdge(int i, int j) const { return errors_.alongEdge(star_.link[i], star_.link[j]); }
    void settle(const HoleTriangulation&) const {}

   private:
    const RasterError& errors_;
    const Star& star_;
  };

  /// `reachesBeyondRims`: triangles may reach beyond the rim of the domain (a rim tolerance is in use).
  RasterError(const LatticePlan& plan, std::span<const double> heights, bool reachesBeyondRims)
      : plan_(plan),
        heights_(heights),
        rows_(static_cast<std::uint32_t>(heights.size() / plan.columns())),
        reachesBeyondRims_(reachesBeyondRims) {}

  double height(std::uint32_t sample) const { return heights_[sample]; }
  /// Asks for the heights around a vertex that is soon to be evaluated.
  [[gnu::always_inline]] void prefetch(std::uint32_t sample) const {
    const std::size_t columns = plan_.columns();
    __builtin_prefetch(heights_.data() + sample);
    if (sample >= columns) __builtin_prefetch(heights_.data() + sample - columns);
    if (sample + columns < heights_.size()) __builtin_prefetch(heights_.data() + sample + columns);
  }
  /// The live mesh has moved its triangles: nothing here hangs on them.
  void compact(std::span<const std::uint32_t>, std::size_t) {}

  /// max |z - plane| over the samples covered; gives up at the first row beyond the limit and returns a value
  /// > limit. Precondition: a, b, c counter-clockwise. O(samples covered + rows).
  double maximum(std::uint32_t a, std::uint32_t b, std::uint32_t c, double limit) const;

  /// The same error without a limit, and the signed difference over the covered samples.
  double maximum(std::uint32_t a, std::uint32_t b, std::uint32_t c, SignedBound& bound) const;

  /// Signed difference between the segment a-b and the finest triangulation where the segment crosses its
  /// edges: with the samples inside, these hold the extremes of the difference over a triangle. O(length in
  /// samples).
  SignedBound alongEdge(std::uint32_t a, std::uint32_t b) const;

 private:
  template <class Row>
  void forRows(std::uint32_t a, std::uint32_t b, std::uint32_t c, const Row& row) const;

  const LatticePlan& plan_;
  std::span<const double> heights_;
  std::uint32_t rows_;
  bool reachesBeyondRims_;
};

}  // namespace arete

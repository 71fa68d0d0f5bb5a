// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "terrain/laws/error_law.h"
#include "terrain/model/heightfield.h"

namespace arete::laws {

/// Law 10 over a raster. Every sample that a triangle covers is looked at, and every crossing of its edges
/// with edges of the finest triangulation.
class RasterErrorLaw : public ErrorLaw {
 public:
  /// @param mt  with lattice vertices
  /// @param field  the samples of the model, or of some of its rows, over which alone the law is checked then
  /// @param top  the number of the field's first row
  RasterErrorLaw(const MultiTriangulation& mt, RasterHeightfield field, std::int64_t top = 0)
      : mt_(mt), field_(std::move(field)), top_(top) {}

  /// O(samples covered + length of the edges).
  bool holds(std::uint32_t triangle) const override;

 private:
  struct Sample {
    std::int64_t x, y;
    double z;
    Vec3 vec() const { return {double(x), double(y), z}; }
  };
  Sample sampleAt(std::int64_t x, std::int64_t y) const;
  bool holdsAtSamples(const StoredErrors& stored, const std::array<Sample, 3>& corner) const;
  bool holdsAlong(const StoredErrors& stored, const Sample& a, const Sample& b) const;

  const MultiTriangulation& mt_;
  RasterHeightfield field_;
  std::int64_t top_;
};

}  // namespace arete::laws

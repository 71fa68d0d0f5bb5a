// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "terrain/model/georeference.h"

namespace arete {

/// From the coordinates of a CRS to longitude and latitude in degrees, of the CRS's own datum and prime
/// meridian, and back: no datum is changed, so nothing is lost on the way but rounding. Thread-safe.
class CrsLonLat {
 public:
  /// Errors: usage (the DEM has no CRS), unsupported (a CRS of no place on an ellipsoid, of a building site
  /// for instance), invalidData (PROJ knows no way).
  static Result<CrsLonLat> of(const Georeference& georeference);

  CrsLonLat(CrsLonLat&&) noexcept;
  CrsLonLat& operator=(CrsLonLat&&) noexcept;
  ~CrsLonLat();

  /// x, y of the CRS are longitude and latitude themselves, in some unit: no projection is asked.
  bool isPlain() const { return !pool_; }

  /// In place; NaN where the CRS cannot tell a position. Longitudes of a plain CRS come as they are, 350 or
  /// -10. O(positions).
  void toLonLat(std::span<Vec2> positions) const;
  void toCrs(std::span<Vec2> lonLat) const;

 private:
  struct Pool;
  CrsLonLat();
  double degreesPerUnit_ = 1;
  std::unique_ptr<Pool> pool_;
};

}  // namespace arete

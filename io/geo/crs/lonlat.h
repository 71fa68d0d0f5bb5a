// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "terrain/model/georeference.h"

namespace arete {

/// Converts between the coordinates of a CRS and longitude and latitude in degrees, of the CRS's own datum
/// and prime meridian. No datum is transformed, so the only error is rounding. Thread-safe.
class CrsLonLat {
 public:
  /// Errors: usage: the DEM has no CRS. unsupported: a CRS without an ellipsoid, such as that of a building
  /// site. invalidData: PROJ has no transformation.
  static Result<CrsLonLat> of(const Georeference& georeference);

  CrsLonLat(CrsLonLat&&) noexcept;
  CrsLonLat& operator=(CrsLonLat&&) noexcept;
  ~CrsLonLat();

  /// True if x, y of the CRS are longitude and latitude in some unit, so that no projection is needed.
  bool isPlain() const { return !pool_; }

  /// In place. A position outside the domain of the CRS becomes NaN. Longitudes of a plain CRS are not
  /// normalized: 350 stays 350. O(positions).
  void toLonLat(std::span<Vec2> positions) const;
  void toCrs(std::span<Vec2> lonLat) const;

 private:
  struct Pool;
  CrsLonLat();
  double degreesPerUnit_ = 1;
  std::unique_ptr<Pool> pool_;
};

}  // namespace arete

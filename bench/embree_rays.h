// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "terrain/sight/earth.h"
#include "terrain/sight/grid.h"
#include "terrain/viewshed/viewshed.h"

namespace arete::bench {

/// The rival for viewsheds: Embree, one occlusion ray for each cell, in coherent packets of sixteen, on one
/// thread, over the full triangles or over its own grid geometry. In float32, metres from the middle of the
/// DEM.
class EmbreeRays {
 public:
  enum class Geometry { triangles, grid };
  /// NODATA is a deep hole.
  static std::unique_ptr<EmbreeRays> make(const SightGrid& grid, const SightEarth::PlaneSteps& steps,
                                          double heightUnitMetres, Geometry geometry);
  virtual ~EmbreeRays() = default;
  virtual double buildSeconds() const = 0;
  /// 1 where a cell is seen, row by row; targets on the ground.
  virtual std::vector<std::uint8_t> viewshed(const ViewshedObserver& observer) const = 0;
};

}  // namespace arete::bench

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>

#include "engine/base/vec.h"

namespace arete {

/// The position of a heightfield on the ground, as its file states it; nothing else is assumed.
///
/// Grid coordinates (column, row) count samples: sample (0, 0) is the first of the raster and stands at
/// the centre of its pixel. Source coordinates (x, y) are those of the CRS, or bare numbers without one.
struct Georeference {
  /// GDAL's affine transform of *pixel* coordinates (corner of the first pixel = 0, 0):
  /// x = g[0] + g[1] * pixel + g[2] * line,  y = g[3] + g[4] * pixel + g[5] * line.
  /// A scattered point set keeps its own x, y: the identity with the half pixel taken out.
  std::array<double, 6> geoTransform = {0, 1, 0, 0, 0, 1};
  /// False where the file has no position; then x counts columns and y rows, upwards from the last.
  bool hasGeoTransform = false;
  /// The last column of the raster is its first one again, a whole turn of longitudes farther: the source
  /// goes round the Earth and has no cell between its last column and its first (io/geo/dem/seam_column.h).
  bool repeatsFirstColumn = false;

  std::string crsWkt;         ///< WKT 2 as GDAL exports it; empty = no CRS
  bool isGeographic = false;  ///< x, y are longitude, latitude in angularUnitRadians
  double angularUnitRadians = 0.017453292519943295;
  double linearUnitMetres = 1;  ///< of a projected CRS
  /// Lengths along x and y on the map for a length of 1 on the ground, in the middle of the DEM: 2, 2 in
  /// EPSG:3857 at 60 degrees. Stated where one of them is off 1 by a hundredth (io/geo/crs/map_scale.h).
  std::optional<std::array<double, 2>> mapScale = {};
  double semiMajorAxisMetres = 6378137;
  double inverseFlattening = 298.257223563;  ///< 0 = sphere

  std::string verticalUnit;       ///< as stated in the file ("m", "metre", "ft", ...); may be empty
  double verticalUnitMetres = 1;  ///< metres in one unit; 1 where the file does not state it
  std::string verticalDatum;      ///< as stated in the file; may be empty

  /// Source coordinates of a sample (real-valued column and row allowed): geotransform(col + 1/2, row + 1/2).
  Vec2 toSource(double column, double row) const {
    const double p = column + 0.5, l = row + 0.5;
    const auto& g = geoTransform;
    return {g[0] + g[1] * p + g[2] * l, g[3] + g[4] * p + g[5] * l};
  }

  /// Grid coordinates of a source position. Precondition: determinant() != 0.
  Vec2 toGrid(double x, double y) const {
    const auto& g = geoTransform;
    const double dx = x - g[0], dy = y - g[3], det = determinant();
    return {(dx * g[5] - dy * g[2]) / det - 0.5, (dy * g[1] - dx * g[4]) / det - 0.5};
  }

  /// Negative for the usual north-up raster: (column, row) turns the other way round than (x, y).
  double determinant() const { return geoTransform[1] * geoTransform[5] - geoTransform[2] * geoTransform[4]; }
};

/// The length on the ground of one step along a row (x) and one along a column (y) at a grid position: in
/// metres where the CRS is known, in source units otherwise. Geographic steps are geodesics [Karney2013];
/// those of a map have its scale in the middle of the DEM.
Vec2 groundStep(const Georeference& georeference, double column, double row);

/// Metres to the east of one unit of x and to the north of one unit of y (angles), at the latitude y.
/// Precondition: isGeographic.
Vec2 groundUnit(const Georeference& georeference, double y);

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Samples stay what they are: a raster whose samples stand on no grid of equal steps would have to be
// resampled, so it is refused.
#include "io/geo/dem/raster_placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/geo/crs/reader.h"

namespace arete {
namespace {

constexpr double kMostPixelsOff = 0.01;

/// True if every point is where the transform says, within a part of a pixel.
bool fits(const GDAL_GCP* points, int count, const std::array<double, 6>& g) {
  const double determinant = g[1] * g[5] - g[2] * g[4];
  if (!(std::abs(determinant) > 0) || !std::isfinite(determinant)) return false;
  return std::all_of(points, points + count, [&](const GDAL_GCP& p) {
    const double dx = p.dfGCPX - g[0], dy = p.dfGCPY - g[3];
    const double pixel = (dx * g[5] - dy * g[2]) / determinant, line = (dy * g[1] - dx * g[4]) / determinant;
    return std::abs(pixel - p.dfGCPPixel) <= kMostPixelsOff && std::abs(line - p.dfGCPLine) <= kMostPixelsOff;
  });
}

}  // namespace

Result<OGRSpatialReference> placeRaster(GDALDataset& dataset, Georeference& georeference,
                                        Warnings& warnings) {
  std::array<double, 6> transform{};
  const auto crsOf = [](const OGRSpatialReference* crs) {
    return isKnownCrs(crs) ? *crs : OGRSpatialReference();
  };
  georeference.hasGeoTransform = dataset.GetGeoTransform(transform.data()) == CE_None;
  if (georeference.hasGeoTransform) {
    georeference.geoTransform = transform;
    return crsOf(dataset.GetSpatialRef());
  }
  if (const int count = dataset.GetGCPCount(); count > 0) {
    const GDAL_GCP* points = dataset.GetGCPs();
    if (count >= 3 && GDALGCPsToGeoTransform(count, points, transform.data(), TRUE) &&
        fits(points, count, transform)) {
      georeference.geoTransform = transform;
      georeference.hasGeoTransform = true;
      return crsOf(dataset.GetGCPSpatialRef());
    }
    return failure(
        ErrorCode::unsupported,
        fmt::format("is placed by {} ground control points, which stand on no grid of equal steps: "
                    "gdalwarp resamples it to one (-tps for a thin plate spline)",
                    count));
  }
  if (dataset.GetMetadata("RPC"))
    return failure(
        ErrorCode::unsupported,
        "is placed by RPC coefficients, which give no grid of equal steps: gdalwarp -rpc resamples it "
        "to one");
  if (dataset.GetMetadata("GEOLOCATION"))
    return failure(
        ErrorCode::unsupported,
        "is placed by arrays of coordinates, one for each sample (a curvilinear grid), and not by a grid "
        "of equal steps: gdalwarp -geoloc resamples it to one");
  georeference.geoTransform = {0, 1, 0, double(dataset.GetRasterYSize()), 0, -1};
  const bool hasCrs = isKnownCrs(dataset.GetSpatialRef());
  warnings.push_back(
      {WarningCode::position,
       fmt::format("has no georeference{}: x counts its columns, y its rows upwards from the last one",
                   hasCrs ? ", so its CRS is not used" : "")});
  return OGRSpatialReference();
}

}  // namespace arete

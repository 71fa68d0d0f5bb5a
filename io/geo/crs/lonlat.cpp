// SPDX-License-Identifier: GPL-3.0-or-later
//
// A PROJ transformation serves one thread at a time and takes milliseconds to create. A pool keeps the idle
// ones and creates another if a thread finds none, so there are at most as many as threads.
#include "io/geo/crs/lonlat.h"

#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <mutex>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "io/geo/crs/reader.h"
#include "io/geo/crs/transform.h"
#include "io/geo/gdal/support.h"

namespace arete {
namespace {

struct ThereAndBack {
  CrsTransform toLonLat, toCrs;
};

Result<ThereAndBack> makeTransforms(const std::string& crs, const std::string& lonLat) {
  ARETE_TRY(auto there, CrsTransform::between(crs, lonLat));
  ARETE_TRY(auto back, CrsTransform::between(lonLat, crs));
  return ThereAndBack{std::move(there), std::move(back)};
}

/// The geographic CRS of the datum of `crs`. OGR does not give access to the base CRS of a rotated pole; PROJ
/// accepts any geographic CRS on the same ellipsoid instead.
OGRSpatialReference ownLonLat(const OGRSpatialReference& crs) {
  OGRSpatialReference own;
  if (crs.IsDerivedGeographic()) {
    own.SetGeogCS("own", "own", "own", crs.GetSemiMajor(), crs.GetInvFlattening());
  } else {
    own.CopyGeogCSFrom(&crs);
  }
  own.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return own;
}

}  // namespace

struct CrsLonLat::Pool {
  std::string crs, lonLat;
  std::mutex mutex;
  std::vector<std::unique_ptr<ThereAndBack>> free;

  std::unique_ptr<ThereAndBack> take() {
    {
      const std::scoped_lock lock(mutex);
      if (!free.empty()) {
        auto last = std::move(free.back());
        free.pop_back();
        return last;
      }
    }
    auto made = makeTransforms(crs, lonLat);  // succeeded when the pool was created
    return made ? std::make_unique<ThereAndBack>(std::move(*made)) : nullptr;
  }
  void give(std::unique_ptr<ThereAndBack> transforms) {
    const std::scoped_lock lock(mutex);
    free.push_back(std::move(transforms));
  }
  void apply(std::span<Vec2> positions, CrsTransform ThereAndBack::*which) {
    auto transforms = take();
    if (!transforms) {
      std::fill(positions.begin(), positions.end(), Vec2{std::nan(""), std::nan("")});
      return;
    }
    ((*transforms).*which).apply(positions);
    give(std::move(transforms));
  }
};

CrsLonLat::CrsLonLat() = default;
CrsLonLat::CrsLonLat(CrsLonLat&&) noexcept = default;
CrsLonLat& CrsLonLat::operator=(CrsLonLat&&) noexcept = default;
CrsLonLat::~CrsLonLat() = default;

Result<CrsLonLat> CrsLonLat::of(const Georeference& georeference) try {
  if (georeference.crsWkt.empty())
    return failure(ErrorCode::usage,
                   "the DEM has no CRS, so its places have no longitude and latitude; `crs` "
                   "states it when the DEM is built");
  registerGdal();
  const GdalErrors errors;
  ARETE_TRY(auto crs, crsFromText(georeference.crsWkt));
  crs.StripVertical();
  const char* name = crs.GetName();
  if (!crs.IsProjected() && !crs.IsGeographic() && !crs.IsDerivedGeographic())
    return failure(ErrorCode::unsupported,
                   fmt::format("the CRS {} has no longitude and latitude", name ? name : "of the DEM"));
  CrsLonLat result;
  if (crs.IsGeographic() && !crs.IsDerivedGeographic()) {
    result.degreesPerUnit_ = georeference.angularUnitRadians * 180 / std::numbers::pi;
    // Degrees to the last bit: 0.017453292519943295 * 180 / pi is 1 but for rounding.
    if (std::abs(result.degreesPerUnit_ - 1) < 1e-12) result.degreesPerUnit_ = 1;
    return result;
  }
  const OGRSpatialReference own = ownLonLat(crs);
  result.degreesPerUnit_ = own.GetAngularUnits() * 180 / std::numbers::pi;
  result.pool_ = std::make_unique<Pool>();
  result.pool_->crs = wktOf(crs);
  result.pool_->lonLat = wktOf(own);
  auto first = makeTransforms(result.pool_->crs, result.pool_->lonLat);
  if (!first) return failure(ErrorCode::invalidData, first.error().describe());
  result.pool_->give(std::make_unique<ThereAndBack>(std::move(*first)));
  return result;
} catch (...) {
  return caughtFailure();
}

void CrsLonLat::toLonLat(std::span<Vec2> positions) const {
  if (pool_) pool_->apply(positions, &ThereAndBack::toLonLat);
  if (degreesPerUnit_ == 1) return;
  for (Vec2& p : positions) p = {p.x * degreesPerUnit_, p.y * degreesPerUnit_};
}

void CrsLonLat::toCrs(std::span<Vec2> lonLat) const {
  if (degreesPerUnit_ != 1)
    for (Vec2& p : lonLat) p = {p.x / degreesPerUnit_, p.y / degreesPerUnit_};
  if (pool_) pool_->apply(lonLat, &ThereAndBack::toCrs);
}

}  // namespace arete

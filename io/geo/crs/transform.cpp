// SPDX-License-Identifier: GPL-3.0-or-later
//
// Both CRSs lose their vertical part, so that PROJ transforms the plan alone. Positions go through PROJ in
// batches.
#include "io/geo/crs/transform.h"

#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "engine/base/caught_failure.h"
#include "io/geo/crs/reader.h"
#include "io/geo/gdal/support.h"

namespace arete {
namespace {

struct TransformationCloser {
  void operator()(OGRCoordinateTransformation* t) const { OGRCoordinateTransformation::DestroyCT(t); }
};

bool isOnEarth(const Georeference& georeference) {
  constexpr double kEarthMetres = 6378137;
  return std::abs(georeference.semiMajorAxisMetres / kEarthMetres - 1) < 0.01;
}

}  // namespace

struct CrsTransform::State {
  std::unique_ptr<OGRCoordinateTransformation, TransformationCloser> transformation;
};

CrsTransform::CrsTransform() = default;
CrsTransform::CrsTransform(CrsTransform&&) noexcept = default;
CrsTransform& CrsTransform::operator=(CrsTransform&&) noexcept = default;
CrsTransform::~CrsTransform() = default;

Result<CrsTransform> CrsTransform::between(const std::string& from, const std::string& to,
                                           Ballpark ballpark) try {
  registerGdal();
  ARETE_TRY(auto source, crsFromText(from));
  ARETE_TRY(auto target, crsFromText(to));
  source.StripVertical();
  target.StripVertical();
  CrsTransform result;
  result.sourceWkt_ = wktOf(source);
  if (source.IsSame(&target)) return result;
  const GdalErrors errors;
  auto state = std::make_unique<State>();
  OGRCoordinateTransformationOptions options;
  options.SetBallparkAllowed(ballpark == Ballpark::allowed);
  state->transformation.reset(OGRCreateCoordinateTransformation(&source, &target, options));
  if (!state->transformation)
    return failure(
        ErrorCode::invalidData,
        fmt::format("there is no transformation from its CRS to the DEM's: {}", errors.firstFailure()));
  result.state_ = std::move(state);
  return result;
} catch (...) {
  return caughtFailure();
}

Result<CrsTransform> CrsTransform::fromLonLat(const Georeference& target) try {
  if (target.crsWkt.empty())
    return failure(ErrorCode::usage,
                   "the DEM has no CRS, so longitude and latitude cannot be brought into it; `crs` states "
                   "it when the DEM is built");
  if (isOnEarth(target)) return between("OGC:CRS84", target.crsWkt);
  registerGdal();
  ARETE_TRY(const auto crs, crsFromText(target.crsWkt));
  const std::unique_ptr<OGRSpatialReference> own(crs.CloneGeogCS());
  if (!own) return failure(ErrorCode::invalidData, "the CRS of the DEM has no longitude and latitude");
  return between(wktOf(*own), target.crsWkt);
} catch (...) {
  return caughtFailure();
}

std::optional<Vec2> CrsTransform::operator()(Vec2 p) const {
  apply({&p, 1});
  if (std::isnan(p.x)) return std::nullopt;
  return p;
}

void CrsTransform::apply(std::span<Vec2> positions) const {
  if (!state_) return turns_.apply(positions);
  const GdalErrors quiet;  // NaN marks the positions that fail
  constexpr std::size_t kAtOnce = 65536;
  std::vector<double> x, y;
  std::vector<int> known;
  for (std::size_t begin = 0; begin < positions.size(); begin += kAtOnce) {
    const auto part = positions.subspan(begin, std::min(kAtOnce, positions.size() - begin));
    x.clear();
    y.clear();
    for (const Vec2& p : part) {
      x.push_back(p.x);
      y.push_back(p.y);
    }
    known.assign(part.size(), 0);
    state_->transformation->Transform(int(part.size()), x.data(), y.data(), nullptr, known.data());
    for (std::size_t i = 0; i < part.size(); ++i) {
      const bool isKnown = known[i] && std::isfinite(x[i]) && std::isfinite(y[i]);
      constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
      part[i] = isKnown ? turns_({x[i], y[i]}) : Vec2{kNone, kNone};
    }
  }
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// A projected frame is a translation and a scaling; a geographic one is GeographicLib's LocalCartesian.
// Longitudes are reduced to half a turn before they are transformed, and returned within half a turn of the
// spec's middle.
#include "io/geo/crs/local_frame.h"

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/LocalCartesian.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace arete {

namespace {

constexpr double kTurnDegrees = 360;

bool isPositive(double value) {
  return value > 0 && std::isfinite(value);
}

}  // namespace

struct LocalFrame::Cartesian {
  GeographicLib::LocalCartesian transform;
};

Result<LocalFrame> LocalFrame::create(const LocalFrameSpec& spec) {
  const auto refuse = [](const char* message) { return failure(ErrorCode::invalidData, message); };
  if (!isFinite(spec.origin)) return refuse("the origin of the local frame is not finite");
  if (!isPositive(spec.linearUnitMetres) || !isPositive(spec.verticalUnitMetres) ||
      !isPositive(spec.mapScale[0]) || !isPositive(spec.mapScale[1]))
    return refuse("the local frame has an invalid unit of length");
  if (!spec.isGeographic) return LocalFrame(spec);
  if (!isPositive(spec.angularUnitRadians) || !std::isfinite(spec.middleLongitude))
    return refuse("the local frame has an invalid unit of angle or an invalid middle longitude");
  if (!isPositive(spec.semiMajorAxisMetres) || !std::isfinite(spec.inverseFlattening) ||
      (spec.inverseFlattening != 0 && spec.inverseFlattening <= 1))
    return refuse("the local frame has an invalid ellipsoid");
  if (std::abs(spec.origin.y * spec.angularUnitRadians) > std::numbers::pi / 2)
    return refuse("the origin of the local frame is beyond the pole");
  return LocalFrame(spec);
}

LocalFrame::LocalFrame(const LocalFrameSpec& spec)
    : spec_(spec), unit_{spec.linearUnitMetres / spec.mapScale[0], spec.linearUnitMetres / spec.mapScale[1]} {
  if (!spec.isGeographic) return;
  degreesPerUnit_ = spec.angularUnitRadians * 180 / std::numbers::pi;
  const double flattening = spec.inverseFlattening == 0 ? 0 : 1 / spec.inverseFlattening;
  const GeographicLib::Geocentric ellipsoid(spec.semiMajorAxisMetres, flattening);
  cartesian_ = std::make_shared<const Cartesian>(Cartesian{GeographicLib::LocalCartesian(
      spec.origin.y * degreesPerUnit_, std::remainder(spec.origin.x * degreesPerUnit_, kTurnDegrees),
      spec.origin.z * spec.verticalUnitMetres, ellipsoid)});
}

Vec3 LocalFrame::toLocal(const Vec3& source) const {
  const Vec3& o = spec_.origin;
  if (!cartesian_)
    return {(source.x - o.x) * unit_.x, (source.y - o.y) * unit_.y,
            (source.z - o.z) * spec_.verticalUnitMetres};
  Vec3 local;
  cartesian_->transform.Forward(source.y * degreesPerUnit_,
                                std::remainder(source.x * degreesPerUnit_, kTurnDegrees),
                                source.z * spec_.verticalUnitMetres, local.x, local.y, local.z);
  return local;
}

Vec3 LocalFrame::toSource(const Vec3& local) const {
  const Vec3& o = spec_.origin;
  if (!cartesian_)
    return {o.x + local.x / unit_.x, o.y + local.y / unit_.y, o.z + local.z / spec_.verticalUnitMetres};
  double latitude = 0, longitude = 0, height = 0;
  cartesian_->transform.Reverse(local.x, local.y, local.z, latitude, longitude, height);
  const double middle = spec_.middleLongitude * degreesPerUnit_;
  longitude = middle + std::remainder(longitude - middle, kTurnDegrees);
  return {longitude / degreesPerUnit_, latitude / degreesPerUnit_, height / spec_.verticalUnitMetres};
}

Vec3 LocalFrame::sourceReach(const Vec3& metres, const Vec3& low, const Vec3& high) const {
  if (!cartesian_) return {metres.x / unit_.x, metres.y / unit_.y, metres.z / spec_.verticalUnitMetres};
  // The smallest radius of curvature of the ellipsoid, less the deepest height.
  const double flattening = spec_.inverseFlattening == 0 ? 0 : 1 / spec_.inverseFlattening;
  const double squeeze = (1 - flattening) * (1 - flattening);
  const double radius = spec_.semiMajorAxisMetres * std::min(squeeze, 1 / squeeze) +
                        std::min(0.0, low.z * spec_.verticalUnitMetres);
  const double degree = std::numbers::pi / 180;
  const double farthestLatitude =
      std::min(90.0, std::max(std::abs(low.y), std::abs(high.y)) * degreesPerUnit_) * degree;
  const double along = std::hypot(metres.x, metres.y, metres.z) / std::max(radius, 1.0);
  // The vertical here differs from that at the origin: horizontal there is partly vertical here.
  const double turn = (std::max(high.x - spec_.origin.x, spec_.origin.x - low.x) +
                       std::max(high.y - spec_.origin.y, spec_.origin.y - low.y)) *
                      spec_.angularUnitRadians;
  const double up = metres.z + (metres.x + metres.y) * std::min(1.0, std::abs(turn));
  const double unit = spec_.angularUnitRadians;
  return {along / std::max(std::cos(farthestLatitude), 1e-12) / unit, along / unit,
          up / spec_.verticalUnitMetres};
}

LocalFrameSpec localFrameSpec(const Georeference& georeference, const Vec3& origin) {
  const bool hasCrs = !georeference.crsWkt.empty();
  return {.origin = origin,
          .isGeographic = hasCrs && georeference.isGeographic,
          .linearUnitMetres = hasCrs && !georeference.isGeographic ? georeference.linearUnitMetres : 1,
          .mapScale = hasCrs && !georeference.isGeographic
                          ? georeference.mapScale.value_or(std::array<double, 2>{1, 1})
                          : std::array<double, 2>{1, 1},
          .verticalUnitMetres = georeference.verticalUnitMetres,
          .angularUnitRadians = georeference.angularUnitRadians,
          .semiMajorAxisMetres = georeference.semiMajorAxisMetres,
          .inverseFlattening = georeference.inverseFlattening,
          .middleLongitude = origin.x};
}

}  // namespace arete

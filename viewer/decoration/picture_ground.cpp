// SPDX-License-Identifier: GPL-3.0-or-later
//
// Lengths are geodesics on the CRS's own ellipsoid, whatever the units and the distortions of the map. North
// is where a short step along the meridian leads in the picture.
#include "viewer/decoration/picture_ground.h"

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "io/geo/crs/prime_meridian.h"

namespace arete {
namespace {

bool isFinite(Vec2 p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

GeographicLib::Geodesic geodesicOf(const Georeference& georeference) {
  const double inverse = georeference.inverseFlattening;
  return {georeference.semiMajorAxisMetres, inverse == 0 ? 0 : 1 / inverse};
}

/// Of a direction on the map, from its y axis clockwise.
double bearingOnMap(Vec2 way) {
  return std::atan2(way.x, way.y) * 180 / std::numbers::pi;
}

constexpr double kPoleDegrees = 1e-6;  // a tenth of a metre: nearer to the pole, every direction is south

}  // namespace

PictureGround::PictureGround(Parts parts) : parts_(std::move(parts)) {
  if (!parts_.toLevelPixel) parts_.toLevelPixel = parts_.toPixel;
  if (!hasCrs()) return;
  // Not every CRS has longitudes: a building site has none.
  if (auto made = CrsLonLat::of(parts_.georeference))
    lonLat_ = std::make_shared<const CrsLonLat>(std::move(*made));
  primeMeridian_ = primeMeridianOf(parts_.georeference.crsWkt);
}

Vec2 PictureGround::toCrs(Vec2 lonLat) const {
  lonLat.x -= primeMeridian_;
  lonLat_->toCrs({&lonLat, 1});
  return lonLat;
}

PictureGround PictureGround::ofMap(const MapView& view, const Georeference& georeference, Vec2 leftTop) {
  Parts parts;
  parts.georeference = georeference;
  parts.frame = {leftTop.x, leftTop.y, double(view.width), double(view.height)};
  parts.toSource = [view, georeference, leftTop](Vec2 pixel) -> std::optional<Vec2> {
    const Vec2 grid = view.toGrid(pixel.x - leftTop.x, pixel.y - leftTop.y);
    return georeference.toSource(grid.x, grid.y);
  };
  parts.toPixel = [view, georeference, leftTop](Vec2 source) -> std::optional<Vec2> {
    if (georeference.determinant() == 0) return {};
    const Vec2 grid = georeference.toGrid(source.x, source.y);
    return view.toPixel(grid.x, grid.y) + leftTop;
  };
  return PictureGround(std::move(parts));
}

std::optional<Vec2> PictureGround::lonLatOf(Vec2 source) const {
  if (!lonLat_) return {};
  lonLat_->toLonLat({&source, 1});
  if (!isFinite(source) || std::abs(source.y) > 90) return {};
  return Vec2{source.x + primeMeridian_, source.y};
}

std::optional<Vec2> PictureGround::lonLatAt(Vec2 pixel) const {
  const auto source = sourceAt(pixel);
  return source ? lonLatOf(*source) : std::nullopt;
}

std::optional<Vec2> PictureGround::pixelOf(Vec2 lonLat) const {
  if (!lonLat_) return {};
  const Vec2 source = toCrs(lonLat);
  if (!isFinite(source)) return {};
  const auto pixel = parts_.toPixel(source);
  return pixel && isFinite(*pixel) ? pixel : std::nullopt;
}

std::optional<double> PictureGround::length(Vec2 from, Vec2 to) const {
  if (lonLat_) {
    const auto a = lonLatOf(from), b = lonLatOf(to);
    if (!a || !b) return {};
    double metres = 0;
    geodesicOf(parts_.georeference).Inverse(a->y, a->x, b->y, b->x, metres);
    return metres;
  }
  const double unit =
      hasCrs() && !parts_.georeference.isGeographic ? parts_.georeference.linearUnitMetres : 1;
  return std::hypot(to.x - from.x, to.y - from.y) * unit;
}

std::optional<double> PictureGround::lengthPerPixel(Vec2 pixel) const {
  if (parts_.lengthPerPixel) return parts_.lengthPerPixel(pixel);
  if (parts_.acrossPixel) {
    const auto ends = parts_.acrossPixel(pixel);
    return ends ? length(ends->first, ends->second) : std::nullopt;
  }
  // The step is long enough that rounding leaves six digits, short enough that the scale is that of the
  // place.
  const double step = std::max(1.0, parts_.frame.width / 512);
  const auto a = sourceAt({pixel.x - step, pixel.y}), b = sourceAt({pixel.x + step, pixel.y});
  if (!a || !b) return {};
  const auto metres = length(*a, *b);
  if (!metres || !(*metres > 0) || !std::isfinite(*metres)) return {};
  return *metres / (2 * step);
}

std::optional<PictureGround::North> PictureGround::northAt(Vec2 pixel) const {
  if (!hasCrs()) return {};
  const bool hasWay = static_cast<bool>(parts_.wayOfStep);
  auto here = sourceAt(pixel);
  auto scale = lengthPerPixel(pixel);
  if (hasWay && !here) here = parts_.eye;
  if (hasWay && !scale) scale = 1;
  if (!here) return {};
  const auto from = hasWay ? Vec2{} : parts_.toLevelPixel(*here);
  if (!from || !isFinite(*from)) return {};
  const auto towards = [&](Vec2 source) -> std::optional<Vec2> {
    const auto to = hasWay ? parts_.wayOfStep(*here, source) : parts_.toLevelPixel(source);
    if (!to || !isFinite(*to)) return {};
    const Vec2 way = *to - *from;
    return std::hypot(way.x, way.y) > 0 ? std::optional(unit(way)) : std::nullopt;
  };
  // The map's north: a few pixels along its y axis.
  std::optional<Vec2> gridNorth;
  if (hasWay) {
    gridNorth = towards({here->x, here->y + 1});
  } else if (const auto beside = sourceAt({pixel.x + 1, pixel.y})) {
    const double step = 2 * std::hypot(beside->x - here->x, beside->y - here->y);
    gridNorth = towards({here->x, here->y + step});
  }
  if (const auto place = lonLatOf(*here); place && scale && std::abs(place->y) < 90 - kPoleDegrees) {
    const double metres = std::min(2 * *scale, parts_.georeference.semiMajorAxisMetres / 100);
    // Away from the nearer pole and turned round, or the step might lead over the pole.
    const double sign = place->y > 0 ? -1 : 1;
    double latitude = 0, longitude = 0;
    geodesicOf(parts_.georeference)
        .Direct(place->y, place->x, sign < 0 ? 180 : 0, metres, latitude, longitude);
    // Both ends are on one meridian, and a plain longitude keeps its turn.
    const Vec2 source = toCrs({place->x, latitude});
    if (isFinite(source))
      if (const auto way = towards(source))
        return North{*way * sign, true, -bearingOnMap((source - *here) * sign)};
  }
  if (gridNorth) return North{*gridNorth, false, 0};
  return {};
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Maps of many coordinate systems for the tests of decorations.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "terrain/model/georeference.h"
#include "viewer/decoration/picture_ground.h"
#include "viewer/picture/map_view.h"

namespace arete::test {

/// A north-up raster of `side` x `side` samples, `cell` apart, about a middle.
inline Georeference mapAbout(const std::string& crs, Vec2 middle, double cell, std::uint32_t side = 101) {
  Georeference g;
  g.hasGeoTransform = true;
  const double half = cell * side / 2;
  g.geoTransform = {middle.x - half, cell, 0, middle.y + half, 0, -cell};
  g.crsWkt = crs;
  g.semiMajorAxisMetres = 6378137;
  g.inverseFlattening = 298.257223563;
  return g;
}

inline Georeference degreesAbout(Vec2 middle, double cell, std::uint32_t side = 101) {
  Georeference g = mapAbout("EPSG:4326", middle, cell, side);
  g.isGeographic = true;
  return g;
}

/// The picture of such a map, at most `pixels` wide and high, somewhere on a canvas.
inline PictureGround pictureOf(const Georeference& georeference, int pixels = 800, std::uint32_t side = 101) {
  return PictureGround::ofMap(fitGrid(side, side, georeference, pixels, pixels), georeference, {30, 20});
}

inline Vec2 middleOf(const PictureGround& ground) {
  const Rect& f = ground.frame();
  return {f.left + f.width / 2, f.top + f.height / 2};
}

/// Looks down at a plane without a CRS, or with one, from (0, -200, 100); the horizon crosses the picture.
inline PictureGround obliqueView(const std::string& crs, double pitchDegrees) {
  const double pitch = pitchDegrees * std::numbers::pi / 180, focal = 500;
  PictureGround::Parts parts;
  parts.georeference = mapAbout(crs, {500000, 5000000}, 1);
  parts.frame = {0, 0, 800, 600};
  parts.isPerspective = true;
  const Vec2 origin = {500000, 5000000};
  constexpr double kUp = 100;
  parts.toSource = [=](Vec2 pixel) -> std::optional<Vec2> {
    const double x = (pixel.x - 400) / focal, y = (300 - pixel.y) / focal;
    const double forward = std::cos(pitch) - y * std::sin(pitch), up = std::sin(pitch) + y * std::cos(pitch);
    if (up >= -1e-3) return {};
    const double t = kUp / -up;
    return Vec2{origin.x + x * t, origin.y - 200 + forward * t};
  };
  parts.toPixel = [=](Vec2 source) -> std::optional<Vec2> {
    const double x = source.x - origin.x, y = source.y - origin.y + 200;
    const double depth = y * std::cos(pitch) - kUp * std::sin(pitch);
    if (depth <= 1) return {};
    const double up = -kUp * std::cos(pitch) - y * std::sin(pitch);
    return Vec2{400 + focal * x / depth, 300 - focal * up / depth};
  };
  return PictureGround(std::move(parts));
}

}  // namespace arete::test

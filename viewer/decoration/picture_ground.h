// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "engine/base/vec.h"
#include "io/geo/crs/lonlat.h"
#include "terrain/model/georeference.h"
#include "viewer/picture/map_view.h"
#include "viewer/picture/picture.h"

namespace arete {

/// Where the pixels of a picture are on the ground, and where the ground is in the picture: all that scale
/// bar, north arrow and graticule need, of a flat map or of a view in perspective. Pixels are the canvas's;
/// ground positions are source coordinates (in the CRS), or longitude and latitude in degrees.
class PictureGround {
 public:
  using Mapping = std::function<std::optional<Vec2>(Vec2)>;

  struct Parts {
    Georeference georeference = {};
    Rect frame = {};        ///< of the picture on the canvas
    Mapping toSource = {};  ///< of a pixel; nothing where it shows no ground
    Mapping toPixel = {};   ///< of a source position; nothing where it is behind the eye, or hidden
    /// Of a source position on the level plane through the middle of the picture; empty: toPixel.
    Mapping toLevelPixel = {};
    bool isPerspective = false;  ///< the scale differs from place to place
    bool statesPixel = false;    ///< the scale bar says what length a pixel has
    std::string unit = "units";  ///< of source coordinates without a CRS, after a number
    /// Lengths on the ground of one pixel at a pixel, across the picture, in metres (source units without a
    /// CRS); empty: of the ground at the pixels beside it.
    std::function<std::optional<double>(Vec2)> lengthPerPixel = {};
    /// Instead of it: two source positions, the width of a pixel apart across the picture.
    std::function<std::optional<std::pair<Vec2, Vec2>>(Vec2)> acrossPixel = {};
    /// How a level step between two source positions points in a picture that may show no ground; empty: as
    /// toLevelPixel. With it, the source position of the eye.
    std::function<Vec2(Vec2, Vec2)> wayOfStep = {};
    Vec2 eye = {};
  };

  explicit PictureGround(Parts parts);

  /// A flat map whose left top corner is at `leftTop` of the canvas.
  static PictureGround ofMap(const MapView& view, const Georeference& georeference, Vec2 leftTop);

  const Rect& frame() const { return parts_.frame; }
  bool isPerspective() const { return parts_.isPerspective; }
  bool statesPixel() const { return parts_.statesPixel; }
  const Georeference& georeference() const { return parts_.georeference; }
  const std::string& unitName() const { return parts_.unit; }
  bool hasCrs() const { return !parts_.georeference.crsWkt.empty(); }
  /// Whether places have longitude and latitude: of a CRS of the Earth, or of another body.
  bool hasLonLat() const { return lonLat_ != nullptr; }
  /// Whether longitudes may go on past half a turn, as in a DEM of longitudes from 0 to 360.
  bool hasPlainLongitudes() const { return lonLat_ && lonLat_->isPlain(); }

  std::optional<Vec2> sourceAt(Vec2 pixel) const { return parts_.toSource(pixel); }
  /// Of the CRS's own datum, in degrees; longitudes from Greenwich, whatever its prime meridian.
  std::optional<Vec2> lonLatOf(Vec2 source) const;
  std::optional<Vec2> lonLatAt(Vec2 pixel) const;
  std::optional<Vec2> pixelOf(Vec2 lonLat) const;

  /// The length of the ground between two source positions: a geodesic in metres [Karney2013] where there
  /// are longitudes and latitudes, else straight, in metres with a CRS and in source units without.
  std::optional<double> length(Vec2 from, Vec2 to) const;
  /// The length on the ground that a pixel at `pixel` is wide.
  std::optional<double> lengthPerPixel(Vec2 pixel) const;

  /// The direction of north in the picture at a pixel, as a unit vector (y points down).
  struct North {
    Vec2 toNorth = {};
    bool isTrue = true;  ///< false: along the grid of the map, which is all that is known
    /// Degrees from true north clockwise to the map's north; 0 where the map's axes are longitude and
    /// latitude.
    double convergenceDegrees = 0;
  };
  /// Nothing without a CRS, and where no direction is north. In a view that shows no ground there: at the
  /// eye.
  std::optional<North> northAt(Vec2 pixel) const;

 private:
  /// Source coordinates; not finite where the CRS does not reach.
  Vec2 toCrs(Vec2 lonLat) const;

  Parts parts_;
  std::shared_ptr<const CrsLonLat> lonLat_;
  double primeMeridian_ = 0;  // degrees east of Greenwich
};

}  // namespace arete

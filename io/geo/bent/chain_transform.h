// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ogr_geometry.h>
#include <ogr_spatialref.h>

#include <limits>
#include <memory>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "io/geo/crs/chain_projection.h"

namespace arete {

/// Brings chains of straight edges from one CRS into another, in GIS axis order
/// (io/geo/crs/chain_projection.h). Not thread-safe.
class ChainTransform {
 public:
  /// The identity.
  ChainTransform() = default;

  enum class Ballpark { allowed, refused };
  /// @param deviation how far an edge may be from its image, in the unit of the source, beside the part of
  /// its length that ChainProjection allows.
  /// @param ballpark refused: as CrsTransform::between() refuses it.
  /// Errors: invalidData: PROJ knows no way between the two; unsupported: a geocentric target.
  static Result<ChainTransform> between(const OGRSpatialReference& source, const OGRSpatialReference& target,
                                        double deviation = std::numeric_limits<double>::infinity(),
                                        Ballpark ballpark = Ballpark::allowed);

  bool isIdentity() const { return there_ == nullptr; }
  /// By which x of the target may be shifted (turnOf()); 0: none.
  double turn() const { return chains_.turn; }

  /// Errors: invalidData: a vertex is outside the domain of the target, or a seam of it tears an edge.
  Result<std::vector<Vec2>> operator()(const std::vector<Vec2>& chain, bool isRing) const;

 private:
  struct Closer {
    void operator()(OGRCoordinateTransformation* t) const { OGRCoordinateTransformation::DestroyCT(t); }
  };
  using TransformationPtr = std::unique_ptr<OGRCoordinateTransformation, Closer>;

  TransformationPtr there_, back_;
  ChainProjection chains_;
};

/// A turn of the x of a geographic CRS; 0 of others.
double turnOfDegrees(const OGRSpatialReference& crs);

/// Whether an edge leads over more than half a turn, as where a shape that crosses the antimeridian is not
/// cut there. Edges along whole turns, which a box around the Earth has, are meant.
bool leadsTheLongWay(double way, double turn);

/// Leads a line the short way where an edge leads the long way. Nothing changes without a turn.
void takeShortWays(std::vector<Vec2>& line, double turn);

}  // namespace arete

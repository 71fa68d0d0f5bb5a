// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "io/geo/bent/chain_transform.h"
#include "io/geo/crs/longitude_turns.h"
#include "io/geo/features/feature_layer.h"

namespace arete {

/// Leads places and lines from the coordinates of a file onto a DEM, and counts what cannot be led there.
class ChainPlacer {
 public:
  /// @param sourceTurn of the file's longitudes; 0 where x is not a longitude.
  /// @param swapsAxes the file states y before x.
  ChainPlacer(ChainTransform transform, LongitudeTurns turns, double sourceTurn, bool swapsAxes)
      : transform_(std::move(transform)), turns_(std::move(turns)), turn_(sourceTurn), swaps_(swapsAxes) {}

  /// @return nothing for a place that is not finite or that the DEM's CRS cannot tell.
  std::optional<Vec2> place(Vec2 xy);

  /// Appends a line to the layer: in several pieces where vertices or edges of it are left out, and once for
  /// each turn of longitudes by which it meets the DEM. Nothing is appended of a line without length.
  ///
  /// @param z as many as vertices; NaN without.
  /// @return the longest of the pieces by its number of vertices; nothing where all of it is left out.
  std::optional<std::uint64_t> addLine(std::span<const Vec2> line, std::span<const double> z,
                                       FeatureLayer& layer);

  std::uint64_t notFinite() const { return notFinite_; }    ///< places and vertices
  std::uint64_t outOfReach() const { return outOfReach_; }  ///< places and edges outside the CRS's domain

 private:
  struct Piece {
    std::vector<Vec2> xy;
    std::vector<double> z;
  };
  void addPiece(const Piece& piece, FeatureLayer& layer, std::optional<std::uint64_t>& longest);
  std::vector<Piece> transformed(const Piece& piece);

  ChainTransform transform_;
  LongitudeTurns turns_;
  double turn_;
  bool swaps_;
  std::uint64_t notFinite_ = 0, outOfReach_ = 0;
};

}  // namespace arete

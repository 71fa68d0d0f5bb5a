// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>
#include <vector>

#include "engine/simplify/live_mesh.h"
#include "surface/error/attribute_bound.h"
#include "surface/error/piece_division.h"
#include "surface/simplify/fans.h"
#include "surface/simplify/state.h"

namespace arete {

/// Removes vertices, on one thread.
class SurfaceRemover {
 public:
  explicit SurfaceRemover(SurfaceState& state)
      : s_(state),
        division_(state.original, state.field),
        attributeBound_(state.original, state.field, state.attributeDistances) {}

  /// Removes v, whose cost is known exactly: fills the hole with the fan of its record, divides the pieces,
  /// records the modification, rewrites the star, updates the records of its link.
  /// @param seams one for each vertex of the link, filled in; the caller joins them.
  /// @return whether the star was open.
  bool remove(VertexId v, RemovalId removal, std::span<Seam> seams);

 private:
  void dividePieces(const HoleTriangulation& floor);
  void record(RemovalId removal, int floorSize);
  void gatherAcross();
  void boundAttributes(const HoleTriangulation& floor);
  double rmsOf(const HoleTriangulation& floor, int f);
  void updateLink();

  SurfaceState& s_;
  SurfaceHole hole_;
  PieceDivision division_;
  AttributeBound attributeBound_;
  std::vector<double> attributeErrors_, wanted_, found_;
  std::vector<SurfaceSample> samples_;
  std::array<double, kMaxHoleCorners> rms_{};
  std::vector<std::array<std::uint32_t, 3>> drawn_;  // by triangle of the floor
  std::vector<AcrossSide> rimSides_;                 // of the star's rim: what is across, by link corner
  std::array<FloorCodes, kMaxHoleCorners> codes_;
  std::array<RecorderId, kMaxHoleCorners> ceiling_;
  std::array<RemovalId, kMaxHoleCorners> creator_;
  std::array<Vec3, kMaxHoleCorners + 1> metric_;
  std::array<TriangleLabels, kMaxHoleCorners> labels_;
};

}  // namespace arete

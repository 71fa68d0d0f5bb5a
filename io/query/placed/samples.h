// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "engine/base/vec.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/georeference.h"

namespace arete::placed {

/// A sample of a DEM, and what a TIN has there.
struct PlacedSample {
  std::uint64_t index = 0;                                ///< in the DEM
  Vec2 source;                                            ///< its plan position in the DEM
  double height = 0;                                      ///< of the DEM; NaN of NODATA
  double tin = std::numeric_limits<double>::quiet_NaN();  ///< of the TIN, in the DEM's unit
  std::uint32_t triangle = 0;
  std::uint8_t holders = 0;  ///< triangles that it is strictly inside of; 2: or more
};

/// A side of a triangle that no other triangle has.
struct RimSide {
  std::uint32_t triangle = 0, from = 0, to = 0;
};
/// O(n log n).
std::vector<RimSide> rimOf(const TriangleMesh& mesh);

/// The ends of a side as a sample sees them: x and y on the level plane through it, and heights in the DEM's
/// unit.
using SideSeen = std::function<std::pair<Vec3, Vec3>(std::size_t sample, const RimSide& side)>;

/// Gives samples that no triangle holds the height at the nearest point of the rim, if it is not farther
/// than `most`. O(n log n + pairs that are near).
/// @param places  of the samples, in the plan of which `plan` has the vertices
/// @param reach   how far in that plan a sample may be from a side that is near to it
/// @param turn    x of the plan is known up to multiples of this; 0: it is known
void coverBesideRim(std::vector<PlacedSample>& samples, std::span<const Vec2> places,
                    const std::vector<RimSide>& rim, std::span<const Vec2> plan, Vec2 reach, double turn,
                    double most, const SideSeen& seen);

/// Fills what a TIN in metres has at each sample (measure_metric.cpp).
/// @param pixel  a step between samples in the DEM's coordinates
/// @return the TIN's area in the plan, in square metres
/// Errors: as LocalFrame::create(); unsupported: the DEM has no longitude and latitude. interrupted.
Result<double> findInMetres(const TriangleMesh& mesh, const Vec3& about, const Georeference& dem, Vec2 pixel,
                            std::vector<PlacedSample>& samples, const RunContext& context);

}  // namespace arete::placed

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "engine/base/result.h"
#include "surface/model/surface_model.h"
#include "viewer/scene/layer.h"

namespace arete {

/// Colours of the drawn vertices of a surface (viewer/fronts/drawn_vertices.h), 4 bytes each, and what they
/// mean.
struct ComputedColors {
  std::vector<std::uint8_t> colors;
  Legend legend;
};

/// A colour for each chart: what hangs together without crossing a seam or an edge between parts. Charts that
/// meet may have the same colour where there are more than the table has. Errors: usage: the surface has no
/// lines, or an earlier version built it, whose lines are not known. O(n log n).
Result<ComputedColors> chartColors(const SurfaceModel& model);

/// How much a picture is stretched: of each vertex the mean over its faces of the source of the area that
/// they cover on the surface for their area in the picture, as a part of the whole's mean, on a scale of
/// octaves from an eighth (blue: dense) to eight times (brown: stretched). Vertices whose faces have none in
/// the picture count as the most stretched. Errors: usage: no texture coordinates. O(n).
Result<ComputedColors> stretchColors(const SurfaceModel& model);

}  // namespace arete

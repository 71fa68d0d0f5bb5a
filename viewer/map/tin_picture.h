// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "engine/base/result.h"
#include "engine/base/triangle_mesh.h"
#include "terrain/model/heightfield.h"
#include "viewer/picture/picture.h"

namespace arete {

struct TinPictureOptions {
  int width = 1600;  ///< pixels
  std::string title = {};
  /// Figures for the caption, in the DEM's vertical unit; omitted if empty.
  std::optional<double> tolerance = {};
  std::optional<double> measuredError = {};
  /// Triangles of the finest triangulation, for the percentage in the caption.
  std::optional<std::size_t> finestTriangles = {};
  /// A detail four times as large, where the triangles are too small to be seen.
  bool detail = true;
  bool isDecorated = true;  ///< with scale bar, north arrow and graticule
};

/// Draws a TIN's edges over the shaded relief of its DEM. Where edges are denser than pixels they fade to a
/// grey that shows their density, and a detail shows the structure where vertices are densest. `tin` in
/// source coordinates (an empty one draws the relief alone). Errors: those of makeMapPage() and
/// TriangleMesh::validate(). O(samples + triangles log triangles).
Result<Canvas> drawTin(const RasterHeightfield& ground, const TriangleMesh& tin,
                       const TinPictureOptions& options = {});

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"

namespace arete {

/// A published DEM that can be read over https.
struct PublicDem {
  std::string_view name;     ///< as a command names it
  std::string_view summary;  ///< what it is, in a line
  std::string_view licence;  ///< what its publisher asks
  std::string_view page;     ///< where the publisher describes it

  /// A URL. "{N00}" and "{E000}" stand for the whole degrees of a tile's lower left corner ("S07", "W112"); a
  /// URL without them is one raster or mosaic for everything.
  std::string_view url;
  std::string_view reader;  ///< what GDAL's path to the URL starts with: "/vsicurl/", "/vsigzip//vsicurl/"

  double pixelDegrees;
  int bytesPerSample;
  std::optional<Box2> scene;  ///< longitude and latitude of a view worth seeing; none for a whole collection

  bool isTiled() const { return url.find('{') != std::string_view::npos; }
};

/// Collections first, then scenes cut from them. Names are unique.
std::span<const PublicDem> publicDems();

/// Errors: usage, with the names there are.
Result<PublicDem> findPublicDem(std::string_view name);

/// Bytes of the samples in a box, uncompressed.
double sampleBytes(const PublicDem& dem, const Box2& degrees);

/// GDAL's paths of the rasters that cover a box, west to east, then south to north. A `mirror`, a folder or a
/// URL that holds the same paths, takes the place of the publisher's host. Errors: usage (a box without area
/// or beyond the globe, more than 64 tiles).
Result<std::vector<std::string>> rasterPaths(const PublicDem& dem, const Box2& degrees,
                                             std::string_view mirror = {});

}  // namespace arete

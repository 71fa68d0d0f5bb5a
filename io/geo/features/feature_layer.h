// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "engine/base/warning.h"
#include "engine/parallel/run_context.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// What a layer of a vector file holds, in the source coordinates of a DEM.
struct FeatureLayer {
  static constexpr std::uint64_t kNoLine = std::numeric_limits<std::uint64_t>::max();
  static constexpr std::uint64_t kNoPolygon = kNoLine;

  struct Place {
    Vec2 xy;
    double z = std::numeric_limits<double>::quiet_NaN();  ///< in the DEM's vertical unit; NaN without one
  };
  /// Straight edges between `count` vertices, from vertex `first` on. Outlines of polygons end where they
  /// begin.
  struct Line {
    std::uint64_t first = 0, count = 0;
    std::uint64_t polygon = kNoPolygon;  ///< whose ring it is, whole; rings of one polygon follow one another
  };
  struct Label {
    std::string text;                    ///< UTF-8, one line
    Place at = {};                       ///< of a point
    std::uint64_t line = kNoLine;        ///< else the label belongs to this line, wherever along it
    std::uint64_t polygon = kNoPolygon;  ///< or to this polygon, the largest of its feature
    std::uint64_t firstPolygon = 0, endPolygon = 0;  ///< then all of its feature
  };

  std::string name;
  std::vector<Place> points;
  std::vector<Vec2> vertices;  ///< of all lines
  std::vector<double> z;       ///< of the vertices; empty where none has one
  std::vector<Line> lines;     ///< of at least two vertices
  std::vector<Label> labels;
  std::uint64_t features = 0, polygons = 0;  ///< that were read
  Warnings warnings;
};

struct FeatureReadOptions {
  std::string layer = {};  ///< needed where a file has several that hold something
  std::string label = {};  ///< the field with the texts of labels; empty: no labels
  std::string where = {};  ///< a condition of SQL that features meet; no table of points in text has any
  std::string crs = {};    ///< in place of the file's; any text that crsFromUser() accepts
  /// A file with more is refused. A vertex takes 16 bytes, 24 with a z.
  std::uint64_t mostVertices = 20'000'000;
};

/// Reads a layer of any vector format that GDAL reads, or points from text as readPointTable(). Points, lines
/// and outlines of polygons are taken, from collections too; curves become straight edges. Coordinates are
/// led into the DEM's CRS, in GIS axis order; an edge is split until it is within a tenth of the DEM's
/// spacing of where the CRS of the file leads it straight. Whole turns of longitude are added where that
/// brings a line or a point onto the DEM, and a line over more than half a turn is led the short way. Without
/// a CRS the coordinates are the DEM's; columns of a text that are named longitude and latitude are taken as
/// WGS 84 if the DEM has other coordinates. Heights (z) are in the vertical unit of the file's CRS; where it
/// has none, in metres if its coordinates are longitude and latitude, and in the DEM's unit else. Warnings
/// count what is left out: places that are not finite or outside the domain of the DEM's CRS (a line is cut
/// there), features without a geometry, other geometries; and say where a transformation takes two datums for
/// one.
///
/// In a GPX file the layers of track and route points, which repeat the vertices of lines, are read only by
/// name.
///
/// Errors, with the file as culprit: notFound, unreadable, corrupt; unsupported: no layer with geometries,
/// several (the message lists them), more vertices than allowed; notFound: no such layer or field (lists
/// them); invalidData: nothing to draw, a file with a CRS on a DEM without, no way between the two; usage:
/// options.crs or options.where makes no sense; interrupted; outOfMemory. O(vertices of the result).
Result<FeatureLayer> readFeatures(const std::string& path, const TerrainModel& model,
                                  const FeatureReadOptions& options = {}, const RunContext& context = {});

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/vec.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// The pixels of a dataset over a terrain: the grid of the source, or one of cells (cellGridOf()). Pixel
/// coordinates are GDAL's: the first pixel is from 0 to 1.
struct PixelGrid {
  int columns = 0, rows = 0;
  std::array<double, 6> geoTransform{};  ///< from pixel to source coordinates

  /// The grid of the source; with `cell` one of square pixels. Errors: those of cellGridOf().
  /// Preconditions: the outline outlives it; `cell` for points.
  static Result<PixelGrid> of(const TerrainModel& outline, std::optional<double> cell);

  /// From plan to pixel coordinates.
  Vec2 pixelOf(Vec2 plan) const;
  bool isOfSource() const { return isOfSource_; }
  /// The plan's box around a window of pixels.
  Box2 planBoxOf(double left, double top, double right, double bottom) const;

 private:
  const TerrainModel* model_ = nullptr;
  bool isOfSource_ = false;  // pixel coordinates are plan coordinates and a half
};

/// A window of a grid in pixel coordinates, and the samples asked for: the middles of columns x rows equal
/// parts.
struct PixelWindow {
  double left = 0, top = 0, width = 0, height = 0;
  int columns = 0, rows = 0;
};

/// A triangulated terrain over a grid.
struct GridTriangles {
  struct Corner {
    Vec2 pixel;
    double height;
  };
  std::vector<Corner> corners;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The triangles of a cut by where they are, so that those of a window are found. O(triangles).
class TriangleBins {
 public:
  TriangleBins() = default;
  explicit TriangleBins(GridTriangles triangles);

  /// Fills the samples of a window, row by row, with the heights of the triangles over them, each at its own
  /// place; NaN where there is none. Heights at corners are the corners', to the bit.
  /// O(samples + triangles near the window).
  ///
  /// @param stride from a row of `heights` to the next; at least window.columns
  void fill(const PixelWindow& window, std::span<double> heights, std::size_t stride) const;
  void fill(const PixelWindow& window, std::span<double> heights) const {
    fill(window, heights, static_cast<std::size_t>(window.columns));
  }
  std::size_t size() const { return triangles_.triangles.size(); }

 private:
  GridTriangles triangles_;
  double left_ = 0, top_ = 0, width_ = 1, height_ = 1;  // of the box of all corners
  int across_ = 0, down_ = 0;                           // bins
  std::vector<std::uint32_t> begin_, members_;
};

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "engine/cut/cut.h"
#include "gis/driver/pixel_grid.h"
#include "io/store/amt/file.h"
#include "terrain/model/terrain_model.h"

namespace arete {

/// An .amt file of terrain, and its cuts over a grid of pixels. Only what a cut needs is read.
class TerrainCuts {
 public:
  /// Errors: those of openAmt() and AmtFile::read(), and of PixelGrid::of().
  static Result<TerrainCuts> open(AmtContainer container, double tolerance, std::optional<double> cell);

  double tolerance() const { return tolerance_; }
  /// The model's root, with everything that is not of its triangles.
  const TerrainModel& outline() const { return *outline_; }
  const PixelGrid& grid() const { return grid_; }

  /// Overview k has about 2^-k as many columns and rows as the grid; 0 is the grid. The error of its cut: the
  /// tolerance, and of overviews what the model has beyond as many nodes as they have pixels.
  double errorOfOverview(int k) const;

  /// The whole cut with its model.
  struct Whole {
    TerrainModel model;
    Cut cut;
  };
  /// Errors: those of AmtFile::read() and takeCut().
  Result<Whole> take(double error) const;

  /// Fills the samples of a window (TriangleBins::fill()) with the cut whose error is at most `error`; a
  /// sample at the place of an isolated one has its height. Cuts with an error are taken once and kept;
  /// without one only the part that the window needs is read: of a small window in tiles of the grid, of
  /// which the last ones are kept, because programs read row by row.
  Status fill(const PixelWindow& window, double error, std::span<double> heights);

 private:
  explicit TerrainCuts(AmtFile file) : file_(std::move(file)) {}
  double spacingOfPoints() const;
  /// Triangles of vertices of a model.
  struct FrontOf {
    const TerrainModel& model;
    std::span<const std::uint32_t> vertices;
    std::span<const std::array<std::uint32_t, 3>> triangles;  // by position in `vertices`
  };
  /// Those that touch a box of pixels, moved by so many columns of the source.
  void addOnGrid(const FrontOf& front, const Box2& pixels, double columns, GridTriangles& to) const;
  /// Columns of the source once round the Earth, on a grid of cells that may begin before its first one; 0
  /// where that is not so.
  double turn() const;
  struct Tile {
    int column = 0, row = 0;
    std::shared_ptr<const TriangleBins> triangles;
  };
  Result<TriangleBins> finestIn(const PixelWindow& window) const;
  Result<std::shared_ptr<const TriangleBins>> tile(int column, int row);
  Status fillWithFinest(const PixelWindow& window, std::span<double> heights, bool isByTiles);
  Status fillWithCut(const PixelWindow& window, double error, std::span<double> heights);
  void addIsolated(const PixelWindow& window, std::span<double> heights) const;

  AmtFile file_;
  std::shared_ptr<const TerrainModel> outline_;  // the grid refers to it
  PixelGrid grid_;
  double tolerance_ = 0;
  std::vector<std::pair<double, TriangleBins>> kept_;  // by error
  std::deque<Tile> tiles_;                             // of the finest triangles, the last used first
};

}  // namespace arete

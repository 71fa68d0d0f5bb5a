// SPDX-License-Identifier: GPL-3.0-or-later
#include "gis/driver/terrain_cuts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/base/caught_failure.h"
#include "engine/criteria/criterion.h"
#include "engine/parallel/guest_work.h"
#include "io/query/extract/query_footprint.h"
#include "terrain/model/plan_box.h"

namespace arete {
namespace {

/// Cuts that are kept: an overview is read many times, then another.
constexpr std::size_t kMostKept = 4;
/// Side of a tile in pixels, and how many triangles all that are kept may have.
constexpr int kTile = 256;
constexpr std::size_t kMostTriangles = 4'000'000;

bool meet(const Box2& a, const Box2& b) {
  return a.xMin <= b.xMax && b.xMin <= a.xMax && a.yMin <= b.yMax && b.yMin <= a.yMax;
}

}  // namespace

Result<TerrainCuts> TerrainCuts::open(AmtContainer container, double tolerance,
                                      std::optional<double> cell) try {
  ARETE_TRY(AmtFile file, openAmt(std::move(container)));
  ARETE_TRY(TerrainModel outline, runAsGuest([&] { return file.read({.wanted = requiredNowhere()}); }));
  TerrainCuts cuts(std::move(file));
  cuts.outline_ = std::make_shared<const TerrainModel>(std::move(outline));
  cuts.tolerance_ = tolerance;
  // Points have no pixels of their own, so their mean spacing makes the size.
  if (!cell && !cuts.outline_->isRaster) cell = cuts.spacingOfPoints();
  ARETE_TRY(PixelGrid grid, PixelGrid::of(*cuts.outline_, cell));
  cuts.grid_ = grid;
  return cuts;
} catch (...) {
  return caughtFailure();
}

double TerrainCuts::spacingOfPoints() const {
  const Box2 box = planBox(*outline_);
  return std::sqrt((box.xMax - box.xMin) * (box.yMax - box.yMin) / double(file_.nodeCount() + 1));
}

double TerrainCuts::errorOfOverview(int k) const {
  if (k <= 0) return tolerance_;
  const double pixels = double(grid_.columns) * double(grid_.rows) * std::ldexp(1.0, -2 * k);
  // An overview of fewer pixels than nodes needs no more nodes than it has pixels.
  if (pixels >= double(file_.nodeCount())) return tolerance_;
  return std::max(tolerance_, file_.errorBeyond(static_cast<std::uint64_t>(std::max(1.0, pixels))));
}

Result<TerrainCuts::Whole> TerrainCuts::take(double error) const {
  return runAsGuest([&]() -> Result<Whole> {
    ARETE_TRY(TerrainModel model, file_.read({.wanted = [error](const Box3&) { return error; }}));
    ARETE_TRY(Cut cut, takeCut(model.mt, UniformError(error)));
    return Whole{std::move(model), std::move(cut)};
  });
}

double TerrainCuts::turn() const {
  return !grid_.isOfSource() && outline_->georeference.repeatsFirstColumn ? outline_->columns - 1.0 : 0;
}

void TerrainCuts::addOnGrid(const FrontOf& front, const Box2& pixels, double columns,
                            GridTriangles& to) const {
  std::vector<Vec2> places;
  places.reserve(front.vertices.size());
  const auto at = [&](std::uint32_t v) { return front.model.mt.position(VertexId(front.vertices[v])); };
  for (std::uint32_t v = 0; v < front.vertices.size(); ++v)
    places.push_back(grid_.pixelOf({at(v).x + columns, at(v).y}));
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  // Only corners of triangles that meet the pixels are taken.
  std::vector<std::uint32_t> cornerOf(places.size(), kNone);
  for (const auto& t : front.triangles) {
    const auto [xMin, xMax] = std::minmax({places[t[0]].x, places[t[1]].x, places[t[2]].x});
    const auto [yMin, yMax] = std::minmax({places[t[0]].y, places[t[1]].y, places[t[2]].y});
    if (!meet({xMin, yMin, xMax, yMax}, pixels)) continue;
    auto& corners = to.triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint32_t& corner = cornerOf[t[i]];
      if (corner == kNone) {
        corner = static_cast<std::uint32_t>(to.corners.size());
        to.corners.push_back({places[t[i]], at(t[i]).z});
      }
      corners[i] = corner;
    }
  }
}

Result<TriangleBins> TerrainCuts::finestIn(const PixelWindow& window) const {
  // A pixel more on every side, for samples on edges.
  const Box2 pixels{window.left - 1, window.top - 1, window.left + window.width + 1,
                    window.top + window.height + 1};
  const Box2 box = grid_.planBoxOf(pixels.xMin, pixels.yMin, pixels.xMax, pixels.yMax);
  GridTriangles all;
  for (const double columns : {0.0, -turn()}) {
    const Box2 moved{box.xMin - columns, box.yMin, box.xMax - columns, box.yMax};
    ARETE_TRY(TerrainModel model, file_.read({.wanted = requiredInPlan([&](const Box2& part) {
      return meet(part, moved) ? 0.0 : std::numeric_limits<double>::infinity();
    })}));
    // Not a cut of error 0: errors are those at samples, and between them a triangle without error may be far
    // from the finest ones.
    std::vector<std::uint32_t> vertices(model.mt.vertexCount());
    std::iota(vertices.begin(), vertices.end(), 0u);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t t = 0; t < model.mt.triangleIdCount(); ++t)
      if (!model.mt.remover(TriangleId(t)).isValid()) triangles.push_back(model.mt.corners(TriangleId(t)));
    addOnGrid({model, vertices, triangles}, pixels, columns, all);
    if (turn() == 0 || box.xMin > 0) break;
  }
  return TriangleBins(std::move(all));
}

Result<std::shared_ptr<const TriangleBins>> TerrainCuts::tile(int column, int row) {
  const auto found = std::ranges::find_if(
      tiles_, [&](const Tile& tile) { return tile.column == column && tile.row == row; });
  if (found != tiles_.end()) {
    std::rotate(tiles_.begin(), found, found + 1);
    return tiles_.front().triangles;
  }
  ARETE_TRY(TriangleBins finest, runAsGuest([&] {
              return finestIn({double(column) * kTile, double(row) * kTile, kTile, kTile, kTile, kTile});
            }));
  tiles_.push_front({column, row, std::make_shared<const TriangleBins>(std::move(finest))});
  std::size_t triangles = 0;
  for (std::size_t i = 0; i < tiles_.size(); ++i)
    if ((triangles += tiles_[i].triangles->size()) > kMostTriangles && i > 0) tiles_.resize(i);
  return tiles_.front().triangles;
}

Status TerrainCuts::fillWithFinest(const PixelWindow& window, std::span<double> heights, bool isByTiles) {
  if (!isByTiles) {
    ARETE_TRY(const TriangleBins finest, runAsGuest([&] { return finestIn(window); }));
    finest.fill(window, heights);
    return {};
  }
  // Samples whose middles are in one tile.
  const double across = window.width / window.columns, down = window.height / window.rows;
  const auto tileOf = [](double begin, double step, int sample) {
    return static_cast<int>(std::floor((begin + (sample + 0.5) * step) / kTile));
  };
  for (int row = 0, rowEnd = 0; row < window.rows; row = rowEnd) {
    const int down0 = tileOf(window.top, down, row);
    while (rowEnd < window.rows && tileOf(window.top, down, rowEnd) == down0) ++rowEnd;
    for (int column = 0, columnEnd = 0; column < window.columns; column = columnEnd) {
      const int across0 = tileOf(window.left, across, column);
      while (columnEnd < window.columns && tileOf(window.left, across, columnEnd) == across0) ++columnEnd;
      ARETE_TRY(const auto triangles, tile(across0, down0));
      const auto stride = static_cast<std::size_t>(window.columns);
      (triangles)->fill(
          {window.left + column * across, window.top + row * down, (columnEnd - column) * across,
           (rowEnd - row) * down, columnEnd - column, rowEnd - row},
          heights.subspan(static_cast<std::size_t>(row) * stride + static_cast<std::size_t>(column)), stride);
    }
  }
  return {};
}

Status TerrainCuts::fillWithCut(const PixelWindow& window, double error, std::span<double> heights) {
  auto kept = std::ranges::find(kept_, error, &std::pair<double, TriangleBins>::first);
  if (kept == kept_.end()) {
    ARETE_TRY(const Whole whole, take(error));
    // The cut that was made first gives room to a new one.
    if (kept_.size() == kMostKept) kept_.erase(kept_.begin());
    const Box2 pixels{-1, -1, grid_.columns + 1.0, grid_.rows + 1.0};
    GridTriangles all;
    addOnGrid({whole.model, whole.cut.vertices, whole.cut.triangles}, pixels, 0, all);
    // A model around the globe is laid down once more, a whole turn away.
    if (turn() != 0) addOnGrid({whole.model, whole.cut.vertices, whole.cut.triangles}, pixels, -turn(), all);
    kept_.emplace_back(error, TriangleBins(std::move(all)));
    kept = kept_.end() - 1;
  }
  kept->second.fill(window, heights);
  return {};
}

void TerrainCuts::addIsolated(const PixelWindow& window, std::span<double> heights) const {
  if (!grid_.isOfSource()) return;
  const auto& isolated = outline_->isolated;
  const auto rowAt = [](double pixel) {
    return static_cast<std::uint64_t>(std::max(0.0, std::floor(pixel)));
  };
  // Isolated samples are sorted by number, so the rows of the window are one range of them.
  const auto begin = std::ranges::lower_bound(isolated, rowAt(window.top) * outline_->columns, {},
                                              [](const auto& one) { return std::uint64_t{one.sample}; });
  const std::uint64_t end = (rowAt(window.top + window.height) + 1) * outline_->columns;
  for (auto one = begin; one != isolated.end() && one->sample < end; ++one) {
    const Vec2 pixel =
        grid_.pixelOf({double(one->sample % outline_->columns), double(one->sample / outline_->columns)});
    const double x = (pixel.x - window.left) * window.columns / window.width - 0.5,
                 y = (pixel.y - window.top) * window.rows / window.height - 0.5;
    const double column = std::round(x), row = std::round(y);
    constexpr double kAtMiddle = 1e-9;
    if (std::fabs(x - column) > kAtMiddle || std::fabs(y - row) > kAtMiddle || column < 0 || row < 0 ||
        column >= window.columns || row >= window.rows)
      continue;
    heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(window.columns) +
            static_cast<std::size_t>(column)] = one->height;
  }
}

Status TerrainCuts::fill(const PixelWindow& window, double error, std::span<double> heights) try {
  // Small windows are filled from tiles, which their neighbours share; a large one is read at once.
  const double samples = double(window.columns) * double(window.rows);
  const Status filled = error > 0 ? fillWithCut(window, error, heights)
                                  : fillWithFinest(window, heights, samples < 4.0 * kTile * kTile);
  if (filled) addIsolated(window, heights);
  return filled;
} catch (...) {
  return caughtFailure(file_.path());
}

}  // namespace arete

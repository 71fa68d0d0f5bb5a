// SPDX-License-Identifier: GPL-3.0-or-later
#include "gis/driver/terrain_cuts.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/caught_failure.h"
#include "engine/criteria/criterion.h"
#include "io/extract/query_footprint.h"
#include "terrain/model/plan_box.h"

namespace arete {
namespace {

/// Cuts that are kept: an overview is read many times, then another.
constexpr std::size_t kMostKept = 4;

bool meet(const Box2& a, const Box2& b) {
  return a.xMin <= b.xMax && b.xMin <= a.xMax && a.yMin <= b.yMax && b.yMin <= a.yMax;
}

}  // namespace

Result<TerrainCuts> TerrainCuts::open(const std::string& path, double tolerance,
                                      std::optional<double> cell) try {
  Result<AmtFile> file = openAmt(path);
  if (!file) return tl::unexpected(file.error());
  Result<TerrainModel> outline = file->read({.wanted = requiredNowhere()});
  if (!outline) return tl::unexpected(outline.error());
  TerrainCuts cuts(std::move(*file));
  cuts.outline_ = std::make_shared<const TerrainModel>(std::move(*outline));
  cuts.tolerance_ = tolerance;
  if (!cell && !cuts.outline_->isRaster) cell = cuts.spacingOfPoints();
  Result<PixelGrid> grid = PixelGrid::of(*cuts.outline_, cell);
  if (!grid) return tl::unexpected(grid.error());
  cuts.grid_ = *grid;
  return cuts;
} catch (...) {
  return caughtFailure(path);
}

double TerrainCuts::spacingOfPoints() const {
  const Box2 box = planBox(*outline_);
  return std::sqrt((box.xMax - box.xMin) * (box.yMax - box.yMin) / double(file_.nodeCount() + 1));
}

double TerrainCuts::errorOfOverview(int k) const {
  if (k <= 0) return tolerance_;
  const double pixels = double(grid_.columns) * double(grid_.rows) * std::ldexp(1.0, -2 * k);
  if (pixels >= double(file_.nodeCount())) return tolerance_;
  return std::max(tolerance_, file_.errorBeyond(static_cast<std::uint64_t>(std::max(1.0, pixels))));
}

Result<TerrainCuts::Whole> TerrainCuts::take(double error) const {
  Result<TerrainModel> model = file_.read({.wanted = [error](const Box2&) { return error; }});
  if (!model) return tl::unexpected(model.error());
  Result<Cut> cut = takeCut(model->mt, UniformError(error));
  if (!cut) return tl::unexpected(cut.error());
  return Whole{std::move(*model), std::move(*cut)};
}

GridTriangles TerrainCuts::onGrid(const TerrainModel& model, const Cut& cut) const {
  GridTriangles result;
  result.triangles = cut.triangles;
  result.corners.reserve(cut.vertices.size());
  for (const std::uint32_t v : cut.vertices) {
    const Vec3 p = model.mt.position(VertexId(v));
    result.corners.push_back({grid_.pixelOf({p.x, p.y}), p.z});
  }
  return result;
}

Result<TriangleBins> TerrainCuts::finestIn(const PixelWindow& window) const {
  // A pixel more on every side, for samples on edges.
  const Box2 box = grid_.planBoxOf(window.left - 1, window.top - 1, window.left + window.width + 1,
                                   window.top + window.height + 1);
  Result<TerrainModel> model = file_.read({.wanted = [&](const Box2& part) {
    return meet(part, box) ? 0.0 : std::numeric_limits<double>::infinity();
  }});
  if (!model) return tl::unexpected(model.error());
  const RegionError criterion(Region::box(box), model->mt.arrays().metric, 0,
                              std::numeric_limits<double>::infinity());
  const Result<Cut> cut = takeCut(model->mt, criterion);
  if (!cut) return tl::unexpected(cut.error());
  return TriangleBins(onGrid(*model, *cut));
}

Status TerrainCuts::fill(const PixelWindow& window, double error, std::span<double> heights) try {
  if (!(error > 0)) {
    const Result<TriangleBins> finest = finestIn(window);
    if (!finest) return tl::unexpected(finest.error());
    finest->fill(window, heights);
    return {};
  }
  auto kept = std::ranges::find(kept_, error, &std::pair<double, TriangleBins>::first);
  if (kept == kept_.end()) {
    const Result<Whole> whole = take(error);
    if (!whole) return tl::unexpected(whole.error());
    if (kept_.size() == kMostKept) kept_.erase(kept_.begin());
    kept_.emplace_back(error, TriangleBins(onGrid(whole->model, whole->cut)));
    kept = kept_.end() - 1;
  }
  kept->second.fill(window, heights);
  return {};
} catch (...) {
  return caughtFailure(file_.path());
}

}  // namespace arete

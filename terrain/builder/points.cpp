// SPDX-License-Identifier: GPL-3.0-or-later
//
// What scattered points give to a build (build_with.h): CGAL's exact predicates on their own coordinates, and
// triangles that carry the removed points they cover (point_error.h).
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "engine/base/caught_failure.h"
#include "engine/memory/pages.h"
#include "engine/memory/uninitialized_vector.h"
#include "engine/parallel/with_threads.h"
#include "terrain/builder/build.h"
#include "terrain/builder/build_in_tiles.h"
#include "terrain/builder/build_with.h"
#include "terrain/builder/checks.h"
#include "terrain/error/point_error.h"
#include "terrain/model/height_encoding.h"
#include "terrain/model/plan_box.h"
#include "terrain/simplify/simplify.h"
#include "terrain/triangulation/finest_points.h"
#include "terrain/triangulation/point_plan.h"

namespace arete {
namespace {

struct OwnedPoints {
  UninitializedVector<Vec2> plan;
  EncodedHeights heights;
};

/// In the build, points are numbered along the ground: neighbours are near each other in memory.
class PointSource {
 public:
  PointSource(const PointHeightfield& field, FinestPoints finest)
      : field_(field), finest_(std::move(finest)) {}

  const PointHeightfield& field() const { return field_; }

  Result<LiveMesh> triangulate(std::vector<VertexId>& pinched, const RunContext&) {
    LiveMesh mesh = LiveMesh::fromTriangles(std::move(finest_.triangles),
                                            static_cast<std::uint32_t>(field_.size()), pinched);
    giveFreeHeapBack();  // the triangles that it took
    return mesh;
  }

  void describe(const LiveMesh&, TerrainModel& model) const { model.isRaster = false; }

  Status fix(const LiveMesh&, std::span<const std::uint32_t> points,
             std::vector<std::uint8_t>& isFixed) const {
    std::vector<std::uint8_t> isFixedPoint(isFixed.size(), 0);
    for (const std::uint32_t p : points) isFixedPoint[p] = 1;
    for (std::uint32_t v = 0; v < isFixed.size(); ++v) isFixed[v] |= isFixedPoint[pointOf(v)];
    return {};
  }

  ErrorRange wholeRange() const {
    const auto [low, high] = std::minmax_element(field_.heights.begin(), field_.heights.end());
    return {*low, *high};
  }
  LoneHeights lone() const { return loneHeights(field_.heights); }
  double height(VertexId v) const { return field_.heights[pointOf(v.index())]; }

  SourceExtent extent(TerrainModel& model) const {
    const Box2 box = planBox(field_.positions);
    const Vec2 middle{(box.xMin + box.xMax) / 2, (box.yMin + box.yMax) / 2};
    const Vec2 grid = field_.georeference.toGrid(middle.x, middle.y);
    const double stretch = finest_.xStretch;
    model.metricP = stretch >= 1 ? static_cast<std::uint32_t>(stretch) : 1;
    model.metricQ = stretch >= 1 ? 1 : static_cast<std::uint32_t>(1 / stretch);
    return {
        middle, {box.xMax - box.xMin, box.yMax - box.yMin}, groundStep(field_.georeference, grid.x, grid.y)};
  }

  Result<SimplifiedRoot> simplify(const LevelInput& input, const BuildOptions& options,
                                  const TileOptions& tiles, const RunContext& context) const {
    UninitializedVector<Vec3> points(field_.size());
    for (std::uint32_t v = 0; v < points.size(); ++v) {
      const Vec2 p = field_.positions[pointOf(v)];
      points[v] = {p.x, p.y, field_.heights[pointOf(v)]};
    }
    const PointPlan plan(points, finest_.xStretch);
    PointError errors(plan, points, input.mesh);
    const auto [low, high] = input.range;
    const double slack = roundingSlack(low, high);
    SimplifyState<PointPlan, PointError> state{.mesh = input.mesh,
                                               .plan = plan,
                                               .errors = errors,
                                               .recorder = input.recorder,
                                               .rim = nullptr,
                                               .options = options,
                                               .metric = input.metric,
                                               .heightRange = high - low,
                                               .roundingSlack = slack,
                                               .boundSlack = slack};
    return Simplifier(state, tiles, context).run(input.isFixed);
  }

  void finish(const MultiTriangulation& bare, UninitializedVector<std::uint32_t> order,
              const std::vector<std::uint8_t>& isFixed, TerrainModel& model) const {
    // In the model, fixed vertices are MT vertices.
    std::vector<std::uint32_t> fixed;
    for (std::uint32_t v = 0; v < order.size(); ++v)
      if (isFixed[order[v]]) fixed.push_back(v);
    for (std::uint32_t& v : order) v = pointOf(v);
    model.options.fixedVertices = std::move(fixed);
    auto owned = std::make_shared<OwnedPoints>();
    owned->plan.resize(order.size());
    std::ranges::transform(order, owned->plan.begin(), [&](std::uint32_t v) { return field_.positions[v]; });
    owned->heights = encodeHeights(field_.heights, order, 1, 0);
    VertexArrays vertices;
    vertices.plan = owned->plan;
    vertices.encoding = owned->heights.encoding;
    vertices.rawHeights = owned->heights.bytes;
    model.mt = withVertices(bare, vertices, owned);
  }

 private:
  std::uint32_t pointOf(std::uint32_t vertex) const { return finest_.order[vertex]; }

  const PointHeightfield& field_;
  FinestPoints finest_;  // without its triangles, once triangulate() has taken them
};

Result<TerrainModel> buildChecked(const PointHeightfield& field, FinestPoints finest,
                                  const BuildOptions& options, const TileOptions& tiles,
                                  const RunContext& context) {
  return withThreads(context, [&] {
    PointSource source(field, std::move(finest));
    return buildWith(source, options, tiles, context);
  });
}

}  // namespace

Status checkBuild(const PointHeightfield& field, const BuildOptions& options) try {
  ARETE_CHECK(field.validate());
  ARETE_CHECK(checkOptions(options, field.size()));
  if (options.rimTolerance > 0)
    return failure(ErrorCode::usage, "scattered points have no NODATA rims to simplify", "rimTolerance");
  return {};
} catch (...) {
  return caughtFailure();
}

Result<TerrainModel> build(const PointHeightfield& heightfield, const BuildOptions& options,
                           const RunContext& context) try {
  return buildInTiles(heightfield, options, TileOptions::of(options.shape), context);
} catch (...) {
  return caughtFailure();
}

Result<TerrainModel> build(const PointHeightfield& heightfield, FinestPoints finest,
                           const BuildOptions& options, const RunContext& context) try {
  ARETE_CHECK(checkBuild(heightfield, options));
  return buildChecked(heightfield, std::move(finest), options, TileOptions::of(options.shape), context);
} catch (...) {
  return caughtFailure();
}

Result<TerrainModel> buildInTiles(const PointHeightfield& heightfield, const BuildOptions& options,
                                  const TileOptions& tiles, const RunContext& context) {
  ARETE_CHECK(checkBuild(heightfield, options));
  ARETE_TRY(FinestPoints finest, finestPoints(heightfield, context));
  return buildChecked(heightfield, std::move(finest), options, tiles, context);
}

}  // namespace arete

// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scattered points are built with CGAL's exact predicates on their own coordinates; each triangle carries the
// removed points it covers: see simplify.h for the levels and point_error.h for the error.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "engine/base/caught_failure.h"
#include "engine/memory/pages.h"
#include "engine/memory/uninitialized_vector.h"
#include "engine/parallel/with_threads.h"
#include "terrain/builder/build.h"
#include "terrain/builder/build_in_tiles.h"
#include "terrain/builder/checks.h"
#include "terrain/builder/remote_heights.h"
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

Result<TerrainModel> buildHere(const PointHeightfield& field, FinestPoints finest,
                               const BuildOptions& options, const TileOptions& tiles,
                               const RunContext& context) {
  std::optional<StageClock::Scope> stage(std::in_place, context.clock, "triangulate");
  // In the build, points are numbered along the ground: neighbours are near each other in memory.
  const std::vector<std::uint32_t>& ground = finest.order;
  const auto finestCount = static_cast<std::uint32_t>(finest.triangles.size());
  const auto pointCount = static_cast<std::uint32_t>(field.size());
  std::vector<VertexId> pinched;
  LiveMesh mesh = LiveMesh::fromTriangles(std::move(finest.triangles), pointCount, pinched);
  giveFreeHeapBack();  // the triangles that it took
  stage.emplace(context.clock, "prepare");

  TerrainModel model;
  model.georeference = field.georeference;
  model.isRaster = false;
  model.source = field.source;
  model.sourceChecksum = field.sourceChecksum.empty() ? heightsChecksum(field) : field.sourceChecksum;
  model.options = options;
  model.options.thresholdRatio = options.thresholdRatioOrDefault();

  std::vector<std::uint8_t> isFixed(pointCount, 0);
  for (const VertexId v : pinched) isFixed[v.index()] = 1;
  std::vector<std::uint8_t> isFixedPoint(pointCount, 0);
  for (const std::uint32_t p : options.fixedVertices) isFixedPoint[p] = 1;
  for (std::uint32_t v = 0; v < pointCount; ++v) isFixed[v] |= isFixedPoint[ground[v]];

  const auto [lowest, highest] = std::minmax_element(field.heights.begin(), field.heights.end());
  if (!(*highest - *lowest < 1e30))
    return failure(ErrorCode::invalidData,
                   fmt::format("heights from {} to {} span too much", *lowest, *highest), field.source);
  const auto [low, high] = fixRemoteHeights(
      mesh, loneHeights(field.heights), [&](VertexId v) { return field.heights[ground[v.index()]]; },
      {*lowest, *highest}, isFixed);
  const Box2 box = planBox(field.positions);
  const Vec2 centre{(box.xMin + box.xMax) / 2, (box.yMin + box.yMax) / 2};
  const Vec2 grid = field.georeference.toGrid(centre.x, centre.y);
  const Vec2 step = groundStep(field.georeference, grid.x, grid.y);
  MetricFrame metric;
  metric.origin = {centre.x, centre.y, (low + high) / 2};
  metric.scale = {step.x, step.y, field.georeference.verticalUnitMetres};
  const Vec3 span{(box.xMax - box.xMin) * step.x, (box.yMax - box.yMin) * step.y,
                  (high - low) * metric.scale.z};
  ARETE_CHECK(checkSpan(span, field.source));
  const double stretch = finest.xStretch;
  model.metricP = stretch >= 1 ? static_cast<std::uint32_t>(stretch) : 1;
  model.metricQ = stretch >= 1 ? 1 : static_cast<std::uint32_t>(1 / stretch);

  MtRecorder recorder(finestCount, pointCount, OutwardScale(high - low), metric);
  SimplifiedRoot root;
  stage.emplace(context.clock, "simplify");
  {
    UninitializedVector<Vec3> points(pointCount);
    for (std::uint32_t v = 0; v < pointCount; ++v) {
      const Vec2 p = field.positions[ground[v]];
      points[v] = {p.x, p.y, field.heights[ground[v]]};
    }
    const PointPlan plan(points, stretch);
    PointError errors(plan, points, mesh);
    const double slack = roundingSlack(low, high);
    SimplifyState<PointPlan, PointError> state{.mesh = mesh,
                                               .plan = plan,
                                               .errors = errors,
                                               .recorder = recorder,
                                               .rim = nullptr,
                                               .options = options,
                                               .metric = metric,
                                               .heightRange = high - low,
                                               .roundingSlack = slack,
                                               .boundSlack = slack};
    ARETE_TRY(SimplifiedRoot simplified, Simplifier(state, tiles, context).run(isFixed));
    root = std::move(simplified);
  }
  mesh = {};
  model.levels = root.levels;

  context.report("finish", 0);
  stage.emplace(context.clock, "finish");
  UninitializedVector<std::uint32_t> order;
  const MultiTriangulation bare =
      recorder.finish(root.vertices, root.triangles, pointCount, order, context.clock);
  // In the model, fixed vertices are MT vertices.
  std::vector<std::uint32_t> fixed;
  for (std::uint32_t v = 0; v < order.size(); ++v)
    if (isFixed[order[v]]) fixed.push_back(v);
  for (std::uint32_t& v : order) v = ground[v];
  model.options.fixedVertices = std::move(fixed);
  auto owned = std::make_shared<OwnedPoints>();
  owned->plan.resize(order.size());
  std::ranges::transform(order, owned->plan.begin(), [&](std::uint32_t v) { return field.positions[v]; });
  owned->heights = encodeHeights(field.heights, order, 1, 0);
  VertexArrays vertices;
  vertices.plan = owned->plan;
  vertices.encoding = owned->heights.encoding;
  vertices.rawHeights = owned->heights.bytes;
  model.mt = withVertices(bare, vertices, owned);
  context.report("finish", 1);
  return model;
}

Result<TerrainModel> buildChecked(const PointHeightfield& field, FinestPoints finest,
                                  const BuildOptions& options, const TileOptions& tiles,
                                  const RunContext& context) {
  return withThreads(context, [&] { return buildHere(field, std::move(finest), options, tiles, context); });
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

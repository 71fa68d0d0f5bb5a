// SPDX-License-Identifier: GPL-3.0-or-later
//
// A raster is built in lattice coordinates, with integer predicates, and its errors are scanned from the
// raster itself: see simplify.h for the levels and raster_error.h for the scan.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

#include "engine/base/caught_failure.h"
#include "engine/memory/uninitialized_vector.h"
#include "engine/parallel/parallel_filter.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"
#include "terrain/builder/build.h"
#include "terrain/builder/build_in_tiles.h"
#include "terrain/builder/checks.h"
#include "terrain/builder/remote_heights.h"
#include "terrain/error/raster_error.h"
#include "terrain/model/height_encoding.h"
#include "terrain/simplify/simplify.h"
#include "terrain/triangulation/finest_raster.h"
#include "terrain/triangulation/rim.h"

namespace arete {
namespace {

struct Ratio {
  std::uint32_t p = 1, q = 1;
};

/// The best p / q with q up to 16: its relative error is below 4 %, which makes no visible difference to the
/// shapes of triangles. Ratios beyond 64 are clamped.
Ratio nearestRatio(double aspect) {
  if (!(aspect > 0) || !std::isfinite(aspect)) return {};
  if (aspect >= 16) return {static_cast<std::uint32_t>(std::min(64.0, std::round(aspect))), 1};
  if (aspect <= 1.0 / 16) return {1, static_cast<std::uint32_t>(std::min(64.0, std::round(1 / aspect)))};
  Ratio best;
  double bestError = std::numeric_limits<double>::infinity();
  for (std::uint32_t q = 1; q <= 16; ++q) {
    const auto p = static_cast<std::uint32_t>(std::lround(aspect * q));
    if (p == 0 || p > 256) continue;
    const double error = std::abs(std::log(aspect * q / p));
    if (error < bestError * 0.999) {
      bestError = error;
      best = {p, q};
    }
  }
  return best;
}

constexpr std::size_t kSamplesAtOnce = 1 << 16;

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
};

/// The range of the samples that have data.
Range rangeOf(std::span<const double> heights) {
  return parallelReduce(
      IndexRange<std::size_t>(0, heights.size(), kSamplesAtOnce), Range(),
      [&](const auto& part, Range range) {
        for (const double z : heights.subspan(part.begin(), part.size())) {
          range.low = z < range.low ? z : range.low;  // false for NODATA
          range.high = z > range.high ? z : range.high;
        }
        return range;
      },
      [](const Range& a, const Range& b) {
        return Range{std::min(a.low, b.low), std::max(a.high, b.high)};
      });
}

/// The samples that have data and are in no triangle.
std::vector<std::uint32_t> isolatedSamples(const RasterHeightfield& field, const LiveMesh& mesh) {
  std::vector<std::uint32_t> isolated;
  ParallelFilter<std::uint32_t>()(
      field.size(), kSamplesAtOnce, isolated, [&](std::size_t begin, std::size_t end, std::uint32_t* to) {
        for (std::size_t v = begin; v != end; ++v)
          if (!mesh.isInTriangle(VertexId(static_cast<std::uint32_t>(v))) && !std::isnan(field.heights[v]))
            *to++ = static_cast<std::uint32_t>(v);
        return to;
      });
  return isolated;
}

struct OwnedVertices {
  UninitializedVector<std::uint32_t> samples;
  EncodedHeights heights;
};

Result<TerrainModel> buildHere(const RasterHeightfield& field, const BuildOptions& options,
                               const TileOptions& tiles, const RunContext& context) {
  ARETE_CHECK(field.validate());
  ARETE_CHECK(checkOptions(options, field.size()));
  ARETE_CHECK(checkPositions(field));
  if (field.size() > LiveMesh::kMostTriangles / 2)
    return failure(
        ErrorCode::unsupported,
        fmt::format("{} samples have more triangles than 32-bit half-edges can name", field.size()),
        field.source);

  context.report("triangulate", 0);
  std::optional<StageClock::Scope> stage(std::in_place, context.clock, "triangulate");
  std::vector<VertexId> pinched;
  LiveMesh mesh = finestMesh(field, pinched);
  if (mesh.triangles.empty()) return failure(ErrorCode::degenerate, whyNoTriangle(field), field.source);
  const auto finestCount = static_cast<std::uint32_t>(mesh.triangles.size());
  const auto sampleCount = static_cast<std::uint32_t>(field.size());
  context.report("triangulate", 1);
  stage.emplace(context.clock, "prepare");

  TerrainModel model;
  model.georeference = field.georeference;
  model.columns = field.columns;
  model.rows = field.rows;
  model.source = field.source;
  model.sourceChecksum = field.sourceChecksum.empty() ? heightsChecksum(field) : field.sourceChecksum;
  model.options = options;
  model.options.thresholdRatio = options.thresholdRatioOrDefault();

  std::vector<std::uint8_t> isFixed(sampleCount, 0);
  for (const VertexId v : pinched) isFixed[v.index()] = 1;
  for (const std::uint32_t v : options.fixedVertices) {
    if (!mesh.isInTriangle(VertexId(v)))
      return failure(
          ErrorCode::invalidData,
          fmt::format(
              "the fixed vertex at column {}, row {} is not in the domain: no data there, or isolated",
              v % field.columns, v / field.columns),
          field.source);
    isFixed[v] = 1;
  }
  const Range all = rangeOf(field.heights);
  for (const std::uint32_t v : isolatedSamples(field, mesh)) model.isolated.push_back({v, field.heights[v]});
  if (!(all.high - all.low < 1e30))
    return failure(ErrorCode::invalidData,
                   fmt::format("heights from {} to {} span too much", all.low, all.high), field.source);
  const auto [low, high] = fixRemoteHeights(
      mesh, loneHeights(field.heights, field.rawScale, field.rawOffset),
      [&](VertexId v) { return field.heights[v.index()]; }, {all.low, all.high}, isFixed);

  const Vec2 step = groundStep(field.georeference, (field.columns - 1) / 2.0, (field.rows - 1) / 2.0);
  const Ratio ratio = nearestRatio(step.x / step.y);
  model.metricP = ratio.p;
  model.metricQ = ratio.q;
  MetricFrame metric;
  metric.origin = {(field.columns - 1) / 2.0, (field.rows - 1) / 2.0, (low + high) / 2};
  metric.scale = {step.x, step.y, field.georeference.verticalUnitMetres};
  const Vec3 span{field.columns * step.x, field.rows * step.y, (high - low) * metric.scale.z};
  ARETE_CHECK(checkSpan(span, field.source));

  const LatticePlan plan(field.columns, ratio.p, ratio.q);
  MtRecorder recorder(finestCount, sampleCount, OutwardScale(high - low), metric);
  std::unique_ptr<Rim> rim;
  if (options.rimTolerance > 0) rim = std::make_unique<Rim>(mesh, plan, options.rimTolerance);

  SimplifiedRoot root;
  stage.emplace(context.clock, "simplify");
  {
    const double crossing = crossingSlack(low, high, field.columns, field.rows);
    RasterError errors(plan, field.heights, options.rimTolerance > 0, crossing);
    SimplifyState<LatticePlan, RasterError> state{.mesh = mesh,
                                                  .plan = plan,
                                                  .errors = errors,
                                                  .recorder = recorder,
                                                  .rim = rim.get(),
                                                  .options = options,
                                                  .metric = metric,
                                                  .heightRange = high - low,
                                                  .roundingSlack = roundingSlack(low, high),
                                                  .boundSlack = crossing};
    ARETE_TRY(SimplifiedRoot simplified, Simplifier(state, tiles, context).run(isFixed));
    root = std::move(simplified);
  }
  mesh = {};
  model.levels = root.levels;

  context.report("finish", 0);
  stage.emplace(context.clock, "finish");
  auto owned = std::make_shared<OwnedVertices>();
  const MultiTriangulation bare =
      recorder.finish(root.vertices, root.triangles, sampleCount, owned->samples, context.clock);
  owned->heights = encodeHeights(field.heights, owned->samples, field.rawScale, field.rawOffset);
  VertexArrays vertices;
  vertices.samples = owned->samples;
  vertices.columns = field.columns;
  vertices.encoding = owned->heights.encoding;
  vertices.rawHeights = owned->heights.bytes;
  model.mt = withVertices(bare, vertices, owned);
  context.report("finish", 1);
  return model;
}

}  // namespace

Result<TerrainModel> build(const RasterHeightfield& heightfield, const BuildOptions& options,
                           const RunContext& context) try {
  return buildInTiles(heightfield, options, TileOptions::of(options.shape), context);
} catch (...) {
  return caughtFailure();
}

Result<TerrainModel> buildInTiles(const RasterHeightfield& heightfield, const BuildOptions& options,
                                  const TileOptions& tiles, const RunContext& context) {
  return withThreads(context, [&] { return buildHere(heightfield, options, tiles, context); });
}

}  // namespace arete

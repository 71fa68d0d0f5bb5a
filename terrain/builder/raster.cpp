// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a raster gives to a build (build_with.h): lattice coordinates with integer predicates, and errors that
// are scanned from the raster itself (raster_error.h).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "engine/base/caught_failure.h"
#include "engine/memory/uninitialized_vector.h"
#include "engine/parallel/parallel_filter.h"
#include "engine/parallel/parallel_loops.h"
#include "engine/parallel/with_threads.h"
#include "terrain/builder/build.h"
#include "terrain/builder/build_in_tiles.h"
#include "terrain/builder/build_with.h"
#include "terrain/builder/checks.h"
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

// The model's vertices refer to these arrays, so both travel with it as its owner.
struct OwnedVertices {
  UninitializedVector<std::uint32_t> samples;
  EncodedHeights heights;
};

/// What buildWith() needs of a source, for a raster.
class RasterSource {
 public:
  explicit RasterSource(const RasterHeightfield& field) : field_(field) {}

  const RasterHeightfield& field() const { return field_; }

  Result<LiveMesh> triangulate(std::vector<VertexId>& pinched, const RunContext& context) const {
    context.report("triangulate", 0);
    LiveMesh mesh = finestMesh(field_, pinched);
    if (mesh.triangles.empty()) return failure(ErrorCode::degenerate, whyNoTriangle(field_), field_.source);
    context.report("triangulate", 1);
    return mesh;
  }

  // Samples in no triangle have no vertex; the model keeps them apart, so that no sample is lost.
  void describe(const LiveMesh& mesh, TerrainModel& model) const {
    model.columns = field_.columns;
    model.rows = field_.rows;
    for (const std::uint32_t v : isolatedSamples(field_, mesh))
      model.isolated.push_back({v, field_.heights[v]});
  }

  Status fix(const LiveMesh& mesh, std::span<const std::uint32_t> vertices,
             std::vector<std::uint8_t>& isFixed) const {
    for (const std::uint32_t v : vertices) {
      if (!mesh.isInTriangle(VertexId(v)))
        return failure(
            ErrorCode::invalidData,
            fmt::format(
                "the fixed vertex at column {}, row {} is not in the domain: no data there, or isolated",
                v % field_.columns, v / field_.columns),
            field_.source);
      isFixed[v] = 1;
    }
    return {};
  }

  // The range leaves NODATA out: it bounds the errors and the rounding of all heights.
  ErrorRange wholeRange() const {
    const Range all = rangeOf(field_.heights);
    return {all.low, all.high};
  }
  LoneHeights lone() const { return loneHeights(field_.heights, field_.rawScale, field_.rawOffset); }
  double height(VertexId v) const { return field_.heights[v.index()]; }

  SourceExtent extent(TerrainModel& model) {
    const Vec2 middle{(field_.columns - 1) / 2.0, (field_.rows - 1) / 2.0};
    const Vec2 step = groundStep(field_.georeference, middle.x, middle.y);
    ratio_ = nearestRatio(step.x / step.y);
    model.metricP = ratio_.p;
    model.metricQ = ratio_.q;
    return {middle, {double(field_.columns), double(field_.rows)}, step};
  }

  // Two slacks bound the rounding of heights: one between samples with known weights, and a larger one where
  // an edge crosses the lines of the raster at computed places.
  Result<SimplifiedRoot> simplify(const LevelInput& input, const BuildOptions& options,
                                  const TileOptions& tiles, const RunContext& context) const {
    const auto [low, high] = input.range;
    const LatticePlan plan(field_.columns, ratio_.p, ratio_.q);
    std::unique_ptr<Rim> rim;
    if (options.rimTolerance > 0) rim = std::make_unique<Rim>(input.mesh, plan, options.rimTolerance);
    const double crossing = crossingSlack(low, high, field_.columns, field_.rows);
    RasterError errors(plan, field_.heights, options.rimTolerance > 0, crossing);
    SimplifyState<LatticePlan, RasterError> state{.mesh = input.mesh,
                                                  .plan = plan,
                                                  .errors = errors,
                                                  .recorder = input.recorder,
                                                  .rim = rim.get(),
                                                  .options = options,
                                                  .metric = input.metric,
                                                  .heightRange = high - low,
                                                  .roundingSlack = roundingSlack(low, high),
                                                  .boundSlack = crossing};
    return Simplifier(state, tiles, context).run(input.isFixed);
  }

  // The heights follow the order of the MT, in the shortest type that restores each of them to the bit.
  void finish(const MultiTriangulation& bare, UninitializedVector<std::uint32_t> order,
              const std::vector<std::uint8_t>&, TerrainModel& model) const {
    auto owned = std::make_shared<OwnedVertices>();
    owned->samples = std::move(order);
    owned->heights = encodeHeights(field_.heights, owned->samples, field_.rawScale, field_.rawOffset);
    VertexArrays vertices;
    vertices.samples = owned->samples;
    vertices.columns = field_.columns;
    vertices.encoding = owned->heights.encoding;
    vertices.rawHeights = owned->heights.bytes;
    model.mt = withVertices(bare, vertices, owned);
  }

 private:
  const RasterHeightfield& field_;
  Ratio ratio_;
};

// A planar triangulation has nearly two triangles for each sample, so half as many samples as triangles can
// be numbered.
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
  RasterSource source(field);
  return buildWith(source, options, tiles, context);
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

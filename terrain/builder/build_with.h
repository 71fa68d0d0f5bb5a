// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "engine/memory/uninitialized_vector.h"
#include "engine/mt/recorder.h"
#include "engine/parallel/run_context.h"
#include "engine/simplify/live_mesh.h"
#include "engine/simplify/simplified_root.h"
#include "terrain/builder/checks.h"
#include "terrain/builder/remote_heights.h"
#include "terrain/model/terrain_model.h"
#include "terrain/simplify/tile_options.h"

namespace arete {

/// The plan that a source covers.
struct SourceExtent {
  Vec2 middle, size;  ///< in plan coordinates
  Vec2 step;          ///< the ground length of a unit of them, in metres
};

/// What the levels of a build need beside its mesh.
struct LevelInput {
  LiveMesh& mesh;
  MtRecorder& recorder;
  const MetricFrame& metric;
  ErrorRange range;
  const std::vector<std::uint8_t>& isFixed;
};

/// The steps of a build, the same for each kind of source. Vertices are numbered as the source likes.
///
/// Source (RasterSource, PointSource):
///   field()                           the heightfield
///   triangulate(pinched, context)     its finest triangulation, or why there is none
///   fix(mesh, vertices, isFixed)      marks the fixed vertices of the options, or refuses one
///   describe(mesh, model)             what the model says of the source
///   wholeRange(), lone(), height(v)   heights
///   extent(model)                     its plan; sets the model's metric ratio
///   simplify(input, options, tiles, context)         all levels, with the errors of its kind
///   finish(bare, order, isFixed, model)              gives the MT its positions; order: vertex of the source
///                                                    by vertex of the MT
template <class Source>
Result<TerrainModel> buildWith(Source& source, const BuildOptions& options, const TileOptions& tiles,
                               const RunContext& context) {
  const auto& field = source.field();
  std::optional<StageClock::Scope> stage(std::in_place, context.clock, "triangulate");
  std::vector<VertexId> pinched;
  ARETE_TRY(LiveMesh mesh, source.triangulate(pinched, context));
  const auto finestCount = static_cast<std::uint32_t>(mesh.triangles.size());
  const auto vertexCount = static_cast<std::uint32_t>(field.size());

  stage.emplace(context.clock, "prepare");
  TerrainModel model;
  model.georeference = field.georeference;
  model.source = field.source;
  model.sourceChecksum = field.sourceChecksum.empty() ? heightsChecksum(field) : field.sourceChecksum;
  model.options = options;
  model.options.thresholdRatio = options.thresholdRatioOrDefault();
  source.describe(mesh, model);

  std::vector<std::uint8_t> isFixed(vertexCount, 0);
  for (const VertexId v : pinched) isFixed[v.index()] = 1;
  ARETE_CHECK(source.fix(mesh, options.fixedVertices, isFixed));

  const ErrorRange whole = source.wholeRange();
  if (!(whole.high - whole.low < 1e30))
    return failure(ErrorCode::invalidData,
                   fmt::format("heights from {} to {} span too much", whole.low, whole.high), field.source);
  const ErrorRange range = fixRemoteHeights(
      mesh, source.lone(), [&](VertexId v) { return source.height(v); }, whole, isFixed);
  const double relief = range.high - range.low;

  const SourceExtent extent = source.extent(model);
  MetricFrame metric;
  metric.origin = {extent.middle.x, extent.middle.y, (range.low + range.high) / 2};
  metric.scale = {extent.step.x, extent.step.y, field.georeference.verticalUnitMetres};
  ARETE_CHECK(checkSpan(
      {extent.size.x * extent.step.x, extent.size.y * extent.step.y, relief * metric.scale.z}, field.source));

  MtRecorder recorder(finestCount, vertexCount, OutwardScale(relief), metric);
  stage.emplace(context.clock, "simplify");
  ARETE_TRY(const SimplifiedRoot root,
            source.simplify({mesh, recorder, metric, range, isFixed}, options, tiles, context));
  mesh = {};  // the arrays of the MT take its memory
  model.levels = root.levels;

  context.report("finish", 0);
  stage.emplace(context.clock, "finish");
  UninitializedVector<std::uint32_t> order;
  const MultiTriangulation bare =
      recorder.finish(root.vertices, root.triangles, vertexCount, order, context.clock);
  source.finish(bare, std::move(order), isFixed, model);
  context.report("finish", 1);
  return model;
}

}  // namespace arete
